#include "capture/trees/tree_volume.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "base/colour.h"
#include "base/parallel.h"
#include "base/random.h"
#include "capture/trees/exact_sum.h"
#include "capture/trees/fit_rows.h"

namespace parvis::trees {
namespace {

constexpr int rows_per_task = 8;
constexpr float opaque_enough = 1e-3f;  // of the light: what lies behind is not seen
constexpr float max_depth_per_cell =
    12.0f;                           // optical, along the mean chord: more is not distinguishable from opaque
constexpr float rate_decay = 0.25f;  // of the steps, per pass
constexpr int gradient_bits = 30;    // exact_sum.h: gradients of up to 8e6
const glm::vec3 unseen_colour(0.03f, 0.05f, 0.02f);  // of cells that no photograph shows: a leaf in the shade
constexpr float beta1 = 0.9f, beta2 = 0.98f, adam_epsilon = 1e-7f;

constexpr float min_slope_light = 0.01f;  // below it the slope of sRGB is taken as there
constexpr float min_root = 0.03f;         // of a colour's light: from 0 no step leads away

/// The factor by which a display magnifies an error of light: the slope of sRGB where the pixel's light
/// stands before grey; alpha counts as it is.
glm::vec4 display_slope(glm::vec4 rgba) {
  const glm::vec3 light = glm::max(glm::vec3(rgba) + 0.5f * (1.0f - rgba.w), min_slope_light);
  return glm::vec4((1.055f / 2.4f) * glm::pow(light, glm::vec3(1.0f / 2.4f - 1.0f)), 1.0f);
}

/// A cell on a ray.
struct Crossing {
  std::uint32_t cell;
  float length_m, kept,
      before;  ///< exp(-tau l); what of the light reaches the cell from behind it to the eye: T
};

/// The cells of a ray until it is opaque; returns what passes all of them.
float collect(const TreeVolume& volume, const ViewRay& ray, std::vector<Crossing>& crossings) {
  crossings.clear();
  float passed = 1.0f;
  volume.grid.walk(ray, [&](std::size_t cell, float enter, float leave) {
    const float kept = std::exp(-volume.extinction_per_m[cell] * (leave - enter));
    crossings.push_back({std::uint32_t(cell), leave - enter, kept, passed});
    passed *= kept;
    return passed > opaque_enough;
  });
  return passed;
}

glm::vec4 colour_of(const TreeVolume& volume, std::uint32_t cell) {
  return glm::vec4(volume.colour[cell], 1.0f);
}

// Per cell: of the light; of the logarithm of the extinction. Exact sums.
using Gradients = std::vector<glm::dvec4>;

/// Gradients of one pixel's squared error; returns that error.
double add_pixel(const TreeVolume& volume, const std::vector<Crossing>& crossings, glm::vec4 wanted,
                 Gradients& gradients) {
  glm::vec4 found(0.0f);
  for (const Crossing& c : crossings) found += c.before * (1.0f - c.kept) * colour_of(volume, c.cell);
  const glm::vec4 slope = display_slope(wanted), error = slope * (found - wanted), residual = slope * error;
  glm::vec4 behind = found;  // what the cells from here on bring
  for (const Crossing& c : crossings) {
    const float weight = c.before * (1.0f - c.kept);
    const glm::vec4 colour = colour_of(volume, c.cell);
    behind -= weight * colour;
    const glm::vec4 by_extinction = c.length_m * (c.before * c.kept * colour - behind);
    const glm::vec4 gradient(weight * glm::vec3(residual),
                             volume.extinction_per_m[c.cell] * glm::dot(by_extinction, residual));
    gradients[c.cell] += exact_term<gradient_bits>(glm::dvec4(gradient));
  }
  return double(glm::dot(error, error));
}

/// A cell's step by Adam, at rate 1.
glm::vec4 adam_step(FitState& state, std::size_t i, glm::vec4 gradient) {
  glm::vec4 &mean = state.mean[i], &mean_square = state.mean_square[i];
  state.cell_steps[i] = std::uint16_t(std::min(int(state.cell_steps[i]) + 1, 60000));
  mean = beta1 * mean + (1.0f - beta1) * gradient;
  mean_square = beta2 * mean_square + (1.0f - beta2) * gradient * gradient;
  const float n = float(state.cell_steps[i]);
  const glm::vec4 m = mean / (1.0f - std::pow(beta1, n)), v = mean_square / (1.0f - std::pow(beta2, n));
  return m / (glm::sqrt(v) + adam_epsilon);
}

/// Moves each cell toward the mean of its six neighbours, light and extinction together; where a neighbour is
/// not stored it is empty. Few rays pass a small cell: what no photograph decides should be as it is round
/// it.
void smooth(TreeVolume& volume, float share) {
  const CellGrid& grid = volume.grid;
  std::vector<glm::vec4> means(grid.size());
  const auto value = [&](std::size_t i) {
    return volume.extinction_per_m[i] * glm::vec4(volume.colour[i], 1.0f);
  };
  parallel_for(
      grid.size(),
      [&](std::size_t i) {
        glm::vec4 sum(0.0f);
        float count = 0.0f;
        for (int k = 0; k < 6; ++k) {
          glm::ivec3 place(grid.cells()[i]);
          place[k / 2] += k % 2 == 0 ? -1 : 1;
          if (place[k / 2] < 0 || place[k / 2] >= grid.side()) continue;
          const int neighbour = grid.cell_at(place);
          count += 1.0f;
          if (neighbour != no_cell) sum += value(std::size_t(neighbour));
        }
        means[i] = sum / count;
      },
      4096);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const glm::vec4 mixed = glm::mix(value(i), means[i], share);
    volume.extinction_per_m[i] = mixed.w;
    if (mixed.w > 1e-6f) volume.colour[i] = glm::vec3(mixed) / mixed.w;
  }
}

/// The gradients of some rows of a photograph, and the step along them.
class VolumeFit {
 public:
  VolumeFit(TreeVolume& volume, const FitOptions& options, FitState& state)
      : volume_(volume),
        options_(options),
        max_extinction_per_m_(max_depth_per_cell / mean_chord_m(volume.grid.cell_size_m())),
        state_(state),
        gradients_([count = volume.grid.size()] { return Gradients(count, glm::dvec4(0.0)); }) {
    const std::size_t count = volume.grid.size();
    state.mean.resize(count, glm::vec4(0.0f)), state.mean_square.resize(count, glm::vec4(0.0f));
    state.cell_steps.resize(count, 0);
  }

