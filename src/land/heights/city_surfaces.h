// What the surfaces of city models are made of: their names in CityJSON, and the colours of look and light.
#pragma once

#include <string>

#include "scene/data/model.h"

namespace parvis::scene {

/// The name that a surface's material gets: its own semantics ("RoofSurface"), its object's type ("Road"; of
/// bridges and tunnels also for their walls and roofs, of roads for traffic areas), or for buildings
/// (extensions' too) without semantics the one that its slope suggests. `up` is the z of its unit normal.
std::string surface_name(const std::string& semantics, const std::string& object_type, float up);

/// Is an object of this CityJSON type a building, or a part or an extension of one?
bool is_building(const std::string& object_type);

/// The plain material of a name.
Material surface_material(const std::string& name);

/// True if parts of this name ("LandUse", "Road footpath") are ground, which faces up, whichever way its file
/// winds it.
bool is_ground(const std::string& name);

/// True for parts of cellars and foundations, whose names end in " below ground": no ground rests on their
/// feet.
bool is_below_ground(const std::string& name);

/// True for names that surfaces of city models have ("WallSurface", "Road footpath"): a model with such parts
/// says itself what is ground.
bool is_city_surface(const std::string& name);

}  // namespace parvis::scene
