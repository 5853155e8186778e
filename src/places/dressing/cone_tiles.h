// Tiles that go round a conical roof.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "places/dressing/cone_sides.h"

namespace parvis::dressing {

/// A piece of a cone's side, with what its corners need to be drawn.
struct TiledPiece {
  ModelTriangle triangle;
  std::array<glm::vec2, 3> uvs;      ///< in the sheet of synthesis::roof_tile_pictures
  std::array<glm::vec3, 3> normals;  ///< unit, in the model's frame
};

/// The side in pieces, one above the other. Courses are level and count from the cone's top; tiles count by
/// the direction from it, so that they go on from side to side. Where the cone is half as wide, a course has
/// half as many. One edge of the cone, to the west, has other stains to its left than to its right.
std::vector<TiledPiece> cone_tiles(const ModelTriangle& side, const ConeSide& cone);

}  // namespace parvis::dressing
