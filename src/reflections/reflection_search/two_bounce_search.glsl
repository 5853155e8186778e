// Reflection points of a vertex that a first mirror shows in a second one (Estalella and others 2005, section
// 8, "a straightforward extension"). The length of the path viewer - first - second - vertex is stationary in
// both points: each is a reflection point between its neighbours. Both are searched for alternately, each
// from its last position, until they agree. A concave mirror may show the other several times: in layers of
// either mirror, as in patch_search.glsl. Required from the host:
//   void turn_to(int mirror)           selects the mirror, 0 or 1, of all other functions of the host
//   vec3 across(vec3 point, int to)    transforms from the frame of the other mirror
// Needs patch_search.glsl.

const int max_turns = 12;
const float agreed_error = 2e-8f;  // 0.016 degrees

struct TwoBounces {
  PatchPoint first;
  PatchPoint second;  // each in its mirror's frame
};

// Searches for one of the two points again, from near its last position.
GLSL_FUNCTION PatchPoint point_again(ReflectionTask task, vec3 direction, PatchKind kind, int layer) {
  return patch_point(task, direction, kind.is_convex && layer < 0, layer < 0 ? free_growth : steady_growth);
}

// `first.vertex` is given as a first guess of the point on the second mirror; `second.viewer` is not read.
GLSL_FUNCTION TwoBounces search_two_bounces(ReflectionTask first, PatchKind first_kind, int first_layer,
                                            ReflectionTask second, PatchKind second_kind, int second_layer) {
  TwoBounces found;
  turn_to(0);
  found.first = search_patch(first, first_kind, first_layer);
  turn_to(1);
  second.viewer = across(found.first.point.position, 1);
  found.second = search_patch(second, second_kind, second_layer);
  for (int i = 0; i < max_turns; ++i) {
    turn_to(0);
    first.vertex = across(found.second.point.position, 0);
    found.first = point_again(first, found.first.point.direction, first_kind, first_layer);
    turn_to(1);
    second.viewer = across(found.first.point.position, 1);
    SurfacePoint at = surface_at(found.second.point.direction);
    float error = bisector_error(bisector(second.viewer, second.vertex, at), at.normal);
    found.second.point.angle = angle_of_error(error);
    if (error < agreed_error) break;
    found.second = point_again(second, found.second.point.direction, second_kind, second_layer);
  }
  return found;
}
