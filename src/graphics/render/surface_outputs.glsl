// What surface_body.glsl reads of each vertex. A room that draws by itself has a file of its own in place of
// surface_vertex.glsl; it includes this one and defines `void surface_vertex()`, which sets all of them.
out vec3 position;       // in the world
out vec3 vertex_normal;  // in the world, of any length
out vec2 uv;
#ifdef HAS_OWN_MAPPINGS
out vec2 second_uv;
#endif
#ifdef HAS_COLOURS
out vec4 vertex_colour;  // linear; multiplies the base colour
#endif
#ifdef IS_LEAF
// Leaves and twigs are lit at their corners (leaf_light.glsl).
out float leaf_sun;  // share of the sun that is seen
#ifdef IS_SPECK
// Of one colour: points and lines of a few pixels.
out vec3 speck_radiance;  // toward the viewer, without the sun
out vec3 speck_sunlight;  // what is added where all of the sun is seen
#else
out vec3 leaf_light, leaf_light_behind, leaf_lamps, leaf_mirrored;  // CornerLight
#endif
#endif
#ifdef HAS_VERTEX_LIGHT
out vec3 vertex_light;  // irradiance on the side of the normal, and on the other one
out vec3 vertex_light_behind;
#endif
flat out int
    object_of_surface;  // its number in the scene; the complement of it (~) where it receives no shadows
