// A surface in the light of a moment: Parvis's own shading (graphics/shading), with what a page knows of sky
// and sun. Defines: HAS_MAP, HAS_HOLES, HAS_COLOURS, HAS_OPENNESS, HAS_NORMAL_MAP, HAS_SURFACE_MAP,
// HAS_OCCLUSION_MAP, HAS_EMISSION_MAP, HAS_COAT, HAS_BACKS, IS_GLASS,
// HAS_RELIEF: all maps lie as the base colour does.

uniform vec3 viewer;
uniform mat3 base_from_uv, normal_from_uv, surface_from_uv, occlusion_from_uv, emission_from_uv;
uniform vec4 base_colour;
uniform vec3 emission;
uniform vec4 layers;  // metallic, roughness, clear coat, its roughness
uniform float translucency, normal_scale, occlusion_strength, alpha_cutoff, ior, relief_m;
uniform sampler2D base_map, normal_map, surface_map, occlusion_map, emission_map;

in vec3 at;
in vec3 vertex_normal;
in vec2 uv_1;
in vec2 uv_2;
in vec4 vertex_colour;
out vec4 colour;

vec2 moved(mat3 from_uv, vec2 at_uv) { return (from_uv * vec3(at_uv, 1.0)).xy; }

#ifdef HAS_RELIEF
float relief_level;

float relief_depth(vec2 at_uv) { return 1.0 - textureLod(normal_map, at_uv, relief_level).a; }
GLSL_OF_RELIEF

// Moves `at_uv` to where the view meets the relief; `sun` loses what the edge of the opening keeps out.
vec2 through_relief(vec2 at_uv, vec3 to_viewer, vec3 normal, vec2 along_x, vec2 along_y, inout float sun) {
  TextureFrame frame = TextureFrame(dFdx(at), dFdy(at), along_x, along_y);
  float depth_m = relief_m * relief_share(min(length(frame.step_1), length(frame.step_2)), relief_m);
  if (depth_m <= 0.0) return at_uv;
  vec2 size = vec2(textureSize(normal_map, 0));
  relief_level = 0.5 * log2(max(abs(along_x.x * along_y.y - along_x.y * along_y.x) * size.x * size.y, 1e-8));
  vec3 hit = relief_hit(at_uv, uv_through_relief(frame, normal, -to_viewer, depth_m));
  if (dot(normal, to_sun) > 0.0 && hit.z > 0.0)
    sun *= relief_light(hit, uv_through_relief(frame, normal, to_sun, depth_m));
  return hit.xy;
}
#define looked_up(map, from_uv, at_uv) textureGrad(map, base_uv, along_x, along_y)
#else
#define looked_up(map, from_uv, at_uv) texture(map, moved(from_uv, at_uv))
#endif

void main() {
  vec3 to_viewer = viewer - at;
  float distance_m = length(to_viewer);
  to_viewer /= distance_m;
  vec3 geometric = normalize(vertex_normal);
#ifdef HAS_BACKS
  if (!gl_FrontFacing) geometric = -geometric;
#endif
  vec2 base_uv = moved(base_from_uv, BASE_UV);
  float relief_sun = 1.0;
#ifdef HAS_RELIEF
  vec2 along_x = dFdx(base_uv), along_y = dFdy(base_uv);
  base_uv = through_relief(base_uv, to_viewer, geometric, along_x, along_y, relief_sun);
#endif
  vec4 base = vec4(1.0);
#ifdef HAS_MAP
  base = looked_up(base_map, base_from_uv, BASE_UV);
  if (frame_realism.y < 1.0)
    base.rgb = mix(textureLod(base_map, vec2(0.5), 16.0).rgb, base.rgb, frame_realism.y);
#endif
#ifdef HAS_COLOURS
  base.rgb *= vertex_colour.rgb;
#ifndef HAS_OPENNESS
  base.a *= vertex_colour.a;
#endif
#endif
  base *= base_colour;
  float alpha = base.a;
#ifdef HAS_HOLES
  alpha = clamp((alpha - alpha_cutoff) / max(fwidth(alpha), 1e-4) + 0.5, 0.0, 1.0);
  if (alpha <= 0.0) discard;
#endif
  vec3 detail = vec3(1.0);
#ifdef HAS_SURFACE_MAP
  detail.gb = looked_up(surface_map, surface_from_uv, SURFACE_UV).gb;
#endif
#ifdef HAS_OCCLUSION_MAP
  detail.r = mix(1.0, looked_up(occlusion_map, occlusion_from_uv, OCCLUSION_UV).r, occlusion_strength);
#endif
#ifdef HAS_OPENNESS
  detail.r *= vertex_colour.a;
#endif
  vec3 normal = geometric;
#ifdef HAS_NORMAL_MAP
  vec2 normal_uv = moved(normal_from_uv, NORMAL_UV);
  normal = mapped_normal(TextureFrame(dFdx(at), dFdy(at), dFdx(normal_uv), dFdy(normal_uv)), geometric,
                         looked_up(normal_map, normal_from_uv, NORMAL_UV).xyz, normal_scale);
#endif
  vec3 glow = emission;
#ifdef HAS_EMISSION_MAP
  glow *= looked_up(emission_map, emission_from_uv, EMISSION_UV).rgb;
#endif
  Surface s = assembled_surface(normal, base.rgb, detail, glow, layers, translucency);
#ifdef IS_GLASS
  s = glass_surface(s, ior);
#endif
  if (!shows_everything(frame_realism)) s = simplified(s, geometric, frame_realism);

  BouncedCell bounced = bounced_cell(at, geometric);
  SceneLight light;
  light.to_sun = to_sun;
  light.sun_irradiance = sun_irradiance;
  for (int i = 0; i < 9; ++i) light.sky_sh[i] = bounced.sky * sky_sh[i];
  light.bounced = bounced_irradiance(bounced, s.normal);
  light.bounced_behind = bounced_irradiance(bounced, -s.normal);
  light.haze_radiance = haze_radiance;
  light.haze_per_m = haze_per_m;
  vec4 cell = visibility_cell(at, geometric);
  float sun = relief_sun * sun_visibility(shadow_maps(), at, geometric, to_sun);
  vec3 base_reflection = surroundings(cell, bounced, reflect(-to_viewer, s.normal), s.roughness);
  vec3 coat_reflection = vec3(0.0);
#ifdef HAS_COAT
  coat_reflection = surroundings(cell, bounced, reflect(-to_viewer, s.normal), s.clear_coat_roughness);
#endif
#ifdef IS_GLASS
  s.emission += (vec3(1.0) - base_reflectance(s, clamp(dot(s.normal, to_viewer), 1e-4, 1.0))) *
                surroundings(cell, bounced, -to_viewer, 0.0);
#endif
  vec3 radiance = lit_radiance(s, light, to_viewer, sun, sky_share_of_normal(cell, s.normal), base_reflection,
                               coat_reflection);
  colour = vec4(displayed(through_haze(radiance, distance_m, haze_per_m, haze_radiance)), alpha);
}