  /// All rows, those of this process; returns the sum of the pixels' squared errors, of all processes.
  double gather(const FitRows& rows) {
    tbb::enumerable_thread_specific<double> errors(0.0);
    parallel_for(
        std::size_t(rows.rgba.height),
        [&](std::size_t i) {
          std::vector<Crossing>& crossings = rays_.local();
          Gradients& gradients = gradients_.local();
          double& error = errors.local();
          const float y = float(rows.row(int(i))) + 0.5f;
          for (int x = 0; x < rows.rgba.width; ++x) {
            collect(volume_, rows.camera.ray({float(x) + 0.5f, y}), crossings);
            const float* p = rows.rgba.at(x, int(i));
            error += add_pixel(volume_, crossings, {p[0], p[1], p[2], p[3]}, gradients);
          }
        },
        rows_per_task);
    double sum = errors.combine(std::plus<>());
    options_.processes.sum(std::span(&sum, 1));
    return sum;
  }

  /// Moves every cell that a ray has met.
  void step(float rate) {
    sum_over_processes();
    parallel_for(
        volume_.grid.size(),
        [&](std::size_t i) {
          glm::dvec4 sum(0.0);
          for (Gradients& g : gradients_) sum += g[i], g[i] = glm::dvec4(0.0);
          if (sum == glm::dvec4(0.0)) return;
          const glm::vec3 root = glm::max(glm::sqrt(volume_.colour[i]), min_root);
          const glm::vec4 gradient =
              glm::vec4(sum) * glm::vec4(2.0f * root, 1.0f);  // of the root of the light
          const glm::vec4 step = rate * adam_step(state_, i, gradient);
          const glm::vec3 moved = glm::clamp(root - options_.colour_rate * glm::vec3(step), min_root, 1.0f);
          volume_.colour[i] = moved * moved;
          volume_.extinction_per_m[i] =
              std::min(volume_.extinction_per_m[i] * std::exp(-options_.extinction_rate * step.w),
                       max_extinction_per_m_);
        },
        1024);
  }

