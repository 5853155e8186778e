#include "capture/photographs/test_clicks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/random.h"
#include "capture/photographs/clicked_camera.h"

namespace parvis::photographs {
namespace {

constexpr std::size_t min_places = 100;

/// Farthest first in the picture and in depth, as a person takes corners near and far.
std::vector<ClickedPoint> well_spread(const Photograph& truth, std::span<const ClickedPoint> seen) {
  const auto features = [&](const ClickedPoint& each) {
    return glm::dvec3(each.pixel / double(truth.lens.width),
                      0.3 * std::log(distance_along_axis(truth, each.position_in_world)));
  };
  std::vector<ClickedPoint> chosen{seen.front()};
  while (chosen.size() < min_clicked_points) {
    const auto nearest = [&](const ClickedPoint& each) {
      double least = std::numeric_limits<double>::infinity();
      for (const ClickedPoint& other : chosen)
        least = std::min(least, glm::distance(features(each), features(other)));
      return least;
    };
    chosen.push_back(*std::ranges::max_element(seen, {}, nearest));
  }
  return chosen;
}

}  // namespace

double clicked_camera_error_px(const Photograph& truth, std::span<const glm::dvec3> places, double sigma_px,
                               std::uint64_t seed) {
  constexpr double no_camera = std::numeric_limits<double>::infinity();
  std::vector<ClickedPoint> seen;
  for (const glm::dvec3& place : places)
    if (const auto at = pixel_of_world(truth, place); at && is_inside(truth.lens, *at))
      seen.push_back({*at, place});
  if (seen.size() < min_places) return no_camera;
  std::vector<ClickedPoint> clicks = well_spread(truth, seen);
  Random random(7, seed);
  for (ClickedPoint& each : clicks)
    for (int axis = 0; axis < 2; ++axis)  // nearly normal: the sum of twelve has a variance of 1
      for (int i = 0; i < 12; ++i) each.pixel[axis] += sigma_px * (double(random.uniform()) - 0.5);
  const Result<ClickedCamera> found = camera_of_points(clicks, truth.lens.width, truth.lens.height);
  if (!found) return no_camera;
  double squares = 0.0;
  for (const ClickedPoint& each : seen) {
    const auto at = pixel_of_world(found->photograph, each.position_in_world);
    if (!at) return no_camera;
    squares += glm::dot(*at - each.pixel, *at - each.pixel) / double(seen.size());
  }
  return std::sqrt(squares);
}

}  // namespace parvis::photographs
