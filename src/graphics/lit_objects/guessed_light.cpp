#include "graphics/lit_objects/guessed_light.h"

#include <algorithm>

namespace parvis::lit_objects {
namespace {

constexpr float no_light = 1e-6f;  ///< W/m2

/// By what the light of the sky grows between the two places, given what places around see more of it. A
/// vertex has the share of that which it had of what they saw before: its own object's shade. What
/// interpolation may be off by is added on both sides: where places saw next to nothing, this says nothing,
/// and the share is one.
glm::vec3 change_of_sky(const KnownLight& known, const InterpolatedSky& now, std::size_t v) {
  if (!known.interpolated) return glm::vec3(0.0f);
  const InterpolatedSky& before = *known.interpolated;
  const glm::vec3 doubt = std::max(now.uncertainty, before.uncertainty) * before.open[v] + no_light;
  const glm::vec3 share = (known.traced.sky[v] + doubt) / (before.irradiance[v] + doubt);
  return glm::max(share * (now.irradiance[v] - before.irradiance[v]), -known.traced.sky[v]);
}

/// `rays` in place of `guess`, by their weight.
std::vector<glm::vec3> mixed(const std::vector<glm::vec3>& guess, std::vector<glm::vec3> rays,
                             const light::Halves& halves) {
  std::vector<float> greens;
  greens.reserve(guess.size());
  for (const glm::vec3 each : guess) greens.push_back(each.y);
  const float weight = light::weight_of_rays(greens, halves);
  for (std::size_t v = 0; v < rays.size(); ++v) rays[v] = glm::mix(guess[v], rays[v], weight);
  return rays;
}

}  // namespace

void GuessJudge::add(const KnownLight& known, const Clues& now, std::size_t v, glm::vec3 traced_sky,
                     glm::vec3 traced_sun) {
  sky_.push_back(change_of_sky(known, now.interpolated, v));
  wanted_sky_.push_back(traced_sky - known.traced.sky[v]);
  sun_.push_back(now.sun[v] - known.traced.sun[v]);
  wanted_sun_.push_back(traced_sun - known.traced.sun[v]);
}

GuessWeights GuessJudge::weights() const {
  return {light::weight_of_changes(sky_, wanted_sky_), light::weight_of_changes(sun_, wanted_sun_)};
}

SplitLight guessed_light(const KnownLight& known, const Clues& now, const GuessWeights& weights) {
  SplitLight guess = known.traced;
  for (std::size_t v = 0; v < guess.sky.size(); ++v) {
    guess.sky[v] += weights.sky * change_of_sky(known, now.interpolated, v);
    guess.sun[v] = glm::mix(guess.sun[v], now.sun[v], weights.sun);
  }
  return guess;
}

SplitLight mixed(const SplitLight& guess, const light::VertexLight& traced) {
  if (traced.rays() == 0) return guess;
  return {mixed(guess.sky, traced.sky_irradiance(), traced.halves_of_sky()),
          mixed(guess.sun, traced.sun_irradiance(), traced.halves_of_sun())};
}

}  // namespace parvis::lit_objects
