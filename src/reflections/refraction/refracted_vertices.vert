// Where a body of solid glass shows each vertex of the scene: on the ray to where its light leaves the glass
// toward the viewer, as far away as its light has come. So what lies behind other things in the glass is
// hidden by them.
#include SURFACE_VERTEX "graphics/render/surface_vertex.glsl"
#include "reflections/reflector_maps/patch_uniforms.glsl"

#include "reflections/refraction/refraction_block.glsl"

mat4 refraction_start(int i) { return refraction_rays[i]; }

#include "reflections/refraction/refraction_search.glsl"

// A vertex that the glass does not show, or not in this layer, is the corner of triangles that it shows in
// part: it stays where it would be shown most nearly, and refracted_surface.frag decides pixel by pixel what
// is seen.
const float nearly_refracted = 0.3f;

out vec3 seen_from;
out float is_lost;
out float is_elsewhere;
out vec3 image_in_glass;  // in the body's frame

void main() {
  surface_vertex();
  vec3 viewer = moved(reflector_from_world, viewer_position.xyz),
       vertex = moved(reflector_from_world, position);
  RefractedPoint found =
      refracted_vertex(RefractionTask(viewer, vertex, map_centre, glass_ior), passed_by_light);
  bool is_smooth = surface_kind(found.entry.position - map_centre) == kind_surface &&
                   surface_kind(found.exit.position - map_centre) == kind_surface;
  is_lost = found.error < nearly_refracted && is_smooth ? 0.0f : 1.0f;
  is_elsewhere = found.error < refraction_lost && found.foci != passed_by_light ? 1.0f : 0.0f;
  seen_from = moved(world_from_reflector, found.exit.position);
  vec3 image = viewer + found.length * normalize(found.entry.position - viewer);
  if (is_lost > 0.0f) image = map_centre;  // finite; the triangle is not drawn
  image_in_glass = image;
  gl_Position = clip_from_world * vec4(moved(world_from_reflector, image), 1.0f);
}
