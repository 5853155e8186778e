// Is a point of a virtual triangle shown, by what its corners know? `is_lost` is 0 where all have a place in the mirror image,
// `height` is above the reflector (what lies below it is hidden), `shown_by` its normal where it shows them.

// Corners that places show which face too far apart, by more than 25 degrees, tell nothing of what lies between them.
const float least_agreement = 0.95f;

bool is_shown_whole(float is_lost, float height, vec3 shown_by) {
  return is_lost == 0.0f && height >= 0.0f && dot(shown_by, shown_by) >= least_agreement;
}
