#include "capture/facades/moved_shadows.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/median.h"
#include "base/parallel.h"
#include "capture/facades/blend.h"

namespace parvis::facades {
namespace {

constexpr int grid_step = 4;                    ///< pixels of the photograph per cell of the grid
constexpr std::size_t min_light_witnesses = 3;  ///< the photograph itself among them
// Logarithms of ratios of light: noise and misregistration below the first, a shadow from the second on.
constexpr float same_light = 0.2f, other_light = 0.4f;
constexpr float max_log_gain = 2.0f;       ///< 7.4 times: clear sun over blue sky
constexpr float max_colour_change = 0.7f;  ///< between the channels' logarithms: beyond it, another surface
constexpr int blob_radius = 2;             ///< cells: what is smaller is no shadow but a reflection or a leaf
constexpr int guide_radius = 4;            ///< cells
constexpr float guide_epsilon = 0.003f;    ///< variance of the guide (log light) below which it is flat
constexpr float darkest = 0.004f;

glm::vec3 log_of(glm::vec3 linear) { return glm::log(glm::max(linear, glm::vec3(darkest))); }

/// Logarithms of a photograph's colours, means of cells of step x step pixels.
ImageF cells_of(const PreparedPhoto& photo) {
  ImageF cells((photo.view.width + grid_step - 1) / grid_step,
               (photo.view.height + grid_step - 1) / grid_step, 3);
  for (int y = 0; y < cells.height; ++y)
    for (int x = 0; x < cells.width; ++x) {
      glm::vec3 sum(0.0f);
      int count = 0;
      for (int v = y * grid_step; v < std::min((y + 1) * grid_step, photo.view.height); ++v)
        for (int u = x * grid_step; u < std::min((x + 1) * grid_step, photo.view.width); ++u, ++count) {
          const float* p = photo.colours.at(u, v);
          sum += glm::vec3(p[0], p[1], p[2]);
        }
      const glm::vec3 mean = log_of(sum / float(count));
      for (int c = 0; c < 3; ++c) cells.at(x, y)[c] = mean[c];
    }
  return cells;
}

/// Logarithm of the factor that turns a cell's light into that of most photographs; 0: it stays.
float log_gain(std::span<const PreparedPhoto> photos, std::span<const ImageF> cells, std::size_t own,
               glm::vec3 own_colour, glm::dvec3 point) {
  std::array<std::vector<float>, 3> seen;
  for (std::size_t c = 0; c < 3; ++c) seen[c].push_back(own_colour[int(c)]);
  for (std::size_t i = 0; i < photos.size(); ++i) {
    if (i == own) continue;
    const View& view = photos[i].view;
    const glm::dvec3 p = view.to_camera(point);
    if (p.z <= 0.0) continue;
    const glm::dvec2 pixel = view.to_pixel(p);
    if (pixel.x < grid_step || pixel.y < grid_step || pixel.x > view.width - grid_step ||
        pixel.y > view.height - grid_step)
      continue;
    const std::size_t index = std::size_t(pixel.y) * std::size_t(view.width) + std::size_t(pixel.x);
    if (not_hidden(float(p.z), photos[i].depths[index], depth_tolerance) < 0.5f) continue;
    if (!photos[i].trust.empty() && photos[i].trust.pixels[index] < 0.5f) continue;
    const glm::vec3 colour = sampled_rgb(cells[i], pixel / double(grid_step));
    for (std::size_t c = 0; c < 3; ++c) seen[c].push_back(colour[int(c)]);
  }
  if (seen[0].size() < min_light_witnesses) return 0.0f;
  glm::vec3 gain;
  for (std::size_t c = 0; c < 3; ++c) gain[int(c)] = median(std::move(seen[c])) - own_colour[int(c)];
  const float least = std::min({gain.x, gain.y, gain.z}), most = std::max({gain.x, gain.y, gain.z});
  if (most - least > max_colour_change || least * most < 0.0f) return 0.0f;
  const float mean = (gain.x + gain.y + gain.z) / 3.0f;
  return std::abs(mean) > max_log_gain ? 0.0f
                                       : mean * glm::smoothstep(same_light, other_light, std::abs(mean));
}

/// Mean over (2 radius + 1)^2 cells of one channel, by sums along rows and columns.
ImageF box_mean(const ImageF& image, int radius) {
  ImageF across(image.width, image.height, 1), down = across;
  const auto run = [&](const ImageF& from, ImageF& to, bool is_row) {
    const int lines = is_row ? image.height : image.width, length = is_row ? image.width : image.height;
    for (int line = 0; line < lines; ++line) {
      const auto value = [&](int i) {
        const int k = std::clamp(i, 0, length - 1);
        return is_row ? *from.at(k, line) : *from.at(line, k);
      };
      double sum = 0.0;
      for (int i = -radius - 1; i < radius; ++i) sum += double(value(i));
      for (int i = 0; i < length; ++i) {
        sum += double(value(i + radius)) - double(value(i - radius - 1));
        (is_row ? *to.at(i, line) : *to.at(line, i)) = float(sum / (2 * radius + 1));
      }
    }
  };
  run(image, across, true), run(across, down, false);
  return down;
}

template <class F>
ImageF each(const ImageF& a, const ImageF& b, F f) {
  ImageF out(a.width, a.height, 1);
  for (std::size_t i = 0; i < out.pixels.size(); ++i) out.pixels[i] = f(a.pixels[i], b.pixels[i]);
  return out;
}

/// Cells of which most of the neighbourhood has no gain lose theirs.
ImageF without_specks(const ImageF& gains) {
  const ImageF share =
      box_mean(each(gains, gains, [](float g, float) { return g != 0.0f ? 1.0f : 0.0f; }), blob_radius);
  return each(gains, share, [](float g, float s) { return s < 0.4f ? 0.0f : g; });
}

/// Gain per pixel: along edges of the photograph, a line of the guide's value in each neighbourhood.
ImageF guided(const PreparedPhoto& photo, const ImageF& guide, const ImageF& gains) {
  const auto product = [](float a, float b) { return a * b; };
  const auto mean = [](const ImageF& image) { return box_mean(image, guide_radius); };
  const ImageF of_guide = mean(guide), of_gain = mean(gains), of_square = mean(each(guide, guide, product)),
               of_product = mean(each(guide, gains, product));
  ImageF slope(guide.width, guide.height, 1), offset = slope;
  for (std::size_t i = 0; i < slope.pixels.size(); ++i) {
    const float variance = of_square.pixels[i] - of_guide.pixels[i] * of_guide.pixels[i],
                covariance = of_product.pixels[i] - of_guide.pixels[i] * of_gain.pixels[i];
    slope.pixels[i] = covariance / (std::max(variance, 0.0f) + guide_epsilon);
    offset.pixels[i] = of_gain.pixels[i] - slope.pixels[i] * of_guide.pixels[i];
  }
  slope = mean(slope), offset = mean(offset);
  ImageF result(photo.view.width, photo.view.height, 1);
  parallel_for(std::size_t(result.height), [&](std::size_t row) {
    const int y = int(row);
    for (int x = 0; x < result.width; ++x) {
      const float* p = photo.colours.at(x, y);
      const glm::vec3 logs = log_of({p[0], p[1], p[2]});
      const glm::dvec2 cell = glm::dvec2(x + 0.5, y + 0.5) / double(grid_step);
      const float gain =
          sampled(slope, cell, 0) * (logs.x + logs.y + logs.z) / 3.0f + sampled(offset, cell, 0);
      *result.at(x, y) = std::exp(std::clamp(gain, -max_log_gain, max_log_gain));
    }
  });
  return result;
}

}  // namespace

std::vector<ImageF> shadow_gains(std::span<const PreparedPhoto> photos) {
  std::vector<ImageF> cells, result;
  for (const PreparedPhoto& photo : photos) cells.push_back(cells_of(photo));
  for (std::size_t i = 0; i < photos.size(); ++i) {
    const View& view = photos[i].view;
    ImageF gains(cells[i].width, cells[i].height, 1), guide = gains;
    parallel_for(std::size_t(gains.height), [&](std::size_t row) {
      const int y = int(row);
      for (int x = 0; x < gains.width; ++x) {
        const float* p = cells[i].at(x, y);
        *guide.at(x, y) = (p[0] + p[1] + p[2]) / 3.0f;
        const int u = std::min(x * grid_step + grid_step / 2, view.width - 1),
                  v = std::min(y * grid_step + grid_step / 2, view.height - 1);
        const float depth = photos[i].depths[std::size_t(v) * std::size_t(view.width) + std::size_t(u)];
        if (!std::isfinite(depth)) continue;
        *gains.at(x, y) =
            log_gain(photos, cells, i, {p[0], p[1], p[2]}, view.to_world({u + 0.5, v + 0.5}, depth));
      }
    });
    gains = without_specks(gains);
    const bool is_none = std::ranges::all_of(gains.pixels, [](float gain) { return gain == 0.0f; });
    result.push_back(is_none ? ImageF(view.width, view.height, 1, 1.0f) : guided(photos[i], guide, gains));
  }
  return result;
}

void apply_gains(const ImageF& gains, ImageF& colours) {
  for (std::size_t i = 0; i < gains.pixels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      float& value = colours.pixels[3 * i + c];
      value = std::clamp(value * gains.pixels[i], 0.0f, 1.0f);
    }
}

}  // namespace parvis::facades
