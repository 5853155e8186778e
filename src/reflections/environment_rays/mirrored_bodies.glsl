// Dynamic objects that mirror rays may hit: block at binding 3, filled by mirrored_bodies.cpp.
#include "reflections/environment_rays/mirrored_bodies_block.glsl"

uniform highp sampler3D body_fields;  // field_columns side by side along x, these rows stacked along z
uniform int reflecting_body;          // index of the body that is drawn; negative: none

vec4 field_texel(vec3 cell, int field);
float field_distance(vec3 cell, int field);

#include "reflections/environment_rays/body_field.glsl"

float field_reach_now_m;  // of the body that is intersected

vec4 field_texel(vec3 cell, int field) {
  int row = field / field_columns, column = field - row * field_columns;
  vec3 first = vec3(float(column) * field_cells.x, 0.0f, float(row) * field_cells.z);
  vec3 texel = first + clamp(cell, vec3(0.5f), field_cells - 0.5f);
  return textureLod(body_fields, texel / vec3(textureSize(body_fields, 0)), 0.0f);
}

float field_distance(vec3 cell, int field) {
  return (2.0f * field_texel(cell, field).a - 1.0f) * field_reach_now_m;
}

struct BodyHit {
  float distance;  // the length of the search where no body was hit
  int body;        // below 0: none
  float share;     // of what is reflected, that the body is: see own_share
  vec3 normal;     // in the world, unit
  vec3 base_colour;
};

vec3 in_box(MirroredBody body, vec4 at) {
  return vec3(dot(body.box_from_world[0], at), dot(body.box_from_world[1], at),
              dot(body.box_from_world[2], at));
}

void look_up_surface(inout BodyHit hit, vec3 at, vec3 direction) {
  MirroredBody body = mirrored_bodies[hit.body];
  int field = int(body.half_size_m.w);
  vec3 cell = field_cell(in_box(body, vec4(at + hit.distance * direction, 1.0f)), body.half_size_m.xyz);
  vec4 texel = field_texel(cell, field);
  hit.base_colour = texel.rgb * texel.rgb;
  vec3 slope = vec3(field_texel(cell + vec3(0.5f, 0.0f, 0.0f), field).a -
                        field_texel(cell - vec3(0.5f, 0.0f, 0.0f), field).a,
                    field_texel(cell + vec3(0.0f, 0.5f, 0.0f), field).a -
                        field_texel(cell - vec3(0.0f, 0.5f, 0.0f), field).a,
                    field_texel(cell + vec3(0.0f, 0.0f, 0.5f), field).a -
                        field_texel(cell - vec3(0.0f, 0.0f, 0.5f), field).a);
  slope *= field_cells / body.half_size_m.xyz;
  vec3 normal = slope.x * body.box_from_world[0].xyz + slope.y * body.box_from_world[1].xyz +
                slope.z * body.box_from_world[2].xyz;
  hit.normal = normalize(normal - 1e-4f * direction);
}

// First body that a ray from the drawn body hits.
BodyHit intersect_bodies(vec3 at, vec3 direction, float reach_m) {
  BodyHit hit = BodyHit(reach_m, -1, 1.0f, vec3(0.0f), vec3(0.0f));
  if (reflecting_body < 0) return hit;
  uvec4 near = mirrored_bodies[reflecting_body].near;
  for (int i = 0; i < 16; ++i) {
    uint byte = (near[i >> 2] >> uint(8 * (i & 3))) & 255u;
    if (byte == 0u) break;
    int index = int(byte) - 1;
    MirroredBody body = mirrored_bodies[index];
    vec3 origin = in_box(body, vec4(at, 1.0f)), along = in_box(body, vec4(direction, 0.0f));
    vec2 within = ray_in_box(origin, along, body.half_size_m.xyz);
    if (within.x >= min(within.y, hit.distance)) continue;
    field_reach_now_m = field_reach_m(body.half_size_m.xyz);
    float distance_m = distance_to_body(origin, along, body.half_size_m.xyz, int(body.half_size_m.w),
                                        hit.distance, index == reflecting_body);
    if (distance_m >= hit.distance) continue;
    hit.distance = distance_m, hit.body = index;
    hit.share = index == reflecting_body ? own_share(distance_m, body.half_size_m.xyz) : 1.0f;
  }
  if (hit.body >= 0) look_up_surface(hit, at, direction);
  return hit;
}
