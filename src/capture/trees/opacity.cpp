// Departures from the thesis: t' is clamped to 1 (as printed, averages run away where rays see too little
// alpha); all alphas are kept within 1/510 of 0 and 1 where a logarithm is taken; mattes may be reduced to
// the cells' resolution; A'_s = A_s d_e^2 / d_n^2, the second of the two equations printed for it, which
// contradict each other.
#include "capture/trees/opacity.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <span>

#include "base/parallel.h"
#include "capture/trees/exact_sum.h"

namespace parvis::trees {
namespace {

constexpr float max_factor = 4.0f;                // of one multiplicative step
constexpr float min_chord_alpha = 1.0f / 510.0f;  // half a step of 8-bit alpha
constexpr float min_start = 1e-3f;  // of alpha: what starts at 0 could never grow by multiplication
constexpr int chord_bits = 36;      // exact_sum.h: sums of up to 1e5 chords
constexpr double min_evidence =
    1e-8;  // chords of light: where less passes a cell no pixel shows what it holds
constexpr int chord_rows_per_task = 8;
constexpr std::array thesis_cutoffs{0.85f, 0.9f, 0.94f, 0.97f, 0.985f, 1.0f};

/// The cells of one ray.
struct RayCells {
  std::vector<std::uint32_t> cells;
  std::vector<float> lengths_m, enter_m;

