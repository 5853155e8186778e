// Leaves as meshes: an outline along the midrib, folded at it and bent down, or a handful of needles; and a
// coarse one of the same area.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace parvis::vegetation {

/// Outline of a leaf.
enum class LeafForm : std::uint8_t {
  ellipse,  ///< orange, privet
  lobed,    ///< oak
  palmate,  ///< plane
  blade,    ///< grass
  shoot,    ///< spruce, fir: needles to both sides of a twig's end
  tuft      ///< pine: long needles from one point
};
inline constexpr int leaf_form_count = 6;

/// True for the needles of conifers, which one leaf holds many of.
inline bool is_needles(LeafForm form) { return form == LeafForm::shoot || form == LeafForm::tuft; }

/// A leaf's mesh in its own frame, in leaf lengths: x across, y from its foot to its tip, z up.
struct LeafTemplate {
  std::vector<glm::vec3> points;
  std::vector<glm::vec3> normals;      ///< unit, one per point
  std::vector<std::uint16_t> indices;  ///< triangles, counter-clockwise seen from above

  /// Number of triangles of the mesh.
  std::size_t triangle_count() const { return indices.size() / 3; }
  /// Area of one side, in squared leaf lengths.
  float area() const;
};

/// The leaf as it is seen from near.
const LeafTemplate& full_leaf(LeafForm form);
/// Two triangles of the same area, for leaves of a few pixels.
const LeafTemplate& simple_leaf(LeafForm form);

}  // namespace parvis::vegetation
