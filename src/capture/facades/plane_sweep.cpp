// Departures from Collins: windows are compared by normalised correlation, which exposure does not change; of
// the pairs of photographs those that agree best count, because the others look at what hides the surface.
// Departures from Hirschmueller: costs live in the plane's own grid instead of a picture, so that eight
// directions smooth along the surface and not across what a camera happens to see side by side.
#include "capture/facades/plane_sweep.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/parallel.h"

namespace parvis::facades {
namespace {

constexpr std::size_t max_swept_photos = 12, max_partners = 4;
constexpr double min_pair_angle_deg = 3.0, max_pair_angle_deg = 45.0, best_pair_angle_deg = 14.0;
constexpr int window_radius = 2;  ///< grid points
constexpr int min_heights = 12, max_heights = 144;
constexpr std::size_t best_pairs = 4;  ///< that are averaged; fewer where fewer show a point
constexpr float min_contrast = 1.5f;   ///< grey levels, standard deviation: what noise has
// In hundredths of a correlation.
constexpr int unknown_cost = 65, small_step = 7, large_step = 45;

/// A view's rows as pixel = (x . p, y . p) / (z . p), for points p with 1 appended, at a level of the
/// pyramid.
struct Projection {
  glm::dvec4 x, y, z;
  const Image8* picture;
};

Projection projection_of(const GreyPhoto& photo, std::size_t level) {
  const View& view = photo.view;
  const glm::dmat3 rows = glm::transpose(view.camera_from_world);
  const double scale = 1.0 / double(1 << level);
  const auto row = [&](glm::dvec3 r) { return glm::dvec4(r, -glm::dot(r, view.centre)); };
  return {row(scale * (view.fx * rows[0] + view.cx * rows[2])),
          row(scale * (view.fy * rows[1] + view.cy * rows[2])), row(rows[2]), &photo.levels[level]};
}

glm::dvec3 point_of(const SweptRectangle& r, double s, double t) { return r.origin + s * r.u + t * r.v; }

/// Where of 9 x 9 places of the rectangle a photograph sees it from the front: its foreshortening there, 0
/// elsewhere.
std::array<double, 81> shown_by(const GreyPhoto& photo, const SweptRectangle& rectangle) {
  std::array<double, 81> shown{};
  for (int k = 0; k < 81; ++k) {
    const glm::dvec3 point = point_of(rectangle, (k % 9 + 0.5) / 9.0, (k / 9 + 0.5) / 9.0);
    const glm::dvec3 off = photo.view.centre - point, p = photo.view.to_camera(point);
    const double facing = glm::dot(glm::normalize(off), rectangle.normal);
    if (facing < 0.1 || p.z <= 0.0) continue;
    const glm::dvec2 pixel = photo.view.to_pixel(p);
    if (pixel.x < 0.0 || pixel.y < 0.0 || pixel.x >= photo.view.width || pixel.y >= photo.view.height)
      continue;
    shown[std::size_t(k)] = facing;
  }
  return shown;
}

using Pair = std::pair<std::size_t, std::size_t>;

/// Each photograph with those that see the rectangle from about the best angle to it.
std::vector<Pair> pairs_of(const SweptRectangle& rectangle, std::span<const GreyPhoto> photos,
                           const std::vector<std::size_t>& chosen) {
  const glm::dvec3 middle = point_of(rectangle, 0.5, 0.5);
  std::vector<Pair> pairs;
  for (std::size_t a = 0; a < chosen.size(); ++a) {
    std::vector<std::pair<double, std::size_t>> partners;
    for (std::size_t b = 0; b < chosen.size(); ++b) {
      const glm::dvec3 to_a = glm::normalize(photos[chosen[a]].view.centre - middle),
                       to_b = glm::normalize(photos[chosen[b]].view.centre - middle);
      const double angle = glm::degrees(std::acos(std::clamp(glm::dot(to_a, to_b), -1.0, 1.0)));
      if (a != b && angle > min_pair_angle_deg && angle < max_pair_angle_deg)
        partners.emplace_back(std::abs(angle - best_pair_angle_deg), b);
    }
    std::ranges::sort(partners);
    for (std::size_t i = 0; i < std::min(partners.size(), max_partners); ++i)
      pairs.emplace_back(std::min(a, partners[i].second), std::max(a, partners[i].second));
  }
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

/// The level of the pyramid whose pixels are about as large as the grid's cells.
std::size_t level_of(const GreyPhoto& photo, const SweptRectangle& rectangle, double cell) {
  const double depth = std::max(photo.view.to_camera(point_of(rectangle, 0.5, 0.5)).z, 1e-9);
  const double level = std::floor(std::log2(std::max(cell * photo.view.fx / depth, 1.0)) + 0.3);
  return std::min(std::size_t(level), photo.levels.size() - 1);
}

/// How many heights: what two photographs show of a point moves by a cell from one to the next.
int height_count(const SweptRectangle& rectangle, std::span<const GreyPhoto> photos,
                 const std::vector<std::size_t>& chosen, const std::vector<Pair>& pairs, double cell) {
  const glm::dvec3 middle = point_of(rectangle, 0.5, 0.5);
  const auto slope = [&](std::size_t i) {  // what a lifted point moves along the plane, per height
    const glm::dvec3 off = photos[chosen[i]].view.centre - middle;
    const double height = std::max(glm::dot(off, rectangle.normal), 1e-9);
    return (off - height * rectangle.normal) / height;
  };
  double widest = 0.0;
  for (const auto& [a, b] : pairs) widest = std::max(widest, glm::length(slope(a) - slope(b)));
  const double count = (rectangle.high - rectangle.low) * widest / cell + 1.0;
  return int(std::clamp(count, double(min_heights), double(max_heights)));
}

/// A photograph on the lifted rectangle; negative where it does not show it.
void project(const Projection& projection, const SweptRectangle& r, double height, std::vector<float>& grid) {
  const glm::dvec4 origin(r.origin + height * r.normal, 1.0);
  const glm::dvec4 du(r.u / double(r.columns - 1), 0.0), dv(r.v / double(r.rows - 1), 0.0);
  const glm::dvec3 start(glm::dot(projection.x, origin), glm::dot(projection.y, origin),
                         glm::dot(projection.z, origin));
  const glm::dvec3 along_u(glm::dot(projection.x, du), glm::dot(projection.y, du),
                           glm::dot(projection.z, du));
  const glm::dvec3 along_v(glm::dot(projection.x, dv), glm::dot(projection.y, dv),
                           glm::dot(projection.z, dv));
  const Image8& picture = *projection.picture;
  for (int row = 0; row < r.rows; ++row)
    for (int column = 0; column < r.columns; ++column) {
      const glm::dvec3 p = start + double(column) * along_u + double(row) * along_v;
      float& value = grid[std::size_t(row) * std::size_t(r.columns) + std::size_t(column)];
      value = -1.0f;
      if (p.z <= 1e-9) continue;
      const float x = float(p.x / p.z) - 0.5f, y = float(p.y / p.z) - 0.5f;
      if (x < 0.0f || y < 0.0f || x >= float(picture.width - 1) || y >= float(picture.height - 1)) continue;
      const int x0 = int(x), y0 = int(y);
      const float fx = x - float(x0), fy = y - float(y0);
      const std::uint8_t *top = picture.at(x0, y0), *bottom = picture.at(x0, y0 + 1);
      value = (1.0f - fy) * ((1.0f - fx) * float(top[0]) + fx * float(top[1])) +
              fy * ((1.0f - fx) * float(bottom[0]) + fx * float(bottom[1]));
    }
}

/// Sums over windows, clipped at the grid's border.
void window_sums(const std::vector<float>& values, int columns, int rows, std::vector<float>& scratch,
                 std::vector<float>& sums) {
  const auto at = [&](int x, int y) { return std::size_t(y) * std::size_t(columns) + std::size_t(x); };
  for (int y = 0; y < rows; ++y) {
    float running = 0.0f;
    for (int x = 0; x < std::min(window_radius, columns); ++x) running += values[at(x, y)];
    for (int x = 0; x < columns; ++x) {
      if (x + window_radius < columns) running += values[at(x + window_radius, y)];
      scratch[at(x, y)] = running;
      if (x >= window_radius) running -= values[at(x - window_radius, y)];
    }
  }
  for (int y = 0; y < rows; ++y) {
    const int first = std::max(y - window_radius, 0), last = std::min(y + window_radius, rows - 1);
    for (int x = 0; x < columns; ++x) {
      float sum = 0.0f;
      for (int k = first; k <= last; ++k) sum += scratch[at(x, k)];
      sums[at(x, y)] = sum;
    }
  }
}

/// One photograph at one height, ready for correlations.
struct Layer {
  std::vector<float> values, mean, deviation;  ///< deviation: negative where the window is not all shown
};

/// The costs of all heights, in hundredths: grid point by grid point.
class CostVolume {
 public:
  CostVolume(const SweptRectangle& rectangle, std::span<const GreyPhoto> photos) : rectangle_(rectangle) {
    const std::vector<std::size_t> chosen = photos_of_sweep(rectangle, photos);
    pairs_ = pairs_of(rectangle, photos, chosen);
    const double cell = std::max(glm::length(rectangle.u) / (rectangle.columns - 1),
                                 glm::length(rectangle.v) / (rectangle.rows - 1));
    for (const std::size_t i : chosen)
      projections_.push_back(projection_of(photos[i], level_of(photos[i], rectangle, cell)));
    if (pairs_.empty()) return;
    heights_ = height_count(rectangle, photos, chosen, pairs_, cell);
    costs_.assign(points() * std::size_t(heights_), unknown_cost);
    parallel_for(std::size_t(heights_), [&](std::size_t h) { compare(int(h)); });
  }

  std::size_t points() const { return std::size_t(rectangle_.columns) * std::size_t(rectangle_.rows); }
  int heights() const { return heights_; }
  int photographs() const { return pairs_.empty() ? 0 : int(projections_.size()); }
  const std::uint8_t* at(std::size_t point) const { return costs_.data() + point * std::size_t(heights_); }
  double height(double index) const {
    return glm::mix(rectangle_.low, rectangle_.high, index / double(heights_ - 1));
  }

 private:
  Layer layer_of(const Projection& projection, double height) const {
    const int columns = rectangle_.columns, rows = rectangle_.rows;
    Layer layer;
    layer.values.resize(points());
    project(projection, rectangle_, height, layer.values);
    std::vector<float> shown(points()), squares(points()), scratch(points()), counts(points());
    for (std::size_t i = 0; i < points(); ++i) {
      shown[i] = layer.values[i] >= 0.0f;
      if (shown[i] == 0.0f) layer.values[i] = 0.0f;
      squares[i] = layer.values[i] * layer.values[i];
    }
    layer.mean = shown, layer.deviation = shown;
    window_sums(shown, columns, rows, scratch, counts);
    window_sums(layer.values, columns, rows, scratch, layer.mean);
    window_sums(squares, columns, rows, scratch, layer.deviation);
    for (std::size_t i = 0; i < points(); ++i) {
      const float n = full_window(i);
      if (counts[i] < n) {
        layer.deviation[i] = -1.0f;
        continue;
      }
      layer.mean[i] /= n;
      layer.deviation[i] = std::sqrt(std::max(layer.deviation[i] / n - layer.mean[i] * layer.mean[i], 0.0f));
    }
    return layer;
  }
  float full_window(std::size_t i) const {
    const int x = int(i) % rectangle_.columns, y = int(i) / rectangle_.columns;
    const auto span = [](int at, int count) {
      return std::min(at + window_radius, count - 1) - std::max(at - window_radius, 0) + 1;
    };
    return float(span(x, rectangle_.columns) * span(y, rectangle_.rows));
  }

  void compare(int h) {
    std::vector<Layer> layers;
    for (const Projection& projection : projections_) layers.push_back(layer_of(projection, height(h)));
    std::vector<float> product(points()), scratch(points()), sums(points());
    std::vector<std::array<float, best_pairs>> best(points());
    std::vector<std::uint8_t> count(points(), 0);
    for (auto& entry : best) entry.fill(-1.0f);
    for (const auto& [a, b] : pairs_) {
      const Layer &first = layers[a], &second = layers[b];
      for (std::size_t i = 0; i < points(); ++i) product[i] = first.values[i] * second.values[i];
      window_sums(product, rectangle_.columns, rectangle_.rows, scratch, sums);
      for (std::size_t i = 0; i < points(); ++i) {
        const float da = first.deviation[i], db = second.deviation[i];
        if (da < 0.0f || db < 0.0f) continue;
        ++count[i];
        if (da < min_contrast || db < min_contrast) continue;
        float correlation = (sums[i] / full_window(i) - first.mean[i] * second.mean[i]) / (da * db);
        for (float& entry : best[i])
          if (correlation > entry) std::swap(entry, correlation);
      }
    }
    for (std::size_t i = 0; i < points(); ++i) {
      if (count[i] == 0 || best[i][0] <= -1.0f) continue;
      // A third of the pairs that show the point, two at least: the others may look at what hides it.
      const std::size_t used =
          std::clamp<std::size_t>(count[i] / 3, std::min<std::size_t>(count[i], 2), best_pairs);
      float sum = 0.0f;
      for (std::size_t k = 0; k < used; ++k) sum += std::max(best[i][k], 0.0f);
      const float correlation = sum / float(used);
      costs_[i * std::size_t(heights_) + std::size_t(h)] =
          std::uint8_t(std::lround(100.0f * (1.0f - std::clamp(correlation, 0.0f, 1.0f))));
    }
  }

  SweptRectangle rectangle_;
  std::vector<Projection> projections_;
  std::vector<Pair> pairs_;
  int heights_ = 0;
  std::vector<std::uint8_t> costs_;
};

/// The cheapest way to a point along one direction, for each height.
void extend_path(const std::uint8_t* cost, const std::uint16_t* before, int heights, std::uint16_t* path) {
  if (!before) {
    std::copy_n(cost, heights, path);
    return;
  }
  const int minimum = *std::min_element(before, before + heights);
  for (int h = 0; h < heights; ++h) {
    int cheapest = std::min<int>(before[h], minimum + large_step);
    if (h > 0) cheapest = std::min(cheapest, before[h - 1] + small_step);
    if (h + 1 < heights) cheapest = std::min(cheapest, before[h + 1] + small_step);
    path[h] = std::uint16_t(int(cost[h]) + cheapest - minimum);
  }
}

/// Sums of the paths from eight directions.
std::vector<std::uint16_t> smoothed(const CostVolume& costs, int columns, int rows) {
  const std::size_t heights = std::size_t(costs.heights());
  std::vector<std::uint16_t> sums(costs.points() * heights, 0);
  const auto add = [&](std::size_t point, const std::uint16_t* path) {
    std::uint16_t* sum = sums.data() + point * heights;
    for (std::size_t h = 0; h < heights; ++h) sum[h] = std::uint16_t(sum[h] + path[h]);
  };
  parallel_for(std::size_t(rows), [&](std::size_t row) {  // along the rows, both ways
    std::vector<std::uint16_t> path(heights), before(heights);
    for (const bool is_back : {false, true})
      for (int k = 0; k < columns; ++k) {
        const std::size_t point = row * std::size_t(columns) + std::size_t(is_back ? columns - 1 - k : k);
        extend_path(costs.at(point), k > 0 ? before.data() : nullptr, int(heights), path.data());
        add(point, path.data());
        std::swap(path, before);
      }
  });
  std::vector<std::uint16_t> now(std::size_t(columns) * heights), before(now.size());
  for (const int down : {1, -1})
    for (const int across : {-1, 0, 1})
      for (int k = 0; k < rows; ++k) {
        const int row = down > 0 ? k : rows - 1 - k;
        parallel_for(
            std::size_t(columns),
            [&](std::size_t column) {
              const int from = int(column) - across;
              const std::uint16_t* previous = k > 0 && from >= 0 && from < columns
                                                  ? before.data() + std::size_t(from) * heights
                                                  : nullptr;
              const std::size_t point = std::size_t(row) * std::size_t(columns) + column;
              extend_path(costs.at(point), previous, int(heights), now.data() + column * heights);
              add(point, now.data() + column * heights);
            },
            16);
        std::swap(now, before);
      }
  return sums;
}

/// The middle of 3 x 3 heights: single points that went astray.
std::vector<float> without_spikes(const std::vector<float>& heights, int columns, int rows) {
  std::vector<float> result = heights;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      std::array<float, 9> around{};
      std::size_t count = 0;
      for (int v = std::max(y - 1, 0); v <= std::min(y + 1, rows - 1); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, columns - 1); ++u)
          around[count++] = heights[std::size_t(v) * std::size_t(columns) + std::size_t(u)];
      std::nth_element(around.begin(), around.begin() + std::ptrdiff_t(count / 2),
                       around.begin() + std::ptrdiff_t(count));
      result[std::size_t(y) * std::size_t(columns) + std::size_t(x)] = around[count / 2];
    }
  return result;
}

}  // namespace

