// The fragment shader of all surfaces: how the point is seen, what the surface is like there, what light comes to it, and
// what of that goes to the viewer. A file that includes it defines
//   void look_along(vec3 position, vec3 direction)   finds what lies in the mirror direction
//   vec3 reflected_radiance(float roughness, int layer)   what comes from there, blurred; asked for each layer of a surface
// They may use `surface_sky_cell`, what the place sees of the sky. The define SURFACE names the file that says what the
// surface is like: material_surface.glsl or a room's own. REFLECTION_OVERLAY and TRANSMISSION_OVERLAY are expressions of rooms
// above (SurfaceSource in surface_programs.h). In place of light a view may be given:
//   WRITES_SURFACE  what the including file makes of it: void write_surface(Surface surface, vec3 to_viewer)
//   WRITES_OBJECT   the object's number and 1
//   WRITES_DEPTH    nothing but depth
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
in vec3 seen_from;  // where the reflector shows it
const float seen_back = 0.1f;  // cosine: smooth normals turn away a little before their triangles do
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

#ifdef IS_MIRRORED
bool is_mirrored_here();  // does the reflector show this point of the surface at all?
#endif
void look_along(vec3 at, vec3 direction);
vec3 reflected_radiance(float roughness, int layer);

// A point of a surface as it is seen.
struct SeenPoint {
  vec3 to_viewer;    // unit; in shadow maps toward the sun
  float distance_m;  // to the viewer
  vec3 normal;       // unit, interpolated; on the viewer's side where backs are shown
};

#include SURFACE "graphics/render/material_surface.glsl"

#ifndef surface_mirrors
#define surface_mirrors 0.0f  // 1: takes the scene's reflection method on things that do
#endif

#ifdef IS_GLASS
// What comes through glass; where no overlay follows it, the sky straight through it.
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

// Where there are many samples in a pixel, alpha covers some of them: sharpened to a pixel's width, so that leaves neither
// swell nor thin out far away. (A shader that discards nothing is faster.)
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
  light.to_sun = frame_to_sun.xyz;
  light.sun_irradiance = frame_sun_irradiance.rgb;
  for (int i = 0; i < 9; ++i) light.sky_sh[i] = frame_sky_sh[i].rgb;
  light.haze_radiance = frame_haze.rgb;
  light.haze_per_m = frame_to_sun.w;
  return light;
}

// What the place sees of the sky, in `surface_sky_cell`, and of the sun.
float visible_light(SeenPoint seen) {
#ifdef IS_LEAF
  surface_sky_cell = leaf_sky_cell;
  return leaf_sun;
#else
  surface_sky_cell = shaded_cell(sky_visibility_cell(position, seen.normal),
                                 sky_share_beside_bodies(position, seen.normal, object_of_surface));
  return visible_sun(position, seen.normal);
#endif
}

#ifndef WRITES_SURFACE  // a file that writes something else has no reflections to ask for: references would not link
// Radiance toward the viewer, through the haze; `sun`: what the surface's own shape lets in.
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
  s.emission +=
      (vec3(1.0f) - base_reflectance(s, clamp(dot(s.normal, seen.to_viewer), 1e-4f, 1.0f))) * light_through(-seen.to_viewer);
#endif
  vec3 light_out = lit_radiance(s, light, seen.to_viewer, sun, sky_share_of_normal(surface_sky_cell, s.normal),
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
  object_and_one = uint(object_of_surface + 1);
#elif !defined(WRITES_DEPTH)
  radiance = vec4(min(radiance_of(s, seen, sun), vec3(max_radiance)), alpha);
#endif
}
