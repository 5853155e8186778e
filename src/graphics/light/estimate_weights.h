// How much a guess counts beside rays that are few: measured, not assumed.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace parvis::light {

/// What two halves of the rays of each vertex found, each by itself: green of linear Rec. 709.
struct Halves {
  std::vector<float> first, second;
};

/// The weight, between 0 and 1, with which what all rays found is mixed into `guess` (green, by vertex), so
/// that the error is smallest over all vertices (James and Stein 1961): the error of the guess is the mean
/// product of what it differs by from each half, since errors of the halves are independent. 0 where nothing
/// differs.
float weight_of_rays(std::span<const float> guess, const Halves& found);

/// The weight w between 0 and 1 for which the sum over all samples of |w change - wanted|^2 is smallest; 0
/// where nothing changes.
float weight_of_changes(std::span<const glm::vec3> changes, std::span<const glm::vec3> wanted);

}  // namespace parvis::light
