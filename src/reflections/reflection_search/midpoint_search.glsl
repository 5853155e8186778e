// The paper's search (Estalella and others 2005, sections 4.2 and 4.3): the midpoint method, of second order,
// follows the projected bisector over a cube map about the reflector; two evaluations of the surface a step.
// Left open there, and chosen here: the vector is the central projection of the bisector direction at P, as
// long as P is from the centre, so that nothing depends on the reflector's size (the paper's other
// definition, by rays along normal and bisector, is the same on a ball alone, and twice as often wrong by
// more than a degree on an ellipsoid of 1, 0.6, 0.8); steps begin small and change by what was best on balls
// and ellipsoids. Needs reflection_point.glsl.

const float face_rim = 0.2f;     // least cosine to the face's axis: a ray along the face ends far outside
const float first_step = 0.25f;  // of the projected bisector
const float longest_step = 4.0f;
const float similar_vectors = 0.2f;    // relative difference below which a step becomes twice as long
const float different_vectors = 0.5f;  // and above which it becomes a quarter

// The axis of the cube's face that a direction meets.
GLSL_FUNCTION vec3 face_axis(vec3 d) {
  vec3 size = abs(d);
  if (size.x >= size.y && size.x >= size.z) return vec3(sign(d.x), 0.0f, 0.0f);
  if (size.y >= size.z) return vec3(0.0f, sign(d.y), 0.0f);
  return vec3(0.0f, 0.0f, sign(d.z));
}

GLSL_FUNCTION vec3 on_face(vec3 ray, vec3 axis) { return ray / max(dot(ray, axis), face_rim); }

struct ProjectedBisector {
  vec3 along_face;  // in the plane of the face at 1
  float error;
  SurfacePoint at;
};

GLSL_FUNCTION ProjectedBisector projected_bisector(ReflectionTask task, vec3 direction, vec3 axis) {
  SurfacePoint at = surface_at(direction);
  vec3 bisecting = bisector(task.viewer, task.vertex, at);
  vec3 from = normalize(at.position - task.centre);
  vec3 apart = on_face(from + bisecting - at.normal, axis) - from / dot(from, axis);
  return ProjectedBisector(apart - dot(apart, axis) * axis, bisector_error(bisecting, at.normal), at);
}

GLSL_FUNCTION ReflectionPoint search_by_midpoint(ReflectionTask task, vec3 start, int iterations,
                                                 float min_error) {
  vec3 direction = start;
  float step_length = first_step;
  for (int i = 0; i < iterations; ++i) {
    vec3 axis = face_axis(direction);
    vec3 from = direction / dot(direction, axis);
    ProjectedBisector first = projected_bisector(task, from, axis);
    if (first.error < min_error) return reflection_point(first.at, normalize(direction), first.error);
    ProjectedBisector middle = projected_bisector(task, from + 0.5f * step_length * first.along_face, axis);
    direction = from + step_length * middle.along_face;
    float difference = length(middle.along_face - first.along_face) / max(length(first.along_face), 1e-12f);
    if (difference > different_vectors) step_length *= 0.25f;
    if (difference < similar_vectors) step_length = min(2.0f * step_length, longest_step);
  }
  ProjectedBisector last = projected_bisector(task, direction, face_axis(direction));
  return reflection_point(last.at, normalize(direction), last.error);
}
