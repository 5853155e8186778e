// The colour of a point of a captured facade from its photographs' layers, in one pass (thesis 3.6): the k =
// 2 best photographs by angle and resolution, with feathered borders; at a photograph's own viewpoint plainly
// its layers. GLSL that is C++, too. Around it stand the functions that read the packed layers:
//   FacadePhoto facade_photo(int photo)       a row of the table of photographs (facade_photo.glsl)
//   uvec4 facade_layer(int layer)             x: left | top << 16 of its box in the photograph, pixels;
//                                             y: tiles across | tiles down << 16; z: first tile; w: photo
//   int facade_candidate(int index)           a layer, of the lists of layers that hold each triangle
//   uvec4 facade_tile(int tile)               x: 0 where nothing is stored, else a TILE_ kind; y: its slot
//   float facade_depth(int index)             log2 of how far a cell of a photograph sees, see encoded_depth
//   vec4 facade_texel(int slot, vec2 at, float level)   sRGB and alpha, filtered; `at` in texels of the slot

#define TILE_SEEN 1u      // the photograph sees all of it
#define TILE_MIXED 2u     // alpha says how much of a texel the photograph sees
#define TILE_ALPHA 3u     // seen, with an artist's alpha
#define TILE_INNER 62.0f  // texels of a tile; 1 more on every side repeats its neighbours, for filters
#define TILE_BORDER 1.0f
#define TILE_LEVELS 3  // mipmaps

// Confidence in what was filled over what a photograph sees: it counts where nothing else does.
#define FILLED_CONFIDENCE 0.01f
// Below this angle between eye and camera, radians, a photograph is shown plainly; it counts more and more
// from 4 times that.
#define OWN_VIEWPOINT_ANGLE 0.002f
#define DEPTH_CELL 8.0f  // pixels
// A point this much farther than its photograph sees is hidden by its own object, log2 (1.5 %).
#define HIDDEN_LOG2 0.0215f
// What was filled lies behind what its photograph sees; this much farther only the backdrop does, of which no
// hidden part is kept, log2 (2.3 times).
#define FILLED_LOG2 1.2f
#define BORDER_FEATHER 0.05f    // of the picture's width
#define FADING_CONFIDENCE 0.4f  // below it, of what is seen, a point takes on its neighbourhood's colour
#define RESOLUTION_WEIGHT 0.1f  // see penalty_of_angle

// What one photograph says about a point.
struct FacadeOpinion {
  float key;  // the best is least; above 100: filled
  float penalty;
  float confidence;
  float own;  // 1: the eye is at the photograph's own viewpoint
  float level;
  vec2 at;
  int slot;
  int photo;
  int kind;
};

GLSL_FUNCTION FacadeOpinion facade_opinion(int candidate, vec3 position, vec3 to_eye, float pixel_m) {
  FacadeOpinion none = FacadeOpinion(1e9f, MAX_PENALTY, 0.0f, 0.0f, 0.0f, vec2(0.0f), 0, 0, 0);
  uvec4 layer = facade_layer(candidate);
  int index = int(layer.w);
  FacadePhoto photo = facade_photo(index);
  vec4 p = vec4(position, 1.0f);
  float depth = dot(photo.row_z, p);
  if (!(depth > 0.0f)) return none;
  vec2 pixel = vec2(dot(photo.row_x, p), dot(photo.row_y, p)) / depth;
  vec2 size = vec2(photo.size.x, photo.size.y);
  // Written so that what overflowed to no number is none, either.
  if (!(min(pixel.x, pixel.y) >= 0.0f && pixel.x <= size.x && pixel.y <= size.y)) return none;
  vec2 in_box = pixel - vec2(float(layer.x & 65535u), float(layer.x >> 16u));
  vec2 tiles = vec2(float(layer.y & 65535u), float(layer.y >> 16u));
  if (min(in_box.x, in_box.y) < -1.0f || in_box.x > TILE_INNER * tiles.x || in_box.y > TILE_INNER * tiles.y)
    return none;
  vec2 cell = clamp(floor(in_box / TILE_INNER), vec2(0.0f), tiles - vec2(1.0f));
  uvec4 tile = facade_tile(int(layer.z) + int(cell.y * tiles.x + cell.x));
  if (tile.x == 0u) return none;

  vec3 to_photo = normalize(vec3(photo.centre) - position);
  FacadeOpinion found;
  found.kind = int(tile.x);
  found.slot = int(tile.y);
  found.photo = index;
  float ratio = depth / (photo.centre.w * max(pixel_m, 1e-6f));
  found.level = clamp(log2(max(1.0f / ratio, 1.0f)), 0.0f, float(TILE_LEVELS - 1));
  // Filters stay within the slot: in the coarsest level by reading a texel less near its edge.
  float reach = 0.5f * exp2(ceil(found.level));
  found.at = clamp(in_box - TILE_INNER * cell + vec2(TILE_BORDER), vec2(reach),
                   vec2(TILE_INNER + 2.0f * TILE_BORDER - reach));
  float angle = angle_between(to_eye, to_photo);
  found.penalty = penalty_of_angle(angle, ratio, RESOLUTION_WEIGHT);
  found.own = 1.0f - smoothstep(OWN_VIEWPOINT_ANGLE, 4.0f * OWN_VIEWPOINT_ANGLE, angle);
  float seen = 1.0f;
  if (tile.x == TILE_MIXED) {
    float known = facade_texel(found.slot, found.at, 0.0f).w;
    if (known < 0.4f) return none;  // a hidden part of the backdrop
    seen = smoothstep(0.75f, 1.0f, known);
  }
  // What the layer shows there is what hides the point: another part of the same object. From its own
  // viewpoint nothing is hidden.
  vec2 cells = ceil(size / DEPTH_CELL),
       place = clamp(floor(pixel / DEPTH_CELL), vec2(0.0f), cells - vec2(1.0f));
  int first_depth = int(photo.size.z) * 4096 + int(photo.size.w);
  float seen_depth = facade_depth(first_depth + int(place.y * cells.x + place.x));
  float farther = log2(depth) - seen_depth;
  if (found.own < 0.5f && farther > (seen > 0.5f ? HIDDEN_LOG2 : FILLED_LOG2)) return none;
  found.confidence =
      max(border_feather(pixel, size, BORDER_FEATHER * size.x), 1e-4f) * mix(FILLED_CONFIDENCE, 1.0f, seen);
  found.confidence = mix(found.confidence, 1.0f, found.own);
  found.key = found.penalty + (found.confidence > 2.0f * FILLED_CONFIDENCE ? 0.0f : 100.0f);
  return found;
}

