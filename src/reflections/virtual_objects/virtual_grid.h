// Virtual grids (Estalella and others 2005, section 5): reflection points are searched only for the corners
// of a grid around a mesh; the mesh's virtual vertices are interpolated between them. The cost depends on the
// number of corners, and smooth interpolation does not flicker.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "reflections/virtual_objects/grid_cells.h"

namespace parvis::virtual_objects {

/// Virtual position of a corner or vertex; lost ones are not drawn.
struct VirtualPoint {
  glm::vec3 position{0.0f};
  bool is_lost = false;
};

/// A regular grid over the bounding box of a mesh.
struct GridLayout {
  glm::vec3 origin{0.0f}, cell{1.0f};  ///< cell: lengths of its edges
  glm::ivec3 count{1};                 ///< number of cells

  /// Position in cells from the origin.
  glm::vec3 place_of(glm::vec3 vertex) const { return position_in_cells(vertex, origin, 1.0f / cell); }
  /// The cell that contains a vertex.
  glm::ivec3 cell_of(glm::vec3 vertex) const { return cell_around(place_of(vertex), count); }
  /// Number of corners of the whole box, used or not.
  std::size_t box_size() const {
    return std::size_t(count.x + 1) * std::size_t(count.y + 1) * std::size_t(count.z + 1);
  }
  /// Index of a corner in the box; x changes fastest.
  std::size_t place_in_box(glm::ivec3 corner) const { return std::size_t(index_in_box(corner, count)); }
};

/// A sparse grid: the corners of those cells that contain a vertex.
class VirtualGrid {
 public:
  static constexpr std::uint32_t no_corner = 0xffffffff;

  /// Creates a grid with at most `share` (0..1) as many corners as there are vertices, at least one cell,
  /// with cells as close to cubes as the bounding box allows.
  VirtualGrid(std::span<const glm::vec3> vertices, float share);

  /// Corners for which reflection points are searched, in the vertices' frame.
  const std::vector<glm::vec3>& corners() const { return corners_; }
  const GridLayout& layout() const { return layout_; }  ///< of the whole box
  /// Index in `corners()` of each corner of the layout's box, or `no_corner`.
  const std::vector<std::uint32_t>& numbers_in_box() const { return numbers_; }

  /// Trilinear interpolation from virtual corners to the vertices for which the grid was made. A vertex is
  /// lost if any corner of its cell is.
  void interpolate(std::span<const glm::vec3> vertices, std::span<const VirtualPoint> corners,
                   std::span<VirtualPoint> shown) const;

 private:
  GridLayout layout_;
  std::vector<glm::vec3> corners_;
  std::vector<std::uint32_t> numbers_;
};

/// Shares of the paper's figure 7, from fine to coarse.
inline constexpr std::array grid_shares{0.143f, 0.096f, 0.055f, 0.041f};

/// Chooses one of a mesh's grids (`corner_counts`, from fine to coarse) for an image of about `area_px`
/// pixels: the coarsest with one corner per square of 8 pixels, else the finest. Empty if the mesh itself has
/// too few vertices for that: then every vertex is searched for.
std::optional<std::size_t> grid_level(std::span<const std::uint32_t> corner_counts, std::size_t vertex_count,
                                      float area_px);

}  // namespace parvis::virtual_objects
