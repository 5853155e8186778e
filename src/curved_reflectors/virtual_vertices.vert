// Where a patch of a reflector shows each vertex of the scene (Estalella and others 2005, sections 3, 4 and 6.1): the search
// finds the reflection point, and the vertex stands behind it as behind the plane that touches there.
#include "render/surface_vertex.glsl"
#include "curved_reflectors/virtual_place.glsl"

void main() {
  surface_vertex();
  gl_Position = clip_from_world * vec4(virtual_place(viewer_position.xyz, position), 1.0f);
}
