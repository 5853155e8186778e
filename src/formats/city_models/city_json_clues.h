// What the coordinates of a CityJSON file are like, by the vertices and the roofs of its objects.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "formats/city_models/city_coordinates.h"
#include "formats/city_models/city_json_values.h"

namespace parvis::scene {

/// True for each vertex that a boundary of an object names: files that were cut out of larger ones keep
/// vertices of what they left out. An index out of range is left to the reader, which refuses it.
std::vector<bool> named_vertices(const Json& city, std::size_t vertex_count);

/// Clues from those of the file's `vertices` that are named, as they stand in it. Roofs are the surfaces that
/// the file calls so; of a solid of a building without such surfaces, whose rings run about its outward
/// normals, those that lie above half its height.
CoordinateClues coordinate_clues(const Json& city, const std::vector<glm::dvec3>& vertices,
                                 const std::vector<bool>& is_named);

}  // namespace parvis::scene
