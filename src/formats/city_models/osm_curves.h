// Curves of OpenStreetMap, which maps draw as facets: round walls, domes, onions, cones, barrel roofs.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "formats/city_models/osm_roofs.h"

namespace parvis::scene {

/// A flat piece of a curved surface: its corners, counter-clockwise seen from outside.
using OsmFacet = std::vector<glm::dvec3>;

/// True where the faces of a roof stand for a curved surface: domes, onions and barrels, and cones, which are
/// pyramids on an outline of 12 corners or more.
bool is_curved(const OsmRoof& roof);

/// True for a wall that may be a facet of a round one: it is up to 6 m wide.
bool is_curved(glm::dvec2 from, glm::dvec2 to);

/// Unit normals of the corners of facets, facet by facet. Where facets meet that turn by 30 degrees or less,
/// it is their mean by area: the normal of the curved surface. Sharper edges stay sharp.
std::vector<std::vector<glm::vec3>> curved_normals(const std::vector<OsmFacet>& facets);

}  // namespace parvis::scene