// Balanced sRGB with alpha. A photograph's own viewpoint shows its own colours.
GLSL_FUNCTION vec4 facade_colour_of(FacadeOpinion opinion) {
  vec4 texel = facade_texel(opinion.slot, opinion.at, opinion.level);
  FacadePhoto photo = facade_photo(opinion.photo);
  vec3 own = vec3(texel);
  vec3 balanced = vec3(photo.scale) * own + vec3(photo.offset);
  return vec4(mix(balanced, own, opinion.own), opinion.kind == int(TILE_ALPHA) ? texel.w : 1.0f);
}

// Shares of the colour: of the two best photographs, as they are balanced, and of the fallback; their sum is
// 1. `best` says something; what a photograph says that says nothing has no share. `third_key` is that of the
// next photograph, which takes over when the choice changes.
GLSL_FUNCTION vec3 facade_shares(FacadeOpinion best, FacadeOpinion second, float third_key) {
  // Where even the best are about to end nothing takes over but the fallback.
  float known = max(best.confidence, second.confidence);
  known = clamp(known / (best.key >= 100.0f ? FILLED_CONFIDENCE : 1.0f) / FADING_CONFIDENCE, 0.0f, 1.0f);
  if (second.key >= 1e9f) return vec3(known, 0.0f, 1.0f - known);
  // What is filled takes over from nothing seen.
  bool has_third = third_key < 1e9f && (third_key < 100.0f || best.key >= 100.0f);
  float max_penalty = has_third ? (third_key >= 100.0f ? third_key - 100.0f : third_key) : MAX_PENALTY;
  float of_best = best.confidence * max(blend_weight(best.penalty, max_penalty), 1e-6f);
  float of_second = second.confidence * max(blend_weight(second.penalty, max_penalty), 1e-6f);
  float share = of_second / (of_best + of_second);
  return vec3(known * (1.0f - share), known * share, 1.0f - known);
}

// sRGB and alpha of a point. `count` candidates from `first` on hold its triangle; `pixel_m` is what a pixel
// of the display covers there (0: not known); `to_eye` is of unit length; `fallback`, sRGB, stands where no
// photograph says anything. All in the facade's frame.
GLSL_FUNCTION vec4 facade_colour(vec3 position, vec3 to_eye, float pixel_m, int first, int count,
                                 vec3 fallback) {
  FacadeOpinion best = FacadeOpinion(1e9f, MAX_PENALTY, 0.0f, 0.0f, 0.0f, vec2(0.0f), 0, 0, 0);
  FacadeOpinion second = best;
  float third_key = 1e9f;
  for (int i = 0; i < count; ++i) {
    FacadeOpinion found = facade_opinion(facade_candidate(first + i), position, to_eye, pixel_m);
    if (found.key < best.key) {
      third_key = second.key;
      second = best;
      best = found;
    } else if (found.key < second.key) {
      third_key = second.key;
      second = found;
    } else {
      third_key = min(third_key, found.key);
    }
  }
  if (best.key >= 1e9f) return vec4(fallback, 1.0f);
  vec3 shares = facade_shares(best, second, third_key);
  vec4 colour = facade_colour_of(best);
  float share = shares.y / (shares.x + shares.y);
  if (share >= 0.004f) colour = mix(colour, facade_colour_of(second), share);
  return vec4(mix(vec3(colour), fallback, shares.z), colour.w);
}

// The colour, sRGB, that one photograph has stored at `at`. `tiles_across` 0: `at` are texels of the slot
// `first`; else pixels of a layer's box of so many tiles in a row, of which `first` is the first. `level` of
// the mipmaps: how much larger a pixel of the display is than one of the photograph, log2.
GLSL_FUNCTION vec3 facade_stored(vec2 at, int first, int tiles_across, float level) {
  int slot = first;
  vec2 in_slot = at;
  for (int i = 0; i < min(tiles_across, 1); ++i) {  // renderers in software skip loops, and no branches
    vec2 cell = floor(at / TILE_INNER);
    slot = int(facade_tile(first + int(cell.y) * tiles_across + int(cell.x)).y);
    in_slot = at - TILE_INNER * cell + vec2(TILE_BORDER);
  }
  float stored_level = clamp(level, 0.0f, float(TILE_LEVELS - 1));
  // Filters stay within the slot, see facade_opinion.
  float reach = stored_level > 1.0f ? 2.0f : (stored_level > 0.0f ? 1.0f : 0.5f);
  in_slot = clamp(in_slot, vec2(reach), vec2(TILE_INNER + 2.0f * TILE_BORDER - reach));
  return vec3(facade_texel(slot, in_slot, stored_level));
}