GreyPhoto grey_photo(const View& view, const Image8& picture) {
  GreyPhoto photo{view, {Image8(picture.width, picture.height, 1)}};
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const std::uint8_t* p = picture.at(x, y);
      *photo.levels[0].at(x, y) = std::uint8_t((54 * p[0] + 183 * p[1] + 19 * p[2] + 128) >> 8);
    }
  while (photo.levels.back().width >= 32 && photo.levels.back().height >= 32) {
    const Image8& fine = photo.levels.back();
    Image8 half(fine.width / 2, fine.height / 2, 1);
    for (int y = 0; y < half.height; ++y)
      for (int x = 0; x < half.width; ++x)
        *half.at(x, y) = std::uint8_t((fine.at(2 * x, 2 * y)[0] + fine.at(2 * x + 1, 2 * y)[0] +
                                       fine.at(2 * x, 2 * y + 1)[0] + fine.at(2 * x + 1, 2 * y + 1)[0] + 2) /
                                      4);
    photo.levels.push_back(std::move(half));
  }
  return photo;
}

// They together show most, each place several times.
std::vector<std::size_t> photos_of_sweep(const SweptRectangle& rectangle, std::span<const GreyPhoto> photos) {
  std::vector<std::array<double, 81>> shown;
  for (const GreyPhoto& photo : photos) shown.push_back(shown_by(photo, rectangle));
  std::vector<std::size_t> chosen;
  std::array<double, 81> covered{};
  while (chosen.size() < max_swept_photos) {
    double best_gain = 0.5;
    std::size_t best = photos.size();
    for (std::size_t i = 0; i < photos.size(); ++i) {
      if (std::ranges::count(chosen, i) > 0) continue;
      double gain = 0.0;
      for (std::size_t k = 0; k < 81; ++k)
        gain += std::sqrt(covered[k] + shown[i][k]) - std::sqrt(covered[k]);
      if (gain > best_gain) best_gain = gain, best = i;
    }
    if (best == photos.size()) break;
    for (std::size_t k = 0; k < 81; ++k) covered[k] += shown[best][k];
    chosen.push_back(best);
  }
  return chosen;
}

