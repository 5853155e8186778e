// What a surface is like by its material: the block of material.glsl and its textures. A room that draws by
// itself has a file of its own in place of this one, with
//   Surface surface_at(SeenPoint seen, inout float sun, out float alpha)
// which may take from `sun` what the surface itself keeps out. `alpha` counts where HAS_HOLES is defined, and
// in passes that blend.
#include "graphics/render/anisotropy.glsl"
#include "graphics/shading/texture_frame.glsl"

#define surface_mirrors material_mirrors

// Texture lookups where relief has moved the coordinates: neighbouring pixels no longer tell how wide a pixel
// is.
#ifdef HAS_RELIEF
vec4 looked_up(sampler2D picture, vec2 at, vec2 along_x, vec2 along_y) {
  return textureGrad(picture, at, along_x, along_y);
}
#else
#define looked_up(picture, at, along_x, along_y) texture(picture, at)
#endif

#ifdef HAS_RELIEF
float relief_level;

float relief_depth(vec2 at) { return 1.0f - textureLod(normal_texture, at, relief_level).a; }
#include "graphics/shading/relief.glsl"

// Moves `at` to where the view meets the relief; `sun` loses what the edge of the opening keeps out.
vec2 through_relief(vec2 at, vec3 to_viewer, vec3 normal, vec2 along_x, vec2 along_y, inout float sun) {
  TextureFrame frame = TextureFrame(dFdx(position), dFdy(position), along_x, along_y);
  float pixel_m = min(length(frame.step_1), length(frame.step_2));
  float depth_m = material_relief_m * relief_share(pixel_m, material_relief_m);
  if (depth_m <= 0.0f) return at;
  vec2 size = vec2(textureSize(normal_texture, 0));
  relief_level =
      0.5f * log2(max(abs(along_x.x * along_y.y - along_x.y * along_y.x) * size.x * size.y, 1e-8f));
  vec3 hit = relief_hit(at, uv_through_relief(frame, normal, -to_viewer, depth_m));
  if (dot(normal, frame_to_sun.xyz) > 0.0f && hit.z > 0.0f)
    sun *= relief_light(hit, uv_through_relief(frame, normal, frame_to_sun.xyz, depth_m));
  return hit.xy;
}
#endif

#ifdef HAS_OWN_MAPPINGS
// Coordinates of a texture that lies in a way of its own.
vec2 own_coordinates(vec4 u, vec4 v) {
  vec3 p = vec3(u.w > 0.5f ? second_uv : uv, 1.0f);
  return vec2(dot(u.xyz, p), dot(v.xyz, p));
}
#endif

vec3 normal_at(SeenPoint seen, vec2 texture_uv, vec2 along_x, vec2 along_y) {
#ifdef HAS_NORMAL_MAP
#ifdef HAS_OWN_MAPPINGS
  texture_uv = own_coordinates(material_normal_u, material_normal_v);
  along_x = dFdx(texture_uv), along_y = dFdy(texture_uv);
#endif
  vec3 texel = looked_up(normal_texture, texture_uv, along_x, along_y).xyz;
  return mapped_normal(TextureFrame(dFdx(position), dFdy(position), along_x, along_y), seen.normal, texel,
                       material_emission.a);
#else
  return seen.normal;
#endif
}

vec4 base_at(vec2 texture_uv, vec2 along_x, vec2 along_y) {
#ifdef IS_LEAF
  vec4 base = texture(base_colour_texture, texture_uv);
#else
  vec4 base = base_colour_at(texture_uv, along_x, along_y);
  if (frame_realism.y < 1.0f)  // plain: the texture's mean
    base.rgb = mix(textureLod(base_colour_texture, vec2(0.5f), 16.0f).rgb, base.rgb, frame_realism.y);
#endif
#ifdef HAS_COLOURS
  base *= vertex_colour;
#endif
  return vec4(base.rgb * material_base_colour.rgb, base.a * material_base_colour.a);
}

// Occlusion, roughness, metallic.
vec3 detail_at(vec2 texture_uv, vec2 along_x, vec2 along_y) {
  vec3 detail = vec3(1.0f);
#ifdef HAS_SURFACE_MAP
#ifdef HAS_OWN_MAPPINGS
  texture_uv = own_coordinates(material_surface_u, material_surface_v);
#endif
  detail = looked_up(surface_texture, texture_uv, along_x, along_y).rgb;
#endif
#ifdef HAS_OCCLUSION_MAP
#ifdef HAS_OWN_MAPPINGS
  texture_uv = own_coordinates(material_occlusion_u, material_occlusion_v);
#endif
  detail.r = looked_up(occlusion_texture, texture_uv, along_x, along_y).r;
#endif
#if defined(HAS_SURFACE_MAP) || defined(HAS_OCCLUSION_MAP)
  detail.r = mix(1.0f, detail.r, material_occlusion);
#endif
  return detail;
}

vec3 emission_at(vec2 texture_uv, vec2 along_x, vec2 along_y) {
#ifdef HAS_EMISSION_MAP
#ifdef HAS_OWN_MAPPINGS
  texture_uv = own_coordinates(material_emission_u, material_emission_v);
#endif
  return material_emission.rgb * looked_up(emission_texture, texture_uv, along_x, along_y).rgb;
#else
  return material_emission.rgb;
#endif
}

Surface surface_at(SeenPoint seen, inout float sun, out float alpha) {
  vec2 texture_uv = texture_coordinates(uv);
  vec2 along_x = dFdx(texture_uv), along_y = dFdy(texture_uv);
#ifdef HAS_RELIEF
  texture_uv = through_relief(texture_uv, seen.to_viewer, seen.normal, along_x, along_y, sun);
#endif
  vec4 base = base_at(texture_uv, along_x, along_y);
  vec3 detail = detail_at(texture_uv, along_x, along_y);
  alpha = base.a;

  Surface s =
      assembled_surface(normal_at(seen, texture_uv, along_x, along_y), base.rgb, detail,
                        emission_at(texture_uv, along_x, along_y), material_layers, material_texture_u.w);
#ifndef HAS_COAT
  s.clear_coat = 0.0f;
#endif
#ifdef IS_GLASS
  s = glass_surface(s, material_ior);
#endif
  return s;
}
