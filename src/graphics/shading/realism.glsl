// One scale from a sketch to a photograph (scene::Realism), by what it takes from a picture. Shared by
// shaders and ray tracer.

// x: share of white in colours; y: of their textures and relief; z: of gloss, glow and reflections; w: of the
// paper that a sketch is washed on. Everything: (0, 1, 1, 0).
GLSL_FUNCTION vec4 realism_at(float level) {
  float to_white = clamp(4.0f * level, 0.0f, 1.0f);
  float to_colours = clamp(4.0f * level - 1.0f, 0.0f, 1.0f);
  const float washed_white = 0.35f, washed_texture = 0.7f;  // of a sketch: its washes have some colour
  return vec4(mix(washed_white, 1.0f, to_white) * (1.0f - to_colours),
              max(clamp(4.0f * level - 2.0f, 0.0f, 1.0f), washed_texture * (1.0f - to_white)),
              clamp(4.0f * level - 3.0f, 0.0f, 1.0f), 1.0f - to_white);
}

GLSL_FUNCTION bool shows_everything(vec4 realism) { return realism.z >= 1.0f; }

// Share of ink in edges: of those where surfaces meet.
GLSL_FUNCTION float ink_at(float level) {
  return level < 0.25f ? mix(1.0f, 0.75f, 4.0f * level) : clamp(1.125f - 1.5f * level, 0.0f, 1.0f);
}

// A surface as the scale shows it; `normal` is that of its geometry.
GLSL_FUNCTION Surface simplified(Surface s, vec3 normal, vec4 realism) {
  const vec3 model_white = vec3(0.78f, 0.77f, 0.75f);
  s.base_colour = mix(s.base_colour, model_white, realism.x);
  s.normal = normalize(mix(normal, s.normal, realism.y));
  s.metallic *= realism.z;
  s.roughness = mix(1.0f, s.roughness, realism.z);
  s.clear_coat *= realism.z;
  s.emission *= 1.0f - realism.x;
  return s;
}

// A colour as a wash on paper: in few steps of light whose edges run, thin enough that the paper shines
// through. Both colours are displayed ones (sRGB).
GLSL_FUNCTION vec3 washed(vec3 colour, float paper_share) {
  const vec3 paper = vec3(0.973f, 0.961f, 0.929f);
  const float steps = 4.0f, thinness = 0.42f;
  float light = max(dot(colour, vec3(0.30f, 0.59f, 0.11f)), 1e-3f);
  float step_light = (floor(steps * light) + smoothstep(0.25f, 0.75f, fract(steps * light))) / steps;
  vec3 wash = colour * (mix(light, step_light, 0.6f) / light);
  return mix(colour, paper * mix(wash, vec3(1.0f), thinness), paper_share);
}