SweptHeights swept_heights(const SweptRectangle& rectangle, std::span<const GreyPhoto> photos) {
  const CostVolume costs(rectangle, photos);
  SweptHeights found;
  found.photographs = costs.photographs();
  if (found.photographs == 0) return found;
  const std::vector<std::uint16_t> sums = smoothed(costs, rectangle.columns, rectangle.rows);
  const int count = costs.heights();
  found.heights.resize(costs.points()), found.agreement.resize(costs.points());
  for (std::size_t i = 0; i < costs.points(); ++i) {
    const std::uint16_t* sum = sums.data() + i * std::size_t(count);
    const int best = int(std::min_element(sum, sum + count) - sum);
    double between = 0.0;  // the parabola through the best and its neighbours
    if (best > 0 && best + 1 < count) {
      const double a = sum[best - 1], b = sum[best], c = sum[best + 1], bend = a - 2.0 * b + c;
      if (bend > 0.0) between = std::clamp(0.5 * (a - c) / bend, -0.5, 0.5);
    }
    found.heights[i] = float(costs.height(best + between));
    found.agreement[i] = 1.0f - 0.01f * float(costs.at(i)[best]);
  }
  found.heights = without_spikes(found.heights, rectangle.columns, rectangle.rows);
  return found;
}

}  // namespace parvis::facades
