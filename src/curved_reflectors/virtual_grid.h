// Virtual grids (Estalella and others 2005, section 5): reflection points are searched for the corners of a
// grid about a mesh alone, and the mesh's virtual vertices interpolated between those. The search costs what
// the grid has corners, and smooth interpolation does not flicker.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace parvis::curved_reflectors {

/// A corner or a vertex where a reflector shows it; what is lost is not drawn.
struct VirtualPoint {
  glm::vec3 position{0.0f};
  bool is_lost = false;
};

class VirtualGrid {
 public:
  /// A grid with at most `share` (0..1) as many corners as there are vertices, at least one cell: its cells
  /// are as near to cubes as the vertices' box lets them be, and only those that hold a vertex are kept.
  VirtualGrid(std::span<const glm::vec3> vertices, float share);

  /// Where reflection points must be searched for, in the vertices' frame.
  const std::vector<glm::vec3>& corners() const { return corners_; }
  std::size_t cell_count() const { return cells_.size(); }

  /// Trilinear, out of `corners()` as they are shown. A vertex is lost with any corner of its cell.
  void interpolate(std::span<const VirtualPoint> corners, std::span<VirtualPoint> vertices) const;

 private:
  struct Place {
    std::uint32_t cell;
    glm::vec3 share;  ///< u, v, w within it
  };
  std::vector<glm::vec3> corners_;
  std::vector<std::array<std::uint32_t, 8>> cells_;  ///< their corners; x changes fastest
  std::vector<Place> places_;                        ///< of each vertex
};

/// Grids of one mesh from fine to coarse, of which a picture takes one by the area of the reflection.
class VirtualGridLevels {
 public:
  explicit VirtualGridLevels(std::span<const glm::vec3> vertices);

  /// The shares of the paper's figure 7.
  static constexpr std::array shares{0.143f, 0.096f, 0.055f, 0.041f};

  /// For a mesh whose virtual image covers about so many pixels: the coarsest grid that has a corner for each
  /// square of 8 pixels, or null where the mesh itself has fewer vertices than that.
  const VirtualGrid* grid_for(float area_px) const;

 private:
  std::size_t vertex_count_;
  std::vector<VirtualGrid> grids_;
};

}  // namespace parvis::curved_reflectors
