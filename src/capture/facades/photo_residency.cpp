#include "capture/facades/photo_residency.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace parvis::facades {

PhotoResidency::PhotoResidency(std::vector<glm::vec3> centres, std::vector<std::size_t> units,
                               std::size_t max_units)
    : centres_(std::move(centres)),
      units_(std::move(units)),
      max_units_(max_units),
      resident_(centres_.size(), 0) {}

ResidencyChange PhotoResidency::follow(std::span<const glm::vec3> eyes) {
  ResidencyChange change;
  if (is_complete() || eyes.empty()) return change;
  std::vector<float> distance(centres_.size(), std::numeric_limits<float>::max());
  for (std::size_t i = 0; i < centres_.size(); ++i)
    for (const glm::vec3& eye : eyes) distance[i] = std::min(distance[i], glm::distance(eye, centres_[i]));
  std::vector<std::uint32_t> nearest(centres_.size());
  std::iota(nearest.begin(), nearest.end(), 0u);
  std::ranges::stable_sort(nearest, {}, [&](std::uint32_t i) { return distance[i]; });
  std::size_t wanted_units = 0, wanted = 0;
  while (wanted < nearest.size() && wanted_units + units_[nearest[wanted]] <= max_units_)
    wanted_units += units_[nearest[wanted++]];
  for (std::size_t k = 0; k < wanted; ++k)
    if (!resident_[nearest[k]]) change.entering.push_back(nearest[k]);
  std::size_t used = used_;
  for (const std::uint32_t i : change.entering) used += units_[i];
  // The farthest go first, and only as many as have to.
  for (std::size_t k = nearest.size(); k > wanted && used > max_units_; --k)
    if (const std::uint32_t i = nearest[k - 1]; resident_[i]) {
      change.leaving.push_back(i), used -= units_[i];
    }
  for (const std::uint32_t i : change.leaving) resident_[i] = 0, --resident_count_;
  for (const std::uint32_t i : change.entering) resident_[i] = 1, ++resident_count_;
  used_ = used;
  return change;
}

}  // namespace parvis::facades
