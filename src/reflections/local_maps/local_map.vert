// The corners of local maps' meshes, all maps in one picture: what each corner's ray hit, and how the two
// reference maps share in it.
#include "graphics/shading/octahedral.glsl"
#include "reflections/reference_maps/validity.glsl"
#include "reflections/local_maps/local_map_weights.glsl"

layout(location = 0)
    in vec4 corner;  // place in the picture in texels; distance along the face's axis; what a texel spans
layout(location = 1) in vec3 met;  // in the world
layout(location = 2) in uint map_pair;

uniform highp sampler2DArray map_distances;
uniform highp sampler2D map_places;
#include "reflections/local_maps/picture_block.glsl"

out vec3 from_a;  // from a map's place to the point
out vec3 from_b;
out float share_of_a;
out float is_seen;  // by either
flat out vec3 maps_and_span;

float validity_of(vec3 from_place, int map) {
  float distance_m = length(from_place);
  vec3 uv = vec3(layer_uv(from_place / distance_m, layer_size.x, layer_size.y), float(map));
  return validity(textureLod(map_distances, uv, 0.0f).r, distance_m, cell_m);
}

void main() {
  int a = int(map_pair & 0xffffu), b = int(map_pair >> 16);
  vec3 place_a = texelFetch(map_places, ivec2(a, 0), 0).xyz,
       place_b = texelFetch(map_places, ivec2(b, 0), 0).xyz;
  from_a = met - place_a;
  from_b = met - place_b;
  vec2 validities = vec2(validity_of(from_a, a), validity_of(from_b, b));
  share_of_a = valid_weights(projected_weights(met, place_a, place_b), validities).x;
  is_seen = max(validities.x, validities.y);
  maps_and_span = vec3(float(a), float(b), corner.w);

  // Seen in perspective, what lies between the corners of a flat wall is on that wall. Depth is that of the
  // drawn faces, reversed; the sky stands before nothing.
  float ahead = corner.z;
  float depth = max(near_far.x * (near_far.y - ahead) / (near_far.y - near_far.x), 1e-7f * ahead);
  gl_Position = vec4((corner.xy / picture_size * 2.0f - 1.0f) * ahead, depth, ahead);
}
