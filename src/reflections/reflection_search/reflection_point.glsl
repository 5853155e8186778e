// Where does a reflector show a vertex? Estalella and others 2005, sections 3 and 4.2: at the point R whose
// normal bisects the directions to the viewer and to the vertex. From the host, for the reflector:
//   SurfacePoint surface_at(vec3 direction)   what a ray from the centre meets; the direction has any length
// Two slips of the paper are put right. The error is the angle between bisector and normal of the same point
// P (section 3 writes the normal of R, which nobody knows yet). And equation 1, (1 - B.N) / 2, is computed as
// |B - N|^2 / 4: the same number, but in floats the first is 0 below 0.03 degrees. Needs surface_point.glsl.

struct ReflectionTask {
  vec3 viewer;
  vec3 vertex;
  vec3 centre;  // that directions start from: inside the body of a convex reflector, in front of the surface
                // of a concave one
};

// The last point of a search.
struct ReflectionPoint {
  vec3 position;
  vec3 normal;
  vec3 direction;  // from the centre: where the search of the next frame, or of a neighbour, may begin
  float angle;     // radians between bisector and normal
};

// What a search over a map has come to.
struct PatchPoint {
  ReflectionPoint point;
  float kind;  // of what the map holds there
};

// Section 6.1: a vertex behind the surface is hidden, and stands for its mirror image in the plane of the
// surface.
GLSL_FUNCTION vec3 seen_vertex(vec3 vertex, SurfacePoint at) {
  float height = dot(vertex - at.position, at.normal);
  return vertex - 2.0f * min(height, 0.0f) * at.normal;
}

// Unit length. Where the two directions are opposite, the viewer looks at the surface's back: no point to
// stay at.
GLSL_FUNCTION vec3 bisector(vec3 viewer, vec3 vertex, SurfacePoint at) {
  vec3 to_viewer = normalize(viewer - at.position);
  vec3 to_vertex = normalize(seen_vertex(vertex, at) - at.position);
  vec3 sum = to_viewer + to_vertex;
  float size = length(sum);
  return size > 1e-6f ? sum / size : -at.normal;
}

// Equation 1: 0 where the bisector is the normal, 1 where it is its opposite.
GLSL_FUNCTION float bisector_error(vec3 bisecting, vec3 normal) {
  vec3 apart = bisecting - normal;
  return 0.25f * dot(apart, apart);
}

GLSL_FUNCTION float angle_of_error(float error) { return 2.0f * asin(min(sqrt(error), 1.0f)); }

GLSL_FUNCTION ReflectionPoint reflection_point(SurfacePoint at, vec3 direction, float error) {
  return ReflectionPoint(at.position, at.normal, direction, angle_of_error(error));
}

// The virtual vertex: the image of the vertex in the tangent plane of its reflection point.
GLSL_FUNCTION vec3 virtual_vertex(vec3 vertex, vec3 position, vec3 normal) {
  return vertex - 2.0f * dot(vertex - position, normal) * normal;
}

// Where a search begins that knows nothing: where a flat mirror between the two would reflect, but no farther
// round a ball than the viewer sees it.
GLSL_FUNCTION vec3 first_direction(ReflectionTask task) {
  vec3 to_viewer = task.viewer - task.centre, to_vertex = task.vertex - task.centre;
  float far_viewer = length(to_viewer), far_vertex = length(to_vertex);
  to_viewer /= far_viewer;
  to_vertex /= far_vertex;
  SurfacePoint near_viewer = surface_at(to_viewer);
  float radius = min(length(near_viewer.position - task.centre), 0.95f * far_viewer);
  float viewer_height = far_viewer - radius;
  float vertex_height = max(far_vertex - radius, 0.02f * radius);
  vec3 between = viewer_height * to_vertex + vertex_height * to_viewer;
  vec3 along = between - dot(between, to_viewer) * to_viewer;  // round the ball, from below the viewer
  float side = length(along);
  if (side < 1e-6f * viewer_height) return to_viewer;
  float turn = min(atan(side, dot(between, to_viewer)), 0.8f * acos(radius / far_viewer));
  vec3 direction = vec3(0.0f);
  for (int i = 0; i < 5; ++i) {
    direction = cos(turn) * to_viewer + sin(turn) / side * along;
    SurfacePoint at = surface_at(direction);
    if (dot(task.viewer - at.position, at.normal) > 0.0f) return direction;
    turn *= 0.5f;
  }
  return to_viewer;
}
