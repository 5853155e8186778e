// Fragment shader of all surfaces, in four steps: viewing geometry, material, incident light, radiance toward
// the viewer. The including file defines
//   void look_along(vec3 position, vec3 direction)        prepares what the mirror ray hits
//   vec3 reflected_radiance(float roughness, int layer)   its radiance, prefiltered for the layer
// Both may use unmapped_radiance, of incident_light.glsl. The define SURFACE names the file that
// evaluates the material: material_surface.glsl or a room's own. REFLECTION_OVERLAY and TRANSMISSION_OVERLAY
// are expressions of rooms above (SurfaceSource in surface_programs.h). A view may ask for other output than
// radiance:
//   WRITES_SURFACE  void write_surface(Surface surface, vec3 to_viewer) of the including file
//   WRITES_OBJECT   the object's number plus 1
//   WRITES_DEPTH    depth alone
#include "graphics/render/frame.glsl"
#include "graphics/render/body_lookup.glsl"
#include "graphics/render/corner_light.glsl"
#include "graphics/render/lamp_lookup.glsl"
#include "graphics/render/sun_lookup.glsl"
#include "graphics/render/surroundings.glsl"
#include "graphics/shading/surface.glsl"
#include "graphics/shading/realism.glsl"
#include "graphics/shading/glass.glsl"
#include "graphics/shading/lighting.glsl"
#include "graphics/render/surface_interface.glsl"

// Viewing geometry of a surface point.
struct SeenPoint {
  vec3 to_viewer;    // unit; in shadow maps toward the sun
  float distance_m;  // to the viewer
  vec3 normal;       // unit, interpolated; on the viewer's side where backs are shown
};

#ifdef RECEIVES_INSERTED
#include "graphics/shading/recorded_shadow.glsl"
float kept_in_shadow = 1.0f;  // set by the surface: kept_in_shadow_of
#endif

#include SURFACE "graphics/render/material_surface.glsl"

#ifndef surface_mirrors
#define surface_mirrors 0.0f  // 1: uses the scene's reflection method on objects that take reflections
#endif

#include "graphics/render/incident_light.glsl"

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
#ifdef HAS_VERTEX_LIGHT
  light_before = is_front ? vertex_light : vertex_light_behind;
  light_behind = is_front ? vertex_light_behind : vertex_light;
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

#ifdef IS_GLASS
// Radiance through glass: what lies straight ahead, unless an overlay refracts the ray.
vec3 light_through(vec3 ahead) {
  vec3 unmapped = unmapped_radiance(ahead, 0.0f);
  return TRANSMISSION_OVERLAY(unmapped);
}
#endif

#ifdef IS_RECORDED
// Radiance toward the viewer, through the haze: what a photograph recorded holds the light of its scene
// already.
vec3 radiance_of(Surface s, SeenPoint seen, float sun) {
#ifdef RECEIVES_INSERTED
  vec3 to_sun = to_sun_at(position);
  float facing = frame_inserted_texel.z > 0.0f ? dot(seen.normal, to_sun) : 0.0f;
  if (facing > 0.0f)
    s.emission *= kept_recorded_light(kept_in_shadow, facing,
                                      sun_visibility(frame_shadow_maps(), position, seen.normal, to_sun));
#endif
  return through_haze(s.emission, seen.distance_m, frame_to_sun.w, frame_haze.rgb);
}
#elif defined(IS_SPECK)
vec3 radiance_of(Surface s, SeenPoint seen, float sun) {
  return speck_radiance + seen_sun(seen) * speck_sunlight;
}
#elif defined(IS_LEAF)
// Radiance toward the viewer, through the haze, of what was lit at its corners. The middle of a pixel may lie
// outside of a small leaf, where light that goes on from corner to corner falls below zero.
vec3 radiance_of(Surface s, SeenPoint seen, float sun) {
  CornerLight light = CornerLight(max(leaf_light, vec3(0.0f)), max(leaf_light_behind, vec3(0.0f)),
                                  max(leaf_lamps, vec3(0.0f)), max(leaf_mirrored, vec3(0.0f)));
  vec3 to_sun = to_sun_at(position), sunlight = seen_sun(seen) * frame_sun_irradiance.rgb;
#ifdef HAS_VERTEX_LIGHT
  light.irradiance = light_before, light.irradiance_behind = light_behind;
  vec3 light_out = sun_highlights(s, seen.to_viewer, to_sun, sunlight);
#else
  vec3 light_out = direct_radiance(s, seen.to_viewer, to_sun, sunlight);
#endif
  light_out += radiance_of_corner_light(s, seen.to_viewer, light);
  return through_haze(light_out, seen.distance_m, frame_to_sun.w, frame_haze.rgb);
}
#elif !defined(WRITES_SURFACE)  // a file that writes it has no reflected_radiance: references would not link
// Radiance toward the viewer, through the haze; `sun`: share of the sun that the surface's own relief lets
// in.
vec3 radiance_of(Surface s, SeenPoint seen, float sun) {
  SceneLight light = scene_light(seen.normal, s.normal);
  look_at_sky(seen);
  sun *= seen_sun(seen);
  look_along(position, reflect(-seen.to_viewer, s.normal));
  vec3 base_reflection = REFLECTION_OVERLAY(reflected_radiance(s.roughness, base_layer), s.roughness);
#ifdef HAS_COAT
  vec3 coat_reflection =
      REFLECTION_OVERLAY(reflected_radiance(s.clear_coat_roughness, coat_layer), s.clear_coat_roughness);
#else
  vec3 coat_reflection = vec3(0.0f);
#endif
#ifdef IS_GLASS
  s.emission += (1.0f - frame_realism.x) *
                (vec3(1.0f) - base_reflectance(s, clamp(dot(s.normal, seen.to_viewer), 1e-4f, 1.0f))) *
                light_through(-seen.to_viewer);
#endif
#ifdef HAS_VERTEX_LIGHT
  vec3 light_out = vertex_lit_radiance(s, light, light_before, light_behind, seen.to_viewer, sun,
                                       base_reflection, coat_reflection);
#else
  vec3 light_out =
      lit_radiance(s, light, seen.to_viewer, sun, sky_share_of_normal(surface_sky_cell, s.normal),
                   base_reflection, coat_reflection);
#endif
  light_out += lamp_radiance(s, seen.to_viewer, lamp_light(s, position, seen.normal, seen.to_viewer));
  return through_haze(light_out, seen.distance_m, light.haze_per_m, light.haze_radiance);
}
#endif

void main() {
  SeenPoint seen = seen_point();
  float sun = 1.0f, alpha;
  Surface s = surface_at(seen, sun, alpha);
  alpha = covered(alpha);
#if !defined(WRITES_OBJECT) && !defined(WRITES_DEPTH)
  if (!shows_everything(frame_realism)) s = simplified(s, seen.normal, frame_realism);
#endif
#if defined(WRITES_SURFACE)
  write_surface(s, seen.to_viewer);
#elif defined(WRITES_OBJECT)
  object_and_one = uint(surface_object() + 1);
#elif !defined(WRITES_DEPTH)
  radiance = vec4(min(radiance_of(s, seen, sun), vec3(max_radiance)), alpha);
#endif
}
