// The fragment shader of all surfaces. A file that includes it defines
//   void look_along(vec3 position, vec3 direction)   finds what lies in the mirror direction
//   vec3 reflected_radiance(float roughness, int layer)   what comes from there, blurred; asked for each layer of a surface
// They may use `surface_sky_cell`, what the place sees of the sky. With WRITES_RAYS it tells in place of light where mirror
// rays leave (xyz; w: roughness of the base) and their way (octahedral; z: roughness of the coat, w: the object and 1).
#include "graphics/render/frame.glsl"
#include "graphics/render/anisotropy.glsl"
#include "graphics/render/body_lookup.glsl"
#include "graphics/render/sky_lookup.glsl"
#include "graphics/render/sun_lookup.glsl"
#include "graphics/shading/surface.glsl"
#include "graphics/shading/glass.glsl"
#include "graphics/shading/lighting.glsl"
#include "graphics/shading/octahedral.glsl"

const int base_layer = 0, coat_layer = 1;
const float greatest_radiance = 30000.0f;  // the target holds half floats

in vec3 position;
in vec3 vertex_normal;
in vec2 uv;
#ifdef IS_LEAF
in float leaf_sun;
in vec4 leaf_sky_cell;
#endif
flat in int object_of_surface;
#ifdef IS_MIRRORED
in vec3 seen_from;  // where the reflector shows it
const float seen_back = 0.1f;  // cosine: smooth normals turn away a little before their triangles do
#else
#define seen_from viewer_position.xyz
#endif
#ifdef WRITES_RAYS
layout(location = 0) out vec4 ray_start;
layout(location = 1) out vec4 ray_way;
#else
out vec4 radiance;
#endif

vec4 surface_sky_cell;

#ifdef IS_MIRRORED
bool is_mirrored_here();  // does the reflector show this point of the surface at all?
#endif
void look_along(vec3 at, vec3 direction);
vec3 reflected_radiance(float roughness, int layer);

#ifdef HAS_NEAR_PICTURE
uniform sampler2D near_picture;  // of the main view's size: what stands near, as its mirrors show it; coverage in alpha
uniform float near_share;        // 0: it shows what another mirror mirrors there, behind this one

// The picture is sharp. A rough layer blurs it widely: it shows that much less of it.
vec3 behind_near(vec3 far_radiance, float roughness) {
  float sharp = near_share * material_mirrors * (1.0f - smoothstep(0.15f, 0.72f, roughness));
  vec4 seen = sharp * texelFetch(near_picture, ivec2(gl_FragCoord.xy), 0);
  return seen.rgb + (1.0f - seen.a) * far_radiance;
}
#else
#define behind_near(far_radiance, roughness) far_radiance
#endif

#ifdef IS_GLASS
#ifdef HAS_GLASS_PICTURE
uniform sampler2D glass_picture;  // of the main view's size: what glass lets through; coverage in alpha
uniform float glass_share;        // 0: it shows what another glass lets through there
#endif

// What comes through glass; where that is not followed, the sky straight through it.
vec3 light_through(vec3 ahead) {
  vec3 sky = sky_share_of_direction(surface_sky_cell, ahead) * sky_radiance(ahead, 0.0f);
#ifdef HAS_GLASS_PICTURE
  vec4 seen = texelFetch(glass_picture, ivec2(gl_FragCoord.xy), 0);
  if (glass_share * seen.a > 0.0f) return seen.rgb / seen.a;
#endif
  return sky;
}
#endif

// Texture lookups where relief has moved the coordinates: neighbouring pixels no longer tell how wide a pixel is.
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
  relief_level = 0.5f * log2(max(abs(along_x.x * along_y.y - along_x.y * along_y.x) * size.x * size.y, 1e-8f));
  vec3 hit = relief_hit(at, uv_through_relief(frame, normal, -to_viewer, depth_m));
  if (dot(normal, frame_to_sun.xyz) > 0.0f && hit.z > 0.0f)
    sun *= relief_light(hit, uv_through_relief(frame, normal, frame_to_sun.xyz, depth_m));
  return hit.xy;
}
#endif

#ifdef HAS_NORMAL_MAP
// The normal map turns the normal within the frame of the triangle's texture gradients: +x along u, +y against v.
vec3 mapped_normal(vec3 normal, vec2 texture_uv, vec2 tx, vec2 ty) {
  vec3 px = dFdx(position), py = dFdy(position);
  float determinant = tx.x * ty.y - tx.y * ty.x;
  vec3 along_u = (px * ty.y - py * tx.y) * sign(determinant);
  vec3 along_v = (py * tx.x - px * ty.x) * sign(determinant);
  vec3 tangent = along_u - normal * dot(normal, along_u);
  float size = dot(tangent, tangent);
  if (size < 1e-20f || determinant == 0.0f) return normal;
  tangent *= inversesqrt(size);
  vec3 bitangent = cross(normal, tangent);
  bitangent *= dot(bitangent, along_v) > 0.0f ? -1.0f : 1.0f;
  vec3 n = looked_up(normal_texture, texture_uv, tx, ty).xyz * 2.0f - 1.0f;
  return normalize((tangent * n.x + bitangent * n.y) * material_emission.a + normal * max(n.z, 0.01f));
}
#endif