 private:
  void sum_over_processes() {
    if (!options_.processes.are_several()) return;
    Gradients& all = gradients_.local();
    for (Gradients& g : gradients_) {
      if (&g == &all) continue;
      for (std::size_t i = 0; i < all.size(); ++i) all[i] += g[i], g[i] = glm::dvec4(0.0);
    }
    options_.processes.sum(std::span(&all.front().x, 4 * all.size()));
  }

  TreeVolume& volume_;
  const FitOptions& options_;
  float max_extinction_per_m_;
  FitState& state_;
  tbb::enumerable_thread_specific<Gradients> gradients_;
  tbb::enumerable_thread_specific<std::vector<Crossing>> rays_;
};

}  // namespace

float TreeVolume::alpha(std::size_t cell) const {
  return 1.0f - std::exp(-extinction_per_m[cell] * mean_chord_m(grid.cell_size_m()));
}

TreeVolume coloured(CellGrid grid, std::vector<float> extinction_per_m, std::span<const TreeView> views,
                    const machines::Processes& processes) {
  TreeVolume volume{std::move(grid), std::move(extinction_per_m), {}};
  tbb::enumerable_thread_specific<Gradients> partial(
      [&] { return Gradients(volume.grid.size(), glm::dvec4(0.0)); });
  tbb::enumerable_thread_specific<std::vector<Crossing>> rays;
  for (std::size_t photograph = 0; photograph < views.size(); ++photograph) {
    if (!processes.has(photograph)) continue;
    const TreeView& view = views[photograph];
    parallel_for(
        std::size_t(view.camera.height),
        [&](std::size_t row) {
          Gradients& sums = partial.local();
          std::vector<Crossing>& crossings = rays.local();
          for (int x = 0; x < view.camera.width; ++x) {
            const std::uint8_t* p = view.picture.at(x, int(row));
            if (p[3] == 0) continue;
            const glm::vec4 seen(linear_from_srgb(glm::vec3(float(p[0]), float(p[1]), float(p[2])) / 255.0f),
                                 1.0f);
            collect(volume, view.camera.ray({float(x) + 0.5f, float(row) + 0.5f}), crossings);
            for (const Crossing& c : crossings)
              sums[c.cell] += exact_term<gradient_bits>(
                  glm::dvec4(c.before * (1.0f - c.kept + 1e-4f) * (float(p[3]) / 255.0f) * seen));
          }
        },
        rows_per_task);
  }
  Gradients all(volume.grid.size(), glm::dvec4(0.0));
  for (const Gradients& sums : partial)
    for (std::size_t i = 0; i < all.size(); ++i) all[i] += sums[i];
  if (processes.are_several()) processes.sum(std::span(&all.front().x, 4 * all.size()));
  for (const glm::dvec4& sum : all)
    volume.colour.push_back(sum.w > 0.0 ? glm::vec3(glm::dvec3(sum) / sum.w) : unseen_colour);
  return volume;
}

std::vector<double> fit_volume(TreeVolume& volume, std::span<const TreeView> views,
                               const FitOptions& options) {
  FitState state;
  fit_volume(volume, views, options, state);
  return state.errors;
}

