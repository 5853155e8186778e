// Virtual grids (Estalella and others 2005, section 5): reflection points are searched for the corners of a
// grid about a mesh alone, and the mesh's virtual vertices interpolated between those. The search costs what
// the grid has corners, and smooth interpolation does not flicker.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

namespace parvis::virtual_objects {

/// A corner or a vertex where a reflector shows it; what is lost is not drawn.
struct VirtualPoint {
  glm::vec3 position{0.0f};
  bool is_lost = false;
};

/// Cells of one size that fill the box of a mesh.
struct GridLayout {
  glm::vec3 origin{0.0f}, cell{1.0f};  ///< cell: its edges
  glm::ivec3 count{1};                 ///< of cells

  /// In cells from the origin: the sum that grid_interpolation.glsl does, to the last bit.
  glm::vec3 place_of(glm::vec3 vertex) const { return (vertex - origin) * (1.0f / cell); }
  glm::ivec3 cell_of(glm::vec3 vertex) const {
    return glm::clamp(glm::ivec3(glm::floor(place_of(vertex))), glm::ivec3(0), count - 1);
  }
  /// Corners of the whole box, used or not, and the place of one among them; x changes fastest.
  std::size_t box_size() const {
    return std::size_t(count.x + 1) * std::size_t(count.y + 1) * std::size_t(count.z + 1);
  }
  std::size_t place_in_box(glm::ivec3 corner) const {
    return (std::size_t(corner.z) * std::size_t(count.y + 1) + std::size_t(corner.y)) *
               std::size_t(count.x + 1) +
           std::size_t(corner.x);
  }
};

class VirtualGrid {
 public:
  static constexpr std::uint32_t no_corner = 0xffffffff;

  /// A grid with at most `share` (0..1) as many corners as there are vertices, at least one cell: its cells
  /// are as near to cubes as the vertices' box lets them be, and only those that hold a vertex are kept.
  VirtualGrid(std::span<const glm::vec3> vertices, float share);

  /// Where reflection points must be searched for, in the vertices' frame.
  const std::vector<glm::vec3>& corners() const { return corners_; }
  const GridLayout& layout() const { return layout_; }
  /// The number of each corner of the layout's box, in its order, among `corners()`; or `no_corner`.
  const std::vector<std::uint32_t>& numbers_in_box() const { return numbers_; }

  /// Trilinear, out of `corners()` as they are shown, of the vertices that the grid was made for. A vertex is
  /// lost with any corner of its cell.
  void interpolate(std::span<const glm::vec3> vertices, std::span<const VirtualPoint> corners,
                   std::span<VirtualPoint> shown) const;

 private:
  GridLayout layout_;
  std::vector<glm::vec3> corners_;
  std::vector<std::uint32_t> numbers_;
};

/// The shares of the paper's figure 7, from fine to coarse.
inline constexpr std::array grid_shares{0.143f, 0.096f, 0.055f, 0.041f};

/// Which of a mesh's grids, given by how many corners each has, from fine to coarse, serves an image of about
/// so many pixels: the coarsest that has a corner for each square of 8 pixels, else the finest. None where
/// the mesh itself has too few vertices for that: then all of them are searched for.
std::optional<std::size_t> grid_level(std::span<const std::uint32_t> corner_counts, std::size_t vertex_count,
                                      float area_px);

}  // namespace parvis::virtual_objects
