// What solid glass shows: surfaces that mirror the sky alone, where refracted_vertices.vert has put them.
#include "graphics/render/surface.frag"
#include "graphics/shading/glass.glsl"
#include "reflections/reflector_maps/patch_uniforms.glsl"
#include "reflections/refraction/glass_rays.glsl"

#include "reflections/refraction/refraction_block.glsl"

in float is_lost;       // 0 where the glass shows all corners
in float is_elsewhere;  // 1 where another layer shows all corners: what is clear would be blended twice
in vec3 image_in_glass;

const float min_agreement = 0.985f;  // cosine of 10 degrees

// Corners that ended in different images tell nothing of what lies between them: near a focus the glass
// enlarges so much that only the ray itself can tell. The pixel's own ray must leave the glass toward about
// this point of the surface.
bool is_mirrored_here() {
  if (is_lost > 0.0f || is_elsewhere > 0.999f) return false;
  vec3 viewer = moved(reflector_from_world, viewer_position.xyz),
       point = moved(reflector_from_world, position);
  vec3 seen = normalize(image_in_glass - viewer);
  SurfacePoint entry = near_side(map_centre, map_size.z, viewer, seen);
  vec3 inside = refracted(seen, entry.normal, 1.0f / glass_ior);
  SurfacePoint exit = far_side(map_centre, map_size.z, entry.position, inside);
  vec3 outgoing = refracted(inside, -exit.normal, glass_ior);
  return dot(outgoing, normalize(point - exit.position)) > min_agreement;
}
