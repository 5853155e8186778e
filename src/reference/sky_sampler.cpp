#include "reference/sky_sampler.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "base/colour.h"

namespace parvis::reference {
namespace {

using glm::vec2, glm::vec3;

constexpr int most_rows = 256;                // the distribution stays in the cache
constexpr float least_share_of_mean = 0.05f;  // dark parts are chosen, too: they are bilinear, cells are not
constexpr float share_below_horizon = 0.1f;   // as often: there the ground hides it, mostly
constexpr float pi_f = 3.14159265f;

/// Cosines of the polar angles between which a row lies.
float upper_cosine(int row, int rows) { return std::cos(pi_f * float(row) / float(rows)); }

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

/// Turns weights into the ends of their shares of 1; false where they are all zero.
bool accumulate(std::span<float> weights) {
  double sum = 0.0;
  for (float& weight : weights) weight = float(sum += double(weight));
  if (sum <= 0.0) return false;
  for (float& end : weights) end = float(double(end) / sum);
  weights.back() = 1.0f;
  return true;
}

float share(std::span<const float> ends, int i) {
  return ends[std::size_t(i)] - (i > 0 ? ends[std::size_t(i) - 1] : 0.0f);
}

/// The interval that holds `uniform`, and where in it, 0..1.
std::pair<int, float> interval(std::span<const float> ends, float uniform) {
  const auto found = std::upper_bound(ends.begin(), ends.end() - 1, uniform);
  const int i = int(found - ends.begin());
  const float start = i > 0 ? ends[std::size_t(i) - 1] : 0.0f, width = std::max(*found - start, 1e-12f);
  return {i, std::clamp((uniform - start) / width, 0.0f, 0.99999994f)};
}

}  // namespace

SkySampler::SkySampler(const shading::SkyLight& sky)
    : rows_(std::min(sky.levels.front().height, most_rows)),
      columns_(std::min(sky.levels.front().width, 2 * most_rows)),
      heading_(sky.heading) {
  const ImageF& picture = sky.levels.front();
  std::vector<float> rows(std::size_t(rows_), 0.0f), cells(std::size_t(rows_) * std::size_t(columns_));
  double mean = 0.0;
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column)
      mean += double(cells[std::size_t(row) * std::size_t(columns_) + std::size_t(column)] =
                         cell_luminance(picture, row, column, rows_, columns_));
  mean /= double(cells.size());
  for (int row = 0; row < rows_; ++row) {
    const float solid_angle = upper_cosine(row, rows_) - upper_cosine(row + 1, rows_);
    const std::span line(cells.data() + row * columns_, std::size_t(columns_));
    const float seen_often = 2 * row < rows_ ? 1.0f : share_below_horizon;
    for (float& cell : line) {
      cell += least_share_of_mean * float(mean);
      rows[std::size_t(row)] += cell * solid_angle * seen_often;
    }
    if (!accumulate(line)) return;
  }
  accumulate(rows);
  row_ends_ = std::move(rows);
  column_ends_ = std::move(cells);
}

float SkySampler::cell_density(int row, int column) const {
  const std::span line(column_ends_.data() + row * columns_, std::size_t(columns_));
  const float solid_angle =
      (upper_cosine(row, rows_) - upper_cosine(row + 1, rows_)) * 2.0f * pi_f / float(columns_);
  return share(row_ends_, row) * share(line, column) / solid_angle;
}

vec3 SkySampler::direction(vec2 uniform) const {
  const auto [row, down] = interval(row_ends_, uniform.y);
  const std::span line(column_ends_.data() + row * columns_, std::size_t(columns_));
  const auto [column, along] = interval(line, uniform.x);
  const float z = glm::mix(upper_cosine(row, rows_), upper_cosine(row + 1, rows_), down);
  const float azimuth = ((float(column) + along) / float(columns_) - 0.5f) * 2.0f * pi_f + heading_;
  const float radius = std::sqrt(std::max(0.0f, 1.0f - z * z));
  return {radius * std::sin(azimuth), radius * std::cos(azimuth), z};
}

float SkySampler::density(vec3 direction) const {
  const vec2 uv = shading::equirect_uv(direction, heading_);
  return cell_density(std::clamp(int(uv.y * float(rows_)), 0, rows_ - 1),
                      std::clamp(int(uv.x * float(columns_)), 0, columns_ - 1));
}

}  // namespace parvis::reference
