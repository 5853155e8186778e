#include "graphics/reference/sky_sampler.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <span>

#include "base/colour.h"

namespace parvis::reference {
namespace {

using glm::vec2, glm::vec3;

constexpr int max_rows = 256;                // the distribution stays in the cache
constexpr float min_share_of_mean = 0.05f;   // dark parts are chosen, too: they are bilinear, cells are not
constexpr float share_below_horizon = 0.1f;  // as often: there the ground hides it, mostly

/// Mean luminance of the pixels of a cell and of the ones about it, from which lookups within it interpolate.
float cell_luminance(const ImageF& picture, int row, int column, int rows, int columns) {
  const int x0 = column * picture.width / columns - 1, x1 = (column + 1) * picture.width / columns + 1;
  const int y0 = row * picture.height / rows - 1, y1 = (row + 1) * picture.height / rows + 1;
  float sum = 0.0f;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) {
      const float* p = picture.at((x + picture.width) % picture.width, std::clamp(y, 0, picture.height - 1));
      sum += luminance({p[0], p[1], p[2]});
    }
  return sum / float((x1 - x0) * (y1 - y0));
}

}  // namespace

/// Turns weights into the ends of their shares of 1; false where they are all zero.
bool SkySampler::accumulate(Shares& shares, std::size_t first, std::size_t count) {
  const std::span ends(shares.ends.data() + first, count);
  double sum = 0.0;
  for (float& weight : ends) weight = float(sum += double(weight));
  if (sum <= 0.0) return false;
  for (float& end : ends) end = float(double(end) / sum);
  ends.back() = 1.0f;
  for (std::size_t k = 0, i = 0; k < count; ++k) {
    while (i + 1 < count && ends[i] <= float(k) / float(count)) ++i;
    shares.guesses[first + k] = std::uint16_t(i);
  }
  return true;
}

/// The share that holds `uniform`, and where in it, 0..1.
std::pair<int, float> SkySampler::find(const Shares& shares, std::size_t first, std::size_t count,
                                       float uniform) {
  const float* ends = shares.ends.data() + first;
  std::size_t i = shares.guesses[first + std::min(std::size_t(uniform * float(count)), count - 1)];
  while (i + 1 < count && ends[i] <= uniform) ++i;
  const float start = i > 0 ? ends[i - 1] : 0.0f, width = std::max(ends[i] - start, 1e-12f);
  return {int(i), std::clamp((uniform - start) / width, 0.0f, 0.99999994f)};
}

SkySampler::SkySampler(const shading::SkyLight& sky)
    : rows_(std::min(sky.levels.front().height, max_rows)),
      columns_(std::min(sky.levels.front().width, 2 * max_rows)),
      heading_(sky.heading) {
  const ImageF& picture = sky.levels.front();
  const std::size_t rows = std::size_t(rows_), columns = std::size_t(columns_);
  for (int row = 0; row <= rows_; ++row)
    row_cosines_.push_back(std::cos(glm::pi<float>() * float(row) / float(rows_)));
  std::vector<float>& cells = horizontal_.ends;
  double mean = 0.0;
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column) {
      cells.push_back(cell_luminance(picture, row, column, rows_, columns_));
      mean += double(cells.back());
    }
  mean /= double(cells.size());
  horizontal_.guesses.resize(cells.size());
  vertical_.guesses.resize(rows);
  for (std::size_t row = 0; row < rows; ++row) {
    const float solid_angle = row_cosines_[row] - row_cosines_[row + 1];
    const float seen_often = 2 * row < rows ? 1.0f : share_below_horizon;
    float light = 0.0f;
    for (float& cell : std::span(cells.data() + row * columns, columns)) {
      cell += min_share_of_mean * float(mean);
      light += cell * solid_angle * seen_often;
    }
    vertical_.ends.push_back(light);
    if (!accumulate(horizontal_, row * columns, columns)) return;
  }
  accumulate(vertical_, 0, rows);
  for (std::size_t row = 0; row < rows; ++row) {
    const float share = vertical_.ends[row] - (row > 0 ? vertical_.ends[row - 1] : 0.0f);
    row_density_.push_back(share / ((row_cosines_[row] - row_cosines_[row + 1]) * 2.0f * glm::pi<float>()));
  }
}

float SkySampler::cell_density(int row, int column) const {
  const float* end = horizontal_.ends.data() + row * columns_ + column;
  const float share = *end - (column > 0 ? end[-1] : 0.0f);
  return row_density_[std::size_t(row)] * share * float(columns_);
}

SkySampler::Choice SkySampler::choose(vec2 uniform) const {
  const auto [row, down] = find(vertical_, 0, std::size_t(rows_), uniform.y);
  const auto [column, along] =
      find(horizontal_, std::size_t(row) * std::size_t(columns_), std::size_t(columns_), uniform.x);
  const float z = glm::mix(row_cosines_[std::size_t(row)], row_cosines_[std::size_t(row) + 1], down);
  const float u = (float(column) + along) / float(columns_);
  const float azimuth = (u - 0.5f) * 2.0f * glm::pi<float>() + heading_;
  const float radius = std::sqrt(std::max(0.0f, 1.0f - z * z));
  return {{radius * std::sin(azimuth), radius * std::cos(azimuth), z},
          {u, std::acos(std::clamp(z, -1.0f, 1.0f)) / glm::pi<float>()},
          cell_density(row, column)};
}

float SkySampler::density(vec2 uv) const {
  return cell_density(std::clamp(int(uv.y * float(rows_)), 0, rows_ - 1),
                      std::clamp(int(uv.x * float(columns_)), 0, columns_ - 1));
}

}  // namespace parvis::reference
