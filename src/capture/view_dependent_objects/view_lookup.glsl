// The colour of a point of a view-dependent object: the textures of the N viewpoints whose directions to the
// point are nearest to the eye's, blended by the angles between (thesis, section 5.3.4; weights after
// Debevec, Yu and Borshukov 1998). The including text defines
//   vec4 view_entry(int index)                                      of the table (blended_model.h)
//   vec4 view_picture(int layer, vec2 uv, vec2 along_x, vec2 along_y)  linear colour and alpha
// GLSL that is C++, too (view_lookup.h).

// setNumBlendPass of the thesis: 2 neighbouring views, 3 or 4 of what is near.
#define MAX_PASSES 4

// What a viewpoint's model says of the triangle at `entry`: linear colour and alpha, with 1 in `known`, or
// nothing.
struct ViewColour {
  vec4 colour;
  float known;
};

GLSL_FUNCTION ViewColour colour_from_view(int entry, vec3 weights, vec3 weights_x, vec3 weights_y) {
  vec4 first = view_entry(entry), second = view_entry(entry + 1);
  if (second.z < -1.5f) return ViewColour(vec4(0.0f), 0.0f);
  if (second.z < -0.5f) return ViewColour(vec4(first.x, first.y, first.z, 1.0f), 1.0f);
  vec2 a = vec2(first.x, first.y), b = vec2(first.z, first.w), c = vec2(second.x, second.y);
  return ViewColour(view_picture(int(second.z + 0.5f), weights.x * a + weights.y * b + weights.z * c,
                                 weights_x.x * a + weights_x.y * b + weights_x.z * c,
                                 weights_y.x * a + weights_y.y * b + weights_y.z * c),
                    1.0f);
}

// Linear colour and alpha of a point. `piece`: its first entry, its number of views, the triangle counted
// from its first. `weights` of the triangle's corners at the point, and how they change to the next pixels.
GLSL_FUNCTION vec4 blended_colour(int first_entry, int views, int triangle, int passes, vec3 position,
                                  vec3 to_eye, vec3 weights, vec3 weights_x, vec3 weights_y) {
  int best[MAX_PASSES + 1];
  float penalties[MAX_PASSES + 1];
  for (int i = 0; i <= MAX_PASSES; ++i) {
    best[i] = -1;
    penalties[i] = MAX_PENALTY;
  }
  for (int view = 0; view < views; ++view) {
    vec4 viewpoint = view_entry(first_entry + view);
    vec3 away = vec3(viewpoint.x, viewpoint.y, viewpoint.z) - position;
    float penalty = view_penalty(to_eye, away / max(length(away), 1e-6f), 1.0f, 0.0f);
    int candidate = view;
    for (int i = 0; i <= passes; ++i) {
      if (penalty >= penalties[i]) continue;
      float worse = penalties[i];
      int other = best[i];
      penalties[i] = penalty;
      best[i] = candidate;
      penalty = worse;
      candidate = other;
    }
  }
  vec4 sum = vec4(0.0f);
  float total = 0.0f, known = 0.0f;
  for (int i = 0; i < passes; ++i) {
    if (best[i] < 0) continue;
    float weight = max(blend_weight(penalties[i], penalties[passes]), i == 0 ? 1e-6f : 0.0f);
    total += weight;
    if (weight <= 0.0f) continue;
    int entry = first_entry + views + 2 * (triangle * views + best[i]);
    ViewColour found = colour_from_view(entry, weights, weights_x, weights_y);
    sum += weight * found.known * found.colour;
    known += weight * found.known;
  }
  vec4 mean = sum / max(known, 1e-9f);
  return vec4(mean.x, mean.y, mean.z, mean.w * known / max(total, 1e-9f));
}
