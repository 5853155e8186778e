// Where a ray hits a body of solid glass, and where one within leaves it, by the body's map: Newton's method
// with tangent planes. A convex body lies behind each of them, so that from outside every step comes nearer
// and none goes past. From the host:
//   SurfacePoint surface_at(vec3 direction)   what a ray from the centre meets; the direction has any length
// Needs surface_point.glsl.

const int far_side_steps = 6;
const int near_side_steps = 6;

// Of a ray from outside that meets the body.
GLSL_FUNCTION SurfacePoint near_side(vec3 centre, float reach, vec3 start, vec3 direction) {
  vec3 passing = start - centre;
  passing -= dot(passing, direction) * direction;  // nearest to the centre
  float along = -sqrt(max(reach * reach - dot(passing, passing), 0.0f));
  vec3 normal = -direction;
  for (int i = 0; i < near_side_steps; ++i) {
    vec3 from_centre = passing + along * direction;
    SurfacePoint at = surface_at(from_centre);
    float height = dot(centre + from_centre - at.position, at.normal);
    along += max(height, 0.0f) / max(-dot(at.normal, direction), 1e-2f);
    normal = at.normal;
  }
  return SurfacePoint(centre + passing + along * direction, normal, 0.0f);
}

// `start` lies in the body or on its surface; `reach`: the surface's greatest distance from the centre.
GLSL_FUNCTION SurfacePoint far_side(vec3 centre, float reach, vec3 start, vec3 direction) {
  vec3 from_centre = start - centre;
  float middle = dot(from_centre, direction);
  float along = sqrt(max(middle * middle + reach * reach - dot(from_centre, from_centre), 0.0f)) - middle;
  vec3 normal = direction;
  for (int i = 0; i < far_side_steps; ++i) {
    SurfacePoint at = surface_at(from_centre + along * direction);
    float to_plane = dot(at.position - start, at.normal) / max(dot(at.normal, direction), 1e-3f);
    along = clamp(to_plane, 0.0f, along);
    normal = at.normal;
  }
  return SurfacePoint(start + along * direction, normal, 0.0f);
}
