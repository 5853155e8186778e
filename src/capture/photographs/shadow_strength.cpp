#include "capture/photographs/shadow_strength.h"

#include <algorithm>
#include <cmath>

#include "base/colour.h"

namespace parvis::photographs {
namespace {

constexpr std::size_t min_colours = 60;  // fewer say nothing about a surface
constexpr float darkest = 1.0f / 1024.0f;
constexpr double min_class = 0.05;  // share of either class
// Between the medians, in sums of the classes' deviations. Halves of one class have 1.3 if it is normally
// distributed, 1.7 if evenly.
constexpr double min_gap = 1.9;
constexpr float min_kept = 0.05f, max_kept = 0.65f;
constexpr float max_redder = 0.15f;  // of the shadow: logarithm of red over blue

struct Class {
  double count = 0.0, sum = 0.0, squares = 0.0, redness = 0.0;

  void add(double logarithm, double red) {
    count += 1.0, sum += logarithm, squares += logarithm * logarithm, redness += red;
  }
  double mean() const { return sum / count; }
  double deviation() const { return std::sqrt(std::max(squares / count - mean() * mean(), 0.0)); }
};

/// The value below which the darker class of ascending values lies; the variance between both is largest.
std::size_t best_division(std::span<const float> ascending) {
  double all = 0.0, below = 0.0, best = -1.0;
  for (const float value : ascending) all += double(value);
  std::size_t division = 0;
  const auto n = double(ascending.size());
  for (std::size_t i = 1; i < ascending.size(); ++i) {
    below += double(ascending[i - 1]);
    const auto count = double(i);
    const double between = (all - below) / (n - count) - below / count;
    const double variance = count * (n - count) * between * between;
    if (variance > best) best = variance, division = i;
  }
  return division;
}

}  // namespace

std::optional<LitAndShaded> lit_and_shaded(std::span<const glm::vec3> radiances) {
  if (radiances.size() < min_colours) return std::nullopt;
  std::vector<float> ascending;
  for (const glm::vec3& radiance : radiances)
    ascending.push_back(std::log2(std::max(luminance(radiance), darkest)));
  std::ranges::sort(ascending);
  const std::size_t division = best_division(ascending);
  const float threshold = ascending[division];
  Class dark, bright;
  for (const glm::vec3& radiance : radiances) {
    const float value = std::log2(std::max(luminance(radiance), darkest));
    const double red = std::log(double((radiance.x + darkest) / (radiance.z + darkest)));
    (value < threshold ? dark : bright).add(double(value), red);
  }
  const double share = dark.count / double(radiances.size());
  if (!(share > min_class && share < 1.0 - min_class)) return std::nullopt;
  // Medians: points on the shadow's soft edge belong to neither.
  const float in_shadow = ascending[division / 2], in_sun = ascending[(division + ascending.size()) / 2];
  const double gap = double(in_sun - in_shadow);
  if (gap < min_gap * (dark.deviation() + bright.deviation())) return std::nullopt;
  const auto kept = float(std::exp2(-gap));
  const double redder = dark.redness / dark.count - bright.redness / bright.count;
  if (kept < min_kept || kept > max_kept || redder > double(max_redder)) return std::nullopt;
  return LitAndShaded{std::exp2(in_sun), kept, float(std::min(dark.count, bright.count))};
}

float kept_in_shadows(std::span<const std::optional<LitAndShaded>> surfaces) {
  std::vector<std::pair<float, float>> found;  // kept, weight
  float all = 0.0f;
  for (const std::optional<LitAndShaded>& surface : surfaces)
    if (surface) found.emplace_back(surface->kept, surface->weight), all += surface->weight;
  std::ranges::sort(found);
  float below = 0.0f;
  for (const auto& [kept, weight] : found)
    if ((below += weight) >= 0.5f * all) return kept;
  return kept_in_usual_shadow;
}

std::uint8_t encoded_luminance(float luminance) {
  if (luminance <= 0.0f) return 0;
  return std::uint8_t(std::clamp(1.0f + (std::log2(luminance) + 10.0f) * 254.0f / 16.0f, 1.0f, 255.0f));
}

float decoded_luminance(std::uint8_t bits) {
  return bits == 0 ? 0.0f : std::exp2((float(bits) - 1.0f) * 16.0f / 254.0f - 10.0f);
}

}  // namespace parvis::photographs
