// Is a point of a virtual triangle shown, by what its corners know? `certainty` is `sure` where all have a
// place in the mirror image, `height` is above the reflector (what lies below it is hidden), `shown_by` its
// normal where it shows them.

// How sure a place is. Between the corners of a triangle one that is lost outweighs any that are doubtful.
const float sure = 0.0f;
const float doubtful =
    1.0f;  // near where a convex patch would show the vertex: drawn pixel by pixel, where it does
const float lost = 1e4f;  // the mirror has no place that shows it

// Corners that places show which face too far apart, by more than 25 degrees, tell nothing of what lies
// between them.
const float min_agreement = 0.95f;

bool is_shown_whole(float certainty, float height, vec3 shown_by) {
  return certainty == sure && height >= 0.0f && dot(shown_by, shown_by) >= min_agreement;
}
