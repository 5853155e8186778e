// Polygons with holes, in space, to triangles.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace parvis::scene {

/// The area vector of a closed ring (Newell): its direction is the normal, its length twice the area.
glm::dvec3 newell_normal(const std::vector<glm::dvec3>& ring);

/// Which points belong to a polygon: those that its rings wind around an odd number of times, whatever their
/// directions; those that they wind around counter-clockwise more often than clockwise, so that rings that
/// run clockwise are cut out, also where they cross others; or those that they wind around twice or more
/// often: what two polygons have in common.
enum class Inside : std::uint8_t { odd, positive, twice };

/// Triangles of a nearly flat polygon: the outer ring, counter-clockwise about `normal`, then its holes (any
/// direction where `inside` is odd). Corner indices run through all rings' points in order. Where rings
/// cross, points are added to the end of `points`.
std::vector<std::uint32_t> triangulated(const std::vector<std::vector<glm::dvec3>>& rings, glm::dvec3 normal,
                                        std::vector<glm::dvec3>& points, Inside inside = Inside::odd);

/// The outlines of what is inside of flat rings: outer ones counter-clockwise about `normal`, those of holes
/// clockwise. None crosses another or itself. Corners of the rings that remain keep their coordinates.
std::vector<std::vector<glm::dvec3>> outlines(const std::vector<std::vector<glm::dvec3>>& rings,
                                              glm::dvec3 normal, Inside inside);

}  // namespace parvis::scene
