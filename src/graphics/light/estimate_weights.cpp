#include "graphics/light/estimate_weights.h"

#include <algorithm>
#include <cassert>

namespace parvis::light {
namespace {

double ratio_in_0_1(double numerator, double denominator) {
  return denominator > 0.0 ? std::clamp(numerator / denominator, 0.0, 1.0) : 0.0;
}

}  // namespace

float weight_of_rays(std::span<const float> guess, const Halves& found) {
  assert(found.first.size() == guess.size() && found.second.size() == guess.size());
  double of_guess = 0.0, of_both = 0.0;
  for (std::size_t v = 0; v < guess.size(); ++v) {
    const double first = double(found.first[v]) - double(guess[v]),
                 second = double(found.second[v]) - double(guess[v]), both = 0.5 * (first + second);
    of_guess += first * second, of_both += both * both;
  }
  return float(ratio_in_0_1(of_guess, of_both));
}

float weight_of_changes(std::span<const glm::vec3> changes, std::span<const glm::vec3> wanted) {
  assert(changes.size() == wanted.size());
  double product = 0.0, square = 0.0;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const glm::dvec3 change(changes[i]);
    product += glm::dot(change, glm::dvec3(wanted[i])), square += glm::dot(change, change);
  }
  return float(ratio_in_0_1(product, square));
}

}  // namespace parvis::light