void fit_volume(TreeVolume& volume, std::span<const TreeView> views, const FitOptions& options,
                FitState& state) {
  std::vector<FitRows> photographs(views.size());
  parallel_for(views.size(), [&](std::size_t i) {
    photographs[i] = FitRows::of(views[i], options.picture_factor, options.processes);
  });
  std::vector<std::size_t> order(views.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  Random random(options.seed, 500);
  VolumeFit fit(volume, options, state);
  for (std::size_t i = 0; i < options.steps(views.size()); ++i) {
    const std::size_t epoch = i / order.size();
    if (i % order.size() == 0)
      for (std::size_t k = order.size(); k > 1; --k)
        std::swap(order[k - 1], order[std::size_t(random.index(int(k)))]);
    if (i < state.steps) continue;  // done before: the order alone is followed
    const FitRows& rows = photographs[order[i % order.size()]];
    state.error_sum += fit.gather(rows);
    state.value_sum += 4.0 * double(rows.camera.width) * double(rows.camera.height);
    fit.step(1.0f / (1.0f + rate_decay * float(epoch)));
    ++state.steps;
    if (state.steps % order.size() == 0) {
      state.errors.push_back(std::sqrt(state.error_sum / state.value_sum));
      state.error_sum = state.value_sum = 0.0;
      if (options.smoothing > 0.0f) smooth(volume, options.smoothing);
    }
    if (options.after_step && !options.after_step(state)) return;
  }
}

TreeVolume without_transparent_cells(const TreeVolume& volume, float cutoff) {
  TreeVolume result;
  std::vector<glm::u16vec3> cells;
  for (std::size_t i = 0; i < volume.grid.size(); ++i) {
    if (1.0f - volume.alpha(i) > cutoff) continue;
    cells.push_back(volume.grid.cells()[i]);
    result.extinction_per_m.push_back(volume.extinction_per_m[i]), result.colour.push_back(volume.colour[i]);
  }
  result.grid = CellGrid(volume.grid.box(), volume.grid.branching(), volume.grid.side(), std::move(cells));
  return result;
}

Result<TreeVolume> subdivided(const TreeVolume& volume) {
  const int branching = volume.grid.branching(), side = volume.grid.side() * branching;
  if (side > max_grid_side)
    return error("the grid cannot be divided again: {} cells along each side, at most {} are possible", side,
                 max_grid_side);
  TreeVolume result;
  std::vector<glm::u16vec3> cells;
  for (std::size_t i = 0; i < volume.grid.size(); ++i)
    for (int c = 0; c < branching * branching * branching; ++c) {
      cells.emplace_back(branching * glm::ivec3(volume.grid.cells()[i]) +
                         glm::ivec3(c % branching, c / branching % branching, c / (branching * branching)));
      result.extinction_per_m.push_back(volume.extinction_per_m[i]),
          result.colour.push_back(volume.colour[i]);
    }
  result.grid = CellGrid(volume.grid.box(), branching, side, std::move(cells));
  return result;
}

ImageF render_volume(const TreeVolume& volume, const Pinhole& camera) {
  ImageF picture(camera.width, camera.height, 4);
  tbb::enumerable_thread_specific<std::vector<Crossing>> rays;
  parallel_for(std::size_t(camera.height), [&](std::size_t row) {
    std::vector<Crossing>& crossings = rays.local();
    for (int x = 0; x < camera.width; ++x) {
      collect(volume, camera.ray({float(x) + 0.5f, float(row) + 0.5f}), crossings);
      glm::vec4 sum(0.0f);
      for (const Crossing& c : crossings) sum += c.before * (1.0f - c.kept) * colour_of(volume, c.cell);
      for (int k = 0; k < 4; ++k) picture.at(x, int(row))[k] = sum[k];
    }
  });
  return picture;
}

}  // namespace parvis::trees
