// Synthesis of missing parts of a plane in its rectified space, where facades repeat by plain shifts.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace parvis::facades {

/// A rectified piece of a surface: colours on a grid.
struct PlaneGrid {
  int width = 0, height = 0;
  std::vector<glm::vec3> colours;
  std::vector<char> is_known;    ///< has a colour that may be copied
  std::vector<char> is_missing;  ///< wants one; points that are neither lie outside the surface

  PlaneGrid() = default;
  PlaneGrid(int w, int h)
      : width(w),
        height(h),
        colours(std::size_t(w) * std::size_t(h)),
        is_known(colours.size(), 0),
        is_missing(colours.size(), 0) {}
  std::size_t index(int x, int y) const { return std::size_t(y) * std::size_t(width) + std::size_t(x); }
  bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
};

/// Fills every connected group of missing points by the shift under which its rim fits best, if there is one
/// under which the whole group and most of its rim are known; the difference at the rim is spread over the
/// group. Groups without such a shift stay missing. Returns which points were filled.
std::vector<char> fill_by_shifts(PlaneGrid& grid);

/// Fills all missing points that hang together with a known one by Laplace's equation. Returns which points
/// were filled.
std::vector<char> fill_smoothly(PlaneGrid& grid);

}  // namespace parvis::facades
