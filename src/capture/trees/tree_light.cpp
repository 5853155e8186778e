// Light is one number per cell; its colour stays in the textures.
#include "capture/trees/tree_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "base/colour.h"
#include "base/parallel.h"

namespace parvis::trees {
namespace {

constexpr int sky_rows = 3, sky_columns = 8;  // directions of the sky
constexpr int azimuths = 24;                  // of the search for the sun
constexpr std::array heights_deg{15.0f, 30.0f, 45.0f, 60.0f};
constexpr std::array refinements_deg{7.5f, 3.75f, 2.0f};

glm::vec3 direction_of(float azimuth, float height) {
  return {std::sin(azimuth) * std::cos(height), std::cos(azimuth) * std::cos(height), std::sin(height)};
}

float luminance_of_srgb(glm::u8vec4 srgb) {
  return glm::dot(linear_from_srgb(glm::vec3(srgb) / 255.0f), glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

std::vector<float> extinctions(const BillboardTree& tree) {
  const float chord_m = mean_chord_m(tree.grid.cell_size_m());
  std::vector<float> result;
  for (const glm::u8vec4 base : tree.base)
    result.push_back(-std::log(1.0f - std::min(float(base.w) / 255.0f, 0.998f)) / chord_m);
  return result;
}

/// The fraction of light that reaches each cell's middle along a direction: the cell's own leaves are lit.
std::vector<float> passed(const BillboardTree& tree, const CrownShade& shade, glm::vec3 direction) {
  std::vector<float> result(tree.grid.size());
  parallel_for(
      tree.grid.size(),
      [&](std::size_t cell) { result[cell] = shade.passed(tree.grid.centre(cell), direction, int(cell)); },
      256);
  return result;
}

/// Least squares of brightness by the two visibilities, neither negative; and what is left of the variance.
struct LightFit {
  float sun = 0.0f, sky = 0.0f;
  double residual = 0.0;
};

LightFit fitted(const BillboardTree& tree, const std::vector<float>& brightness,
                const std::vector<float>& sun, const std::vector<float>& sky) {
  double aa = 0.0, ab = 0.0, bb = 0.0, ay = 0.0, by = 0.0, yy = 0.0;
  for (std::size_t i = 0; i < brightness.size(); ++i) {
    const double w = double(tree.base[i].w), a = sun[i], b = sky[i], y = brightness[i];
    aa += w * a * a, ab += w * a * b, bb += w * b * b, ay += w * a * y, by += w * b * y, yy += w * y * y;
  }
  const double determinant = aa * bb - ab * ab;
  double s = determinant > 1e-9 * aa * bb ? (bb * ay - ab * by) / determinant : 0.0;
  double k = determinant > 1e-9 * aa * bb ? (aa * by - ab * ay) / determinant : by / std::max(bb, 1e-9);
  if (s < 0.0) s = 0.0, k = by / std::max(bb, 1e-9);
  if (k < 0.0) k = 0.0, s = ay / std::max(aa, 1e-9);
  return {float(s), float(k), yy - s * ay - k * by};
}

}  // namespace

CrownShade::CrownShade(const BillboardTree& tree) : grid_(tree.grid), extinction_per_m_(extinctions(tree)) {}

float CrownShade::passed(glm::vec3 point, glm::vec3 direction, int own) const {
  float depth = 0.0f;
  grid_.walk({point, direction}, [&](std::size_t cell, float enter, float leave) {
    if (int(cell) != own) depth += extinction_per_m_[cell] * (leave - enter);
    return depth < 8.0f;
  });
  return std::exp(-depth);
}

std::vector<glm::vec3> sky_directions() {
  std::vector<glm::vec3> directions;
  for (int row = 0; row < sky_rows; ++row)
    for (int column = 0; column < sky_columns; ++column)
      directions.push_back(
          direction_of(2.0f * glm::pi<float>() * (float(column) + 0.5f * float(row)) / sky_columns,
                       std::asin((float(row) + 0.5f) / sky_rows)));
  return directions;
}

std::vector<float> sun_visibility(const BillboardTree& tree, glm::vec3 to_sun) {
  return passed(tree, CrownShade(tree), to_sun);
}

std::vector<float> sky_visibility(const BillboardTree& tree) {
  const CrownShade shade(tree);
  std::vector<float> sum(tree.grid.size(), 0.0f);
  for (const glm::vec3 direction : sky_directions()) {
    const std::vector<float> one = passed(tree, shade, direction);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += one[i] / float(sky_rows * sky_columns);
  }
  return sum;
}

CapturedLight estimated_light(const BillboardTree& tree, std::optional<glm::vec3> to_sun) {
  std::vector<float> brightness;
  for (const glm::u8vec4 base : tree.base) brightness.push_back(luminance_of_srgb(base));
  const std::vector<float> sky = sky_visibility(tree);
  const CrownShade shade(tree);
  CapturedLight best;
  double minimum = std::numeric_limits<double>::max();
  const auto attempt = [&](glm::vec3 direction) {
    const LightFit fit = fitted(tree, brightness, passed(tree, shade, direction), sky);
    if (fit.residual < minimum) minimum = fit.residual, best = {direction, fit.sun, fit.sky};
  };
  if (to_sun) {
    attempt(glm::normalize(*to_sun));
    return best;
  }
  for (const float height : heights_deg)
    for (int i = 0; i < azimuths; ++i)
      attempt(direction_of(2.0f * glm::pi<float>() * float(i) / azimuths, glm::radians(height)));
  for (const float step : refinements_deg) {
    const float azimuth = std::atan2(best.to_sun.x, best.to_sun.y), height = std::asin(best.to_sun.z);
    for (const glm::vec2 off : {glm::vec2(1, 0), glm::vec2(-1, 0), glm::vec2(0, 1), glm::vec2(0, -1)})
      attempt(direction_of(azimuth + glm::radians(step * off.x), height + glm::radians(step * off.y)));
  }
  return best;
}

}  // namespace parvis::trees
