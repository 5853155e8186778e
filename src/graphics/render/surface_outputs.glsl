// What surface_body.glsl reads of each vertex. A room that draws by itself has a file of its own in place of
// surface_vertex.glsl; it includes this one and defines `void surface_vertex()`, which sets all of them.
out vec3 position;           // in the world
out vec3 vertex_normal;      // in the world, of any length
out vec2 uv;
#ifdef IS_LEAF
// A leaf is so small that the light at its corners tells all, and a crown has more pixels of leaves than corners.
out float leaf_sun;
out vec4 leaf_sky_cell;
#endif
flat out int object_of_surface;  // its number in the scene
