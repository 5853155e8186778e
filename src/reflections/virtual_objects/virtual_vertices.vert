// Where a patch of a reflector shows each vertex of the scene (Estalella and others 2005, sections 3 to 6.1):
// as it was searched for ahead of the view, or from the virtual grid about its mesh, where that has a point,
// else by a search of its own. The vertex stands behind its reflection point as behind the plane that touches
// there.
#include SURFACE_VERTEX "graphics/render/surface_vertex.glsl"
#include "reflections/virtual_objects/virtual_place.glsl"

#ifdef HAS_VERTEX_SEARCH
#include "reflections/virtual_objects/grid_table.glsl"
#include "reflections/virtual_objects/grid_interpolation.glsl"

layout(location = 7) in ivec2 vertex_data;  // of each instance, as VertexSearch::add has it; 0: none

uniform float max_stray_px;  // of what is interpolated, from where a search would put it

vec2 pixel_of(vec3 in_mirror) {
  vec4 clip = clip_from_world * vec4(moved(world_from_reflector, in_mirror), 1.0f);
  return 0.5f * frame_size.xy * clip.xy / clip.w;
}

// The image is interpolated; mirrored at the interpolated point it would be elsewhere. Both are off by the
// square of a cell.
float stray_px(vec3 vertex, VirtualPoint point) {
  return distance(pixel_of(point.image), pixel_of(virtual_vertex(vertex, point.seen_from, point.shown_by)));
}

// Loops in place of branches: software renderers run both sides of those.
VirtualPoint point_of_vertex(vec3 vertex) {
  VirtualPoint point;
  int searches = vertex_data.x < 0 ? 0 : 1;
  for (int ahead = 1 - searches; ahead > 0; --ahead)
    point = searched_point(gl_VertexID + 1 + vertex_data.x, vertex_data.y);
  for (int grids = vertex_data.x > 0 ? 1 : 0; grids > 0; --grids) {
    InterpolatedPoint between = interpolated_point(vertex_data.x, vertex_data.y, mesh_position);
    point = between.point;
    bool strays = point.certainty > sure || stray_px(vertex, point) > max_stray_px;
    searches = strays && !between.is_between_lost ? 1 : 0;
  }
  for (; searches > 0; --searches)
    point = virtual_point(moved(reflector_from_world, viewer_position.xyz), vertex);
  return point;
}
#else
VirtualPoint point_of_vertex(vec3 vertex) {
  return virtual_point(moved(reflector_from_world, viewer_position.xyz), vertex);
}
#endif

void main() {
  surface_vertex();
  vec3 vertex = moved(reflector_from_world, position);
  gl_Position = clip_from_world * vec4(place_of(point_of_vertex(vertex), vertex), 1.0f);
}
