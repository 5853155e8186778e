// Fragment shader of all surfaces, in four steps: viewing geometry, material, incident light, radiance toward
// the viewer. The including file defines
//   void look_along(vec3 position, vec3 direction)        prepares what the mirror ray hits
//   vec3 reflected_radiance(float roughness, int layer)   its radiance, prefiltered for the layer
// Both may use `surface_sky_cell`, the sky visibility of the point. The define SURFACE names the file that
// evaluates the material: material_surface.glsl or a room's own. REFLECTION_OVERLAY and TRANSMISSION_OVERLAY
// are expressions of rooms above (SurfaceSource in surface_programs.h). A view may ask for other output than
// radiance:
//   WRITES_SURFACE  void write_surface(Surface surface, vec3 to_viewer) of the including file
//   WRITES_OBJECT   the object's number plus 1
//   WRITES_DEPTH    depth alone
#include "graphics/render/frame.glsl"
#include "graphics/render/body_lookup.glsl"
#include "graphics/render/sky_lookup.glsl"
#include "graphics/render/sun_lookup.glsl"
#include "graphics/shading/surface.glsl"
#include "graphics/shading/glass.glsl"
#include "graphics/shading/lighting.glsl"

const int base_layer = 0, coat_layer = 1;
const float max_radiance = 30000.0f;  // the target holds half floats

in vec3 position;
in vec3 vertex_normal;
in vec2 uv;
#ifdef IS_LEAF
in float leaf_sun;
in vec4 leaf_sky_cell;
#endif
flat in int object_of_surface;
#ifdef IS_MIRRORED
in vec3 seen_from;             // origin of the mirrored ray
const float seen_back = 0.1f;  // cosine: interpolated normals face away slightly before their triangles do
#else
#define seen_from viewer_position.xyz
#endif
#if defined(WRITES_SURFACE)
void write_surface(Surface surface, vec3 to_viewer);
#elif defined(WRITES_OBJECT)
out uint object_and_one;
#elif !defined(WRITES_DEPTH)
out vec4 radiance;
#endif
#ifndef REFLECTION_OVERLAY
#define REFLECTION_OVERLAY(radiance, roughness) radiance
#define TRANSMISSION_OVERLAY(radiance) radiance
#endif

vec4 surface_sky_cell;
uniform highp sampler2D traced_sun_texture;  // of the view's pixels: share of the sun, distance to the viewer

#ifdef IS_MIRRORED
bool is_mirrored_here();  // true if the reflector shows this point of the surface
#endif
void look_along(vec3 at, vec3 direction);
vec3 reflected_radiance(float roughness, int layer);

// Viewing geometry of a surface point.
struct SeenPoint {
  vec3 to_viewer;    // unit; in shadow maps toward the sun
  float distance_m;  // to the viewer
  vec3 normal;       // unit, interpolated; on the viewer's side where backs are shown
};

#include SURFACE "graphics/render/material_surface.glsl"

#ifndef surface_mirrors
#define surface_mirrors 0.0f  // 1: uses the scene's reflection method on objects that take reflections
#endif

#ifdef IS_GLASS
// Radiance through glass: the sky straight through it, unless an overlay refracts the ray.
vec3 light_through(vec3 ahead) {
  vec3 sky = sky_share_of_direction(surface_sky_cell, ahead) * sky_radiance(ahead, 0.0f);
  return TRANSMISSION_OVERLAY(sky);
}
#endif

SeenPoint seen_point() {
  SeenPoint seen;
  seen.to_viewer = seen_from - position;
  seen.distance_m = length(seen.to_viewer);
  seen.to_viewer /= seen.distance_m;
  seen.normal = normalize(vertex_normal);
#ifdef IS_MIRRORED
  // A mirror image may be flipped: the normal decides which side faces front.
  bool is_front = dot(seen.normal, seen.to_viewer) > -seen_back;
  if (!is_mirrored_here()) discard;
#ifndef HAS_BACKS
  if (!is_front) discard;
#endif
#else
  bool is_front = gl_FrontFacing;
#endif
#ifdef HAS_BACKS
  if (!is_front) seen.normal = -seen.normal;
#endif
  return seen;
}