  void collect(const CellGrid& grid, const ViewRay& ray) {
    cells.clear(), lengths_m.clear(), enter_m.clear();
    grid.walk(ray, [&](std::size_t cell, float enter, float leave) {
      cells.push_back(std::uint32_t(cell)), lengths_m.push_back(leave - enter), enter_m.push_back(enter);
      return true;
    });
  }
};

/// Numerator and denominator of each cell, side by side: the cells of a ray lie all over the memory, and so
/// it takes one cache line for both. Lengths in them are parts of the mean chord.
using Sums = std::vector<double>;

void add(Sums& sums, std::size_t cell, float top, float bottom) {
  sums[2 * cell] += exact_term<chord_bits>(double(top));
  sums[2 * cell + 1] += exact_term<chord_bits>(double(bottom));
}

/// A matte at the resolution of the estimate.
struct Matte {
  Pinhole camera;
  ImageF alpha;
};

struct Estimate {
  const CellGrid& grid;
  const OpacityOptions& options;
  std::vector<float>& tau;
  float chord_m;
};

/// The thesis, equations 4.12-4.17: q'_i = q_i + (q_p - sum q) / n, weighed by w = l A'_s / V_c. Cells that
/// the cutoff has emptied are ignored.
void add_projection(const Estimate& e, const RayCells& ray, float alpha, float inverse_focal_area,
                    Sums& sums) {
  float q_sum = 0.0f;
  int n = 0;
  for (const std::uint32_t cell : ray.cells)
    if (e.tau[cell] > 0.0f) q_sum -= e.tau[cell] * e.chord_m, ++n;
  if (n == 0) return;
  const float q_pixel = std::log(1.0f - std::clamp(alpha, 0.0f, 1.0f - min_chord_alpha));
  const float shift = (q_pixel - q_sum) / float(n);
  const glm::vec3 size = e.grid.cell_size_m();
  const float inverse_volume = 1.0f / (size.x * size.y * size.z);
  for (std::size_t k = 0; k < ray.cells.size(); ++k) {
    const std::uint32_t cell = ray.cells[k];
    if (e.tau[cell] <= 0.0f) continue;
    const float q = -e.tau[cell] * e.chord_m;
    float projected = std::exp(q + shift);
    if (e.options.clamps) projected = std::min(projected, 1.0f);
    const float weight =
        ray.lengths_m[k] * ray.enter_m[k] * ray.enter_m[k] * inverse_focal_area * inverse_volume;
    add(sums, cell, weight * (projected - std::exp(q)), weight);
  }
}

/// SIRT: tau_j += sum_i l_ij (y_i - sum_k l_ik tau_k) / sum_k l_ik, over sum_i l_ij.
void add_sirt(const Estimate& e, const RayCells& ray, float alpha, Sums& sums) {
  float depth = 0.0f, length = 0.0f;
  for (std::size_t k = 0; k < ray.cells.size(); ++k)
    depth += e.tau[ray.cells[k]] * ray.lengths_m[k], length += ray.lengths_m[k];
  if (length <= 0.0f) return;
  const float residual = (-std::log(1.0f - std::clamp(alpha, 0.0f, 1.0f - min_chord_alpha)) - depth) / length;
  for (std::size_t k = 0; k < ray.cells.size(); ++k)
    add(sums, ray.cells[k], ray.lengths_m[k] * residual, ray.lengths_m[k] / e.chord_m);
}

void add_multiplicative(const Estimate& e, const RayCells& ray, float alpha, Sums& sums) {
  float depth = 0.0f;
  for (std::size_t k = 0; k < ray.cells.size(); ++k) depth += e.tau[ray.cells[k]] * ray.lengths_m[k];
  const float passed = std::exp(-depth), wanted = alpha * passed / e.chord_m,
              found = (1.0f - passed) * passed / e.chord_m;
  for (std::size_t k = 0; k < ray.cells.size(); ++k)
    add(sums, ray.cells[k], ray.lengths_m[k] * wanted, ray.lengths_m[k] * found);
}

/// One pass over all pixels of all mattes.
Sums gather(const Estimate& e, std::span<const Matte> mattes) {
  tbb::enumerable_thread_specific<Sums> partial([&] { return Sums(2 * e.tau.size(), 0.0); });
  tbb::enumerable_thread_specific<RayCells> rays;
  for (std::size_t i = 0; i < mattes.size(); ++i) {
    if (!e.options.processes.has(i)) continue;
    const Matte& matte = mattes[i];
    const float inverse_focal_area = 1.0f / (matte.camera.focal.x * matte.camera.focal.y);
    parallel_for(
        std::size_t(matte.alpha.height),
        [&](std::size_t row) {
          Sums& sums = partial.local();
          RayCells& ray = rays.local();
          for (int x = 0; x < matte.alpha.width; ++x) {
            ray.collect(e.grid, matte.camera.ray({float(x) + 0.5f, float(row) + 0.5f}));
            if (ray.cells.empty()) continue;
            const float alpha = *matte.alpha.at(x, int(row));
            switch (e.options.method) {
              case OpacityMethod::projection:
                add_projection(e, ray, alpha, inverse_focal_area, sums);
                break;
              case OpacityMethod::sirt:
                add_sirt(e, ray, alpha, sums);
                break;
              case OpacityMethod::multiplicative:
                add_multiplicative(e, ray, alpha, sums);
                break;
            }
          }
        },
        chord_rows_per_task);
  }
  Sums all(2 * e.tau.size(), 0.0);
  for (const Sums& sums : partial)
    for (std::size_t i = 0; i < all.size(); ++i) all[i] += sums[i];
  e.options.processes.sum(std::span(all));
  return all;
}

/// Applies the sums; returns the mean |change of t| over the cells.
double update_cells(const Estimate& e, const Sums& sums) {
  const std::size_t count = e.tau.size();
  double change = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double top = sums[2 * i], bottom = sums[2 * i + 1];
    if (bottom < min_evidence) continue;
    const float before = std::exp(-e.tau[i] * e.chord_m);
    switch (e.options.method) {
      case OpacityMethod::projection: {
        const float t =
            before + float(top / bottom);  // above 1 without the clamp: negative extinction, as printed
        e.tau[i] = -std::log(std::max(t, min_chord_alpha)) / e.chord_m;
        break;
      }
      case OpacityMethod::sirt:
        e.tau[i] = std::max(0.0f, e.tau[i] + float(top / (bottom * double(e.chord_m))));
        break;
      case OpacityMethod::multiplicative:
        e.tau[i] *= std::min(max_factor, float(top / bottom));
        break;
    }
    const float after = std::exp(-e.tau[i] * e.chord_m);
    if (e.options.cutoff && after > *e.options.cutoff) e.tau[i] = 0.0f;
    change += std::abs(double(after) - double(before));
  }
  return count > 0 ? change / double(count) : 0.0;
}

/// So that a pixel's width at the grid's middle is at most half of a cell.
int chosen_factor(const CellGrid& grid, std::span<const TreeView> views) {
  float factor = 1e9f;
  for (const TreeView& view : views) {
    const float distance = glm::distance(view.camera.position_in_world, grid.box().centre());
    const glm::vec3 size = grid.cell_size_m();
    factor =
        std::min(factor, 0.5f * std::min(size.x, std::min(size.y, size.z)) * view.camera.focal.y / distance);
  }
  return std::clamp(int(factor), 1, 16);
}

}  // namespace

