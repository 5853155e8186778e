// Pictures of people: corners of upright rectangles that face the viewer, one instance for each person.
#include "graphics/render/frame.glsl"
#include "graphics/render/body_lookup.glsl"
#include "graphics/render/sun_lookup.glsl"
#include "graphics/render/surface_outputs.glsl"
#include "graphics/render/leaf_light.glsl"

layout(location = 0) in vec4 picture_foot;      // w: the person's height
layout(location = 1) in vec4 picture_right;     // w: cosine of the person's heading
layout(location = 2) in vec4 picture_up;        // w: sine
layout(location = 3) in vec4 picture_edges;     // left, lower, right, upper; metres from the foot
layout(location = 4) in vec4 picture_texels;    // texture coordinates of the same corners
layout(location = 5) in uvec4 picture_numbers;  // layers of shape and colours, thing

flat out vec4 picture_layers;  // of shape and colours; cosine and sine of the heading

const float body_half_width = 0.13f, cast_free = 0.25f, before_foot = 0.12f, behind_axis = 0.06f;  // of the
// height
const float picture_roughness = 0.85f;

void surface_vertex() {
  vec2 corner = vec2(float(gl_VertexID & 1), float(gl_VertexID >> 1));
  vec2 at = mix(picture_edges.xy, picture_edges.zw, corner);
  vec3 away = cross(picture_right.xyz, picture_up.xyz);
  float height = picture_foot.w;
  position = picture_foot.xyz + at.x * picture_right.xyz + at.y * picture_up.xyz;
  // Light falls on a body as on a column: what is at its sides faces sideways.
  float aside = clamp(at.x / (body_half_width * height), -1.0f, 1.0f);
  vertex_normal = normalize(away + 0.9f * aside * picture_right.xyz);
  uv = mix(picture_texels.xy, picture_texels.zw, corner);
  object_of_surface = int(picture_numbers.z);
  picture_layers = vec4(float(picture_numbers.x), float(picture_numbers.y), picture_right.w, picture_up.w);
  // A body has its own shade in its normals: the sun is looked for before it.
  vec3 to_sun = to_sun_at(position);
  vec3 lit_at =
      vec3(picture_foot.xy, position.z) + cast_free * height * vec3(normalize(to_sun.xy + vec2(1e-5f)), 0.0f);
  leaf_sun = visible_sun(lit_at, to_sun);
  light_corner(vertex_normal, sky_visibility_cell(position, vertex_normal), 1.0f, picture_roughness, 0.0f);
#ifdef WRITES_DEPTH
  // Behind the body as the sun sees it: who is shown as a mesh is not in the picture's shade.
  position -= behind_axis * height * normalize(viewer_position.xyz - position);
#else
  // Toes and what somebody carries are nearer than the foot's place: neither ground nor seats cut them off.
  position += before_foot * height * normalize(viewer_position.xyz - position);
#endif
}