// Coverage by alpha, for multisampled targets sharpened to the width of a pixel, so that distant leaves
// neither swell nor thin out. (A shader without discard is faster.)
float covered(float alpha) {
#if defined(HAS_HOLES) && defined(ONE_SAMPLE)
  if (alpha < 0.5f) discard;
  return alpha;
#elif defined(HAS_HOLES)
  return clamp((alpha - 0.5f) / max(fwidth(alpha), 1e-4f) + 0.5f, 0.0f, 1.0f);
#else
  return alpha;
#endif
}

SceneLight scene_light() {
  SceneLight light;
  light.to_sun = to_sun_at(position);
  light.sun_irradiance = frame_sun_irradiance.rgb;
  for (int i = 0; i < 9; ++i) light.sky_sh[i] = frame_sky_sh[i].rgb;
  light.haze_radiance = frame_haze.rgb;
  light.haze_per_m = frame_to_sun.w;
  return light;
}

// Of objects that receive no shadows, the complement of their number is given.
int surface_object() { return object_of_surface < 0 ? ~object_of_surface : object_of_surface; }

#ifndef WRITES_SURFACE
// The sun as rays found it in the pixel or beside it, where they hit this surface; else as the maps have it.
float traced_sun(float drawn, float distance_m) {
  float share = drawn, nearest = 0.01f * distance_m;
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  int taps = frame_shadow_extra.y > 0.5f ? 5 : 0;  // no branch: a loop without rounds is left out
  for (int i = 0; i < taps; ++i) {
    ivec2 beside = ivec2(int(i == 1) - int(i == 2), int(i == 3) - int(i == 4));
    vec2 traced =
        texelFetch(traced_sun_texture, clamp(pixel + beside, ivec2(0), ivec2(frame_size.xy) - 1), 0).rg;
    float off = abs(traced.g - distance_m);
    share = off < nearest ? traced.r * sun_cone(to_sun_at(position)) : share;
    nearest = min(off, nearest);
  }
  return share;
}
#endif

// Visibility of the sky, stored in `surface_sky_cell`, and of the sun, returned.
float visible_light(SeenPoint seen) {
#ifdef IS_LEAF
  surface_sky_cell = leaf_sky_cell;
  float drawn = leaf_sun;
#else
  surface_sky_cell = shaded_cell(sky_visibility_cell(position, seen.normal),
                                 sky_share_beside_bodies(position, seen.normal, surface_object()));
  float drawn = visible_sun(position, seen.normal);
#endif
#ifndef WRITES_SURFACE
  drawn = traced_sun(drawn, seen.distance_m);
#endif
  return object_of_surface < 0 ? sun_cone(to_sun_at(position)) : drawn;
}

#ifndef WRITES_SURFACE  // a file that writes the surface has no reflected_radiance: references would not link
// Radiance toward the viewer, through the haze; `sun`: share of the sun that the surface's own relief lets
// in.
vec3 radiance_of(Surface s, SeenPoint seen, float sun) {
  SceneLight light = scene_light();
  sun *= visible_light(seen);
  look_along(position, reflect(-seen.to_viewer, s.normal));
  vec3 base_reflection = REFLECTION_OVERLAY(reflected_radiance(s.roughness, base_layer), s.roughness);
#ifdef HAS_COAT
  vec3 coat_reflection =
      REFLECTION_OVERLAY(reflected_radiance(s.clear_coat_roughness, coat_layer), s.clear_coat_roughness);
#else
  vec3 coat_reflection = vec3(0.0f);
#endif
#ifdef IS_GLASS
  s.emission += (vec3(1.0f) - base_reflectance(s, clamp(dot(s.normal, seen.to_viewer), 1e-4f, 1.0f))) *
                light_through(-seen.to_viewer);
#endif
  vec3 light_out =
      lit_radiance(s, light, seen.to_viewer, sun, sky_share_of_normal(surface_sky_cell, s.normal),
                   base_reflection, coat_reflection);
  return through_haze(light_out, seen.distance_m, light.haze_per_m, light.haze_radiance);
}
#endif

void main() {
  SeenPoint seen = seen_point();
  float sun = 1.0f, alpha;
  Surface s = surface_at(seen, sun, alpha);
  alpha = covered(alpha);
#if defined(WRITES_SURFACE)
  write_surface(s, seen.to_viewer);
#elif defined(WRITES_OBJECT)
  object_and_one = uint(surface_object() + 1);
#elif !defined(WRITES_DEPTH)
  radiance = vec4(min(radiance_of(s, seen, sun), vec3(max_radiance)), alpha);
#endif
}
