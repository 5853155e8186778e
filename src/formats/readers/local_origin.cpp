#include "formats/readers/local_origin.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace parvis::formats {
namespace {

/// Distance of the range from zero: that of its nearest number.
double distance_from_zero(double low, double high) { return std::max({low, -high, 0.0}); }

}  // namespace

glm::dvec3 local_origin(glm::dvec3 low, glm::dvec3 high) {
  if (!(low.x <= high.x)) return glm::dvec3(0.0);
  const glm::dvec3 middle = glm::round(0.5 * (low + high));
  glm::dvec3 origin(0.0);
  const double x = distance_from_zero(low.x, high.x), y = distance_from_zero(low.y, high.y);
  if (std::hypot(x, y) > max_local_m) origin.x = middle.x, origin.y = middle.y;
  if (distance_from_zero(low.z, high.z) > max_local_m) origin.z = middle.z;
  return origin;
}

void note_origin(glm::dvec3 origin, const std::string& map, scene::FileAccount& account) {
  if (origin == glm::dvec3(0.0)) return;
  const std::string system = map.starts_with("EPSG:") ? " of " + map
                             : map.empty()            ? "; no coordinate system is named"
                                                      : " of the file's own coordinate system";
  account.changed("coordinates", fmt::format("given about the local origin {:.0f} {:.0f} {:.0f}{}", origin.x,
                                             origin.y, origin.z, system));
}

void note_single_precision(glm::dvec3 origin, const std::string& whose, scene::FileAccount& account) {
  if (origin == glm::dvec3(0.0)) return;
  const double last_digit_m = glm::length(origin) * double(std::numeric_limits<float>::epsilon());
  account.left_out("digits of coordinates",
                   fmt::format("{} single precision, {:.2g} m here; export the model about a local origin",
                               whose, last_digit_m));
}

}  // namespace parvis::formats
