// What the fragment shader of a surface reads and writes, and the functions that the rest of the shader
// requires of the file that includes surface_body.glsl.
const int base_layer = 0, coat_layer = 1;

in vec3 position;
in vec3 vertex_normal;
in vec2 uv;
#ifdef HAS_OWN_MAPPINGS
in vec2 second_uv;
#endif
#ifdef HAS_COLOURS
in vec4 vertex_colour;
#endif
#ifdef IS_LEAF
in float leaf_sun;
#ifdef IS_SPECK
in vec3 speck_radiance;
in vec3 speck_sunlight;
#else
in vec3 leaf_light, leaf_light_behind, leaf_lamps, leaf_mirrored;
#endif
#endif
#ifdef HAS_VERTEX_LIGHT
in vec3 vertex_light;
in vec3 vertex_light_behind;
vec3 light_before, light_behind;  // of the two, on the viewer's side and on the other one
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
BouncedCell surface_bounced_cell;
uniform highp sampler2D traced_sun_texture;  // of the view's pixels: share of the sun, distance to the viewer

#ifdef IS_MIRRORED
bool is_mirrored_here();  // true if the reflector shows this point of the surface
#endif
void look_along(vec3 at, vec3 direction);             // prepares what the mirror ray hits
vec3 reflected_radiance(float roughness, int layer);  // its radiance, prefiltered for the layer
