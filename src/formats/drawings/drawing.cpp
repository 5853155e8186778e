#include "formats/drawings/drawing.h"

namespace parvis::formats {

glm::dvec3 Drawing::local_origin() const {
  constexpr double far_m = 10'000.0;  // beyond it floats are coarser than a millimetre
  const glm::dvec2 middle = 0.5 * (glm::dvec2(min) + glm::dvec2(max));
  if (glm::length(middle) < far_m) return glm::dvec3(0.0);
  return {glm::floor(middle), 0.0};
}

}  // namespace parvis::formats
