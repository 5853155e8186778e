// What surface_body.glsl reads of each vertex. A room that draws by itself has a file of its own in place of
// surface_vertex.glsl; it includes this one and defines `void surface_vertex()`, which sets all of them.
out vec3 position;       // in the world
out vec3 vertex_normal;  // in the world, of any length
out vec2 uv;
#ifdef IS_LEAF
// A leaf is small enough to be lit at its vertices, and a crown covers more pixels than it has vertices.
out float leaf_sun;
out vec4 leaf_sky_cell;
#endif
#ifdef HAS_VERTEX_LIGHT
out vec3 vertex_light;  // irradiance on the side of the normal, and on the other one
out vec3 vertex_light_behind;
#endif
flat out int
    object_of_surface;  // its number in the scene; the complement of it (~) where it receives no shadows
