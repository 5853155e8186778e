// Where roads lie on terrain, which is shaped for them, and where on something else.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "land/roads/earthworks.h"
#include "scene/data/scene.h"

namespace parvis::scene {

/// Terrain is the ground that is cut and filled: parts called TINRelief. Surfaces that are surveyed or drawn
/// as roads, squares or land use have their shape already.
enum class Terrain : std::uint8_t {
  surveyed,  ///< of a GeoTIFF or of a city model's relief
  generated  ///< by terrain_plane: it goes on below surveyed ground, and must stay there
};

/// Half the width of a road's bed: its carriageway, pavements and a shoulder of a metre.
float half_bed_m(const Road& road);

/// The turns to the right through crossings, each as a road of one lane. Their pavements go round the corners
/// between two roads, outside of both beds where these meet at a slant; other ways through stay inside.
std::vector<Road> right_turns(const RoadGraph& graph);

/// The terrain that parts of this name belong to; nothing for other names.
std::optional<Terrain> terrain_of(const std::string& object);

/// True for static, visible objects of the place itself: the land around it carries no roads.
bool has_ground(const Scene& scene, const Object& object);

/// The beds of `roads`, which are in the world, in the terrain of one kind: at every ten metres or nearer as
/// high as the terrain at the road's middle, where that is the highest ground within 2.5 m of the road's own
/// height. Where other ground, a bridge or its ramp lies higher, the bed only cuts; so it does through
/// generated terrain where a road runs deep below it in an open trench. Elsewhere roads have no bed.
std::vector<RoadBed> road_beds(const Scene& scene, std::span<const Road> roads, Terrain terrain);

}  // namespace parvis::scene
