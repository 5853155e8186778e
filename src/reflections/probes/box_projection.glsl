// Box projection (Bjorke 2004): a map drawn at `map_centre` stands for the inside of a box, turned by
// `heading` (cosine, sine about z). The direction, from the map's centre, of the point where a ray from
// `position` leaves the box. A ray that begins outside the box keeps its direction.
GLSL_FUNCTION vec3 box_projected_direction(vec3 position, vec3 direction, vec3 map_centre, vec3 box_centre,
                                           vec3 half_size, vec2 heading) {
  vec3 p = position - box_centre;
  vec3 o = vec3(heading.x * p.x + heading.y * p.y, heading.x * p.y - heading.y * p.x, p.z);
  vec3 d = vec3(heading.x * direction.x + heading.y * direction.y,
                heading.x * direction.y - heading.y * direction.x, direction.z);
  vec3 outside = abs(o) - half_size;
  if (max(outside.x, max(outside.y, outside.z)) >= 0.0f) return direction;
  vec3 reach = max(abs(d), vec3(1e-6f));
  float tx = (half_size.x - sign(d.x) * o.x) / reach.x;
  float ty = (half_size.y - sign(d.y) * o.y) / reach.y;
  float tz = (half_size.z - sign(d.z) * o.z) / reach.z;
  return position + min(tx, min(ty, tz)) * direction - map_centre;
}
