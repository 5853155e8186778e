// A small volume of known extinction and views of it, for tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "base/colour.h"
#include "base/random.h"
#include "capture/trees/opacity.h"

namespace parvis::trees {

/// A ball of 0.5 m round (0, 0, 1) in which `share` of the cells are filled with `extinction` (1/m), the
/// others empty.
struct TestVolume {
  CellGrid grid;
  std::vector<float> extinction_per_m;

  explicit TestVolume(int side = 27, float share = 0.15f, float extinction = 12.0f) {
    Random random(11);
    const Bounds box{{-0.5f, -0.5f, 0.5f}, {0.5f, 0.5f, 1.5f}};
    std::vector<glm::u16vec3> cells;
    for (int z = 0; z < side; ++z)
      for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
          const glm::vec3 p = (glm::vec3(float(x), float(y), float(z)) + 0.5f) / float(side) - 0.5f;
          if (glm::length(p) > 0.5f || random.uniform() > share) continue;
          cells.emplace_back(x, y, z);
        }
    grid = CellGrid(box, 3, side, std::move(cells));
    extinction_per_m.assign(grid.size(), extinction);
  }

  /// A view from `azimuth` (radians), 4 m away.
  TreeView view(float azimuth, float height_m, int size) const {
    Camera camera;
    camera.vertical_fov = 0.3f;
    camera.world_from_camera =
        look_at({4.0f * std::sin(azimuth), 4.0f * std::cos(azimuth), height_m}, {0.0f, 0.0f, 1.0f});
    TreeView result{"view", pinhole_of(camera, size, size), Image8(size, size, 4, 128)};
    const ImageF alpha = render_alpha(grid, extinction_per_m, result.camera);
    for (std::size_t i = 0; i < alpha.pixels.size(); ++i)
      result.picture.pixels[4 * i + 3] = std::uint8_t(std::lround(255.0f * alpha.pixels[i]));
    return result;
  }
  std::vector<TreeView> ring(int count, int size, float first_azimuth = 0.0f) const {
    std::vector<TreeView> views;
    for (int i = 0; i < count; ++i) {
      views.push_back(
          view(first_azimuth + 6.2831853f * float(i) / float(count), 1.2f + 0.3f * float(i % 3), size));
      views.back().name = "view " + std::to_string(i);
    }
    return views;
  }
};

/// A camera's photograph of premultiplied linear light: straight alpha, sRGB.
inline Image8 photograph_of(ImageF premultiplied) {
  for (std::size_t i = 0; i < premultiplied.pixels.size(); ++i)
    if (i % 4 != 3) premultiplied.pixels[i] /= std::max(premultiplied.pixels[i / 4 * 4 + 3], 1e-6f);
  return srgb8_from_linear(premultiplied);
}

}  // namespace parvis::trees