float mean_chord_m(glm::vec3 size) {
  return 2.0f * size.x * size.y * size.z / (size.x * size.y + size.y * size.z + size.z * size.x);
}

std::vector<float> initial_extinction(const CellGrid& grid, std::span<const Silhouette> silhouettes) {
  const float chord_m = mean_chord_m(grid.cell_size_m());
  std::vector<float> tau(grid.size());
  parallel_for(
      grid.size(),
      [&](std::size_t cell) {
        float alpha = 1.0f;
        for (const Silhouette& silhouette : silhouettes)
          alpha = std::min(alpha, silhouette.mean_alpha(grid.bounds(cell)));
        tau[cell] = -std::log(1.0f - std::clamp(alpha, min_start, 1.0f - min_chord_alpha)) / chord_m;
      },
      256);
  return tau;
}

Opacities estimate_opacity(const CellGrid& grid, std::span<const TreeView> views,
                           std::span<const Silhouette> silhouettes, const OpacityOptions& options,
                           Opacities start) {
  Opacities result = std::move(start);
  result.picture_factor = options.picture_factor > 0 ? options.picture_factor : chosen_factor(grid, views);
  std::vector<Matte> mattes(views.size());
  parallel_for(views.size(), [&](std::size_t i) {
    mattes[i] = {reduced(views[i].camera, result.picture_factor),
                 reduced_alpha(views[i].picture, result.picture_factor)};
  });
  if (result.extinction_per_m.empty()) result.extinction_per_m = initial_extinction(grid, silhouettes);
  const Estimate estimate{grid, options, result.extinction_per_m, mean_chord_m(grid.cell_size_m())};
  while (result.mean_change.size() < std::size_t(std::max(options.iterations, 0))) {
    result.mean_change.push_back(update_cells(estimate, gather(estimate, mattes)));
    if (options.after_iteration && !options.after_iteration(result)) break;
  }
  return result;
}

ImageF render_alpha(const CellGrid& grid, std::span<const float> extinction_per_m, const Pinhole& camera) {
  ImageF alpha(camera.width, camera.height, 1);
  parallel_for(std::size_t(camera.height), [&](std::size_t row) {
    for (int x = 0; x < camera.width; ++x) {
      float depth = 0.0f;
      grid.walk(camera.ray({float(x) + 0.5f, float(row) + 0.5f}),
                [&](std::size_t cell, float enter, float leave) {
                  depth += extinction_per_m[cell] * (leave - enter);
                  return true;
                });
      *alpha.at(x, int(row)) = 1.0f - std::exp(-depth);
    }
  });
  return alpha;
}

double alpha_rmse(const CellGrid& grid, std::span<const float> extinction_per_m,
                  std::span<const TreeView> views, int factor) {
  double sum = 0.0, count = 0.0;
  for (const TreeView& view : views) {
    const ImageF truth = reduced_alpha(view.picture, factor);
    const ImageF found = render_alpha(grid, extinction_per_m, reduced(view.camera, factor));
    for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
      const double difference = double(found.pixels[i]) - double(truth.pixels[i]);
      sum += difference * difference, count += 1.0;
    }
  }
  return count > 0.0 ? std::sqrt(sum / count) : 0.0;
}

float cutoff_by_held_out_error(const CellGrid& grid, std::span<const TreeView> views,
                               OpacityOptions options) {
  std::vector<TreeView> used, held_out;
  for (std::size_t i = 0; i < views.size(); ++i) (i % 5 == 2 ? held_out : used).push_back(views[i]);
  options.cutoff.reset();
  const Opacities found = estimate_opacity(grid, used, silhouettes(used), options);
  const float chord_m = mean_chord_m(grid.cell_size_m());
  float best = 1.0f;
  double minimum = std::numeric_limits<double>::max();
  for (const float cutoff : thesis_cutoffs) {
    std::vector<float> tau = found.extinction_per_m;
    for (float& value : tau)
      if (std::exp(-value * chord_m) > cutoff) value = 0.0f;
    const double rmse = alpha_rmse(grid, tau, held_out, found.picture_factor);
    if (rmse < minimum) minimum = rmse, best = cutoff;
  }
  return best;
}

}  // namespace parvis::trees