void main() {
  vec3 to_viewer = seen_from - position;
  float distance_m = length(to_viewer);
  to_viewer /= distance_m;
  vec3 normal = normalize(vertex_normal);
#ifdef IS_MIRRORED
  // A mirror image may be turned over: what faces front is told by the normal.
  bool is_front = dot(normal, to_viewer) > -seen_back;
  if (!is_mirrored_here()) discard;
#ifndef HAS_BACKS
  if (!is_front) discard;
#endif
#else
  bool is_front = gl_FrontFacing;
#endif
#ifdef HAS_BACKS
  if (!is_front) normal = -normal;
#endif

  vec2 texture_uv = texture_coordinates(uv);
  vec2 uv_along_x = dFdx(texture_uv), uv_along_y = dFdy(texture_uv);
  float sun = 1.0f;
#ifdef HAS_RELIEF
  texture_uv = through_relief(texture_uv, to_viewer, normal, uv_along_x, uv_along_y, sun);
#endif
#ifdef IS_LEAF
  vec4 base = texture(base_colour_texture, texture_uv);
#else
  vec4 base = base_colour_at(texture_uv, uv_along_x, uv_along_y);
#endif
  base = vec4(base.rgb * material_base_colour.rgb, base.a * material_base_colour.a);
#ifdef HAS_HOLES
#ifdef ONE_SAMPLE
  // Without multisampling there is no coverage by alpha. (Where there is, a shader that discards nothing is faster.)
  if (base.a < 0.5f) discard;
#else
  // Alpha to coverage: sharpen the edge to a pixel's width, so that leaves neither swell nor thin out far away.
  base.a = clamp((base.a - 0.5f) / max(fwidth(base.a), 1e-4f) + 0.5f, 0.0f, 1.0f);
#endif
#endif

#ifdef HAS_SURFACE_MAP
  vec3 detail = looked_up(surface_texture, texture_uv, uv_along_x, uv_along_y).rgb;
#else
  vec3 detail = vec3(1.0f);
#endif

  Surface s;
#ifdef HAS_NORMAL_MAP
  s.normal = mapped_normal(normal, texture_uv, uv_along_x, uv_along_y);
#else
  s.normal = normal;
#endif
  s.base_colour = base.rgb;
  s.metallic = material_layers.x * detail.b;
  s.roughness = material_layers.y * detail.g;
#ifdef HAS_COAT
  s.clear_coat = material_layers.z;
#else
  s.clear_coat = 0.0f;
#endif
  s.clear_coat_roughness = material_layers.w;
  s.translucency = material_texture_u.w;
  s.occlusion = detail.r;
  s.emission = material_emission.rgb;
#ifdef HAS_EMISSION_MAP
  s.emission *= looked_up(emission_texture, texture_uv, uv_along_x, uv_along_y).rgb;
#endif

#ifdef IS_GLASS
  s = glass_surface(s, material_ior);
#endif

  vec3 mirrored = reflect(-to_viewer, s.normal);
#ifdef WRITES_RAYS
  ray_start = vec4(position, s.roughness);
  ray_way = vec4(octahedral_uv(mirrored), s.clear_coat_roughness, float(object_of_surface + 1));
#else
  SceneLight light;
  light.to_sun = frame_to_sun.xyz;
  light.sun_irradiance = frame_sun_irradiance.rgb;
  for (int i = 0; i < 9; ++i) light.sky_sh[i] = frame_sky_sh[i].rgb;
  light.haze_radiance = frame_haze.rgb;
  light.haze_per_m = frame_to_sun.w;

#ifdef IS_LEAF
  surface_sky_cell = leaf_sky_cell;
  sun *= leaf_sun;
#else
  surface_sky_cell = shaded_cell(sky_visibility_cell(position, normal),
                                 sky_share_beside_bodies(position, normal, object_of_surface));
  sun *= visible_sun(position, normal);
#endif
  look_along(position, mirrored);
  vec3 base_reflection = behind_near(reflected_radiance(s.roughness, base_layer), s.roughness);
#ifdef HAS_COAT
  vec3 coat_reflection =
      behind_near(reflected_radiance(s.clear_coat_roughness, coat_layer), s.clear_coat_roughness);
#else
  vec3 coat_reflection = vec3(0.0f);
#endif
#ifdef IS_GLASS
  s.emission += (vec3(1.0f) - base_reflectance(s, clamp(dot(s.normal, to_viewer), 1e-4f, 1.0f))) * light_through(-to_viewer);
#endif
  vec3 light_out = lit_radiance(s, light, to_viewer, sun,
                                sky_share_of_normal(surface_sky_cell, s.normal), base_reflection, coat_reflection);
  light_out = through_haze(light_out, distance_m, light.haze_per_m, light.haze_radiance);
  radiance = vec4(min(light_out, vec3(greatest_radiance)), base.a);
#endif
}
