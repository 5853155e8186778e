// A captured tree as it is displayed: a billboard per cell with a texture per photograph
// (003_d5b01da2d2f805f6, sections 4.5.3 and 4.6).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "capture/trees/billboard_math.h"
#include "capture/trees/tree_volume.h"
#include "capture/trees/trunk_shape.h"

namespace parvis::trees {

/// Textures of one photograph.
struct BillboardTextures {
  Pinhole camera;
  std::vector<std::int32_t>
      texture_of_cell;  ///< -1: the photograph does not see the cell; its base colour stands in
  std::vector<std::uint8_t>
      texels;  ///< RGBA, sRGB, straight alpha; texels_per_side^2 per texture, top row first

  /// How many textures there are, of `texels_per_side`.
  std::size_t count(int texels_per_side) const {
    return texels.size() / (4 * std::size_t(texels_per_side) * std::size_t(texels_per_side));
  }
};

/// The light of the photographs: tree_light.h.
struct CapturedLight {
  glm::vec3 to_sun{0.0f, 0.0f, 1.0f};  ///< unit
  float sun = 0.0f, sky = 1.0f;  ///< linear brightness of a leaf that sees all of the sun, or of the sky
};

/// Cells with their billboards. Cells that are empty are not kept.
struct BillboardTree {
  CellGrid grid;
  std::vector<glm::u8vec4> base;  ///< per cell: colour (sRGB) and opacity along its mean chord
  int texels_per_side = 4;        ///< M of the thesis
  CapturedLight light;
  std::vector<BillboardTextures> views;
  std::optional<TrunkShape> trunk = std::nullopt;  ///< as geometry: the cells leave it out
};

/// A billboard in a picture: where its pixels lie on it.
struct PlacedBillboard {
  std::uint32_t cell;
  glm::vec2 middle;  ///< pixels
  glm::mat2
      metres_from_pixels;  ///< right and upward; affine, which a billboard far smaller than its distance is
  glm::vec2 half_size_m;
  glm::vec4 slants;      ///< of the cell's silhouette, as display::silhouette_slants
  glm::ivec2 low, high;  ///< pixels that it may cover, high excluded
};

/// The billboards that a camera sees, in the order of visibility of the cells: exact, from every place
/// outside of the grid.
std::vector<PlacedBillboard> placed_billboards(const CellGrid& grid, const Pinhole& camera,
                                               bool back_to_front);

/// A billboard in the tree's frame, for an eye there.
struct BillboardFrame {
  glm::vec3 to_eye, right, up;  ///< unit; to the eye from the cell's middle
  glm::vec2 half_size_m;
  glm::vec4 slants;
};
/// The billboard of a cell, turned to the eye. All in the tree's frame.
BillboardFrame billboard_frame(glm::vec3 centre, glm::vec3 cell_size_m, glm::vec3 eye);

/// A texture's colour at a point of its billboard (-1..1), premultiplied, in the linear light that scenes are
/// drawn in: texels are decoded before they are interpolated. Of a cell that the photograph does not see, the
/// cell's own.
glm::vec4 texture_colour(const BillboardTree& tree, const BillboardTextures& view, std::size_t cell,
                         glm::vec2 place);

/// One or two photographs and their weights, which add up to 1.
struct ClosestViews {
  std::array<int, 2> views{0, 0};
  std::array<float, 2> weights{1.0f, 0.0f};
};
/// The two photographs whose directions from a point of the tree are closest to the eye's, `to_eye` (unit).
/// With a cell: of those photographs that see it; of all where none does.
ClosestViews closest_views(const BillboardTree& tree, glm::vec3 point, glm::vec3 to_eye, int cell = no_cell);

/// The picture from a camera: RGBA, premultiplied, linear light. Billboards from back to front, the textures
/// of the two closest photographs, over.
ImageF render_billboards(const BillboardTree& tree, const Pinhole& camera);

/// Calls visit(x, y, place) for the pixels that show the billboard's cell, within rows [row0, row1); `place`
/// on the billboard, -1..1 to the right and upward.
template <class Visit>
void visit_pixels(const PlacedBillboard& b, int row0, int row1, Visit&& visit) {
  for (int y = std::max(b.low.y, row0); y < std::min(b.high.y, row1); ++y)
    for (int x = b.low.x; x < b.high.x; ++x) {
      const glm::vec2 place =
          b.metres_from_pixels * (glm::vec2(float(x) + 0.5f, float(y) + 0.5f) - b.middle) / b.half_size_m;
      if (display::silhouette_reach(place, b.slants) <= 1.0f) visit(x, y, place);
    }
}

/// The four texels round a point of a texture, by bilinear interpolation, clamped at the edges.
struct Footprint {
  std::array<int, 4> texel;
  std::array<float, 4> weight;

  Footprint(glm::vec2 uv, int side) {
    const glm::vec2 at = glm::clamp(uv * float(side) - 0.5f, glm::vec2(0.0f), glm::vec2(float(side - 1)));
    const glm::ivec2 low = glm::min(glm::ivec2(at), glm::ivec2(std::max(side - 2, 0)));
    const glm::vec2 f = at - glm::vec2(low);
    const int right = side > 1 ? 1 : 0, down = side > 1 ? side : 0, first = low.y * side + low.x;
    texel = {first, first + right, first + down, first + down + right};
    weight = {(1.0f - f.x) * (1.0f - f.y), f.x * (1.0f - f.y), (1.0f - f.x) * f.y, f.x * f.y};
  }
};

}  // namespace parvis::trees
