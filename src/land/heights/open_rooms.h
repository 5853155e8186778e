// Terrain that would rise through the floors of rooms.
#pragma once

#include "scene/data/scene.h"

namespace parvis::scene {

/// Leaves the land (TINRelief, LandUse) out over the floors of rooms: where it lies on a floor (FloorSurface:
/// an inside of CityGML or CityJSON; a cellar's IfcSlab) or up to 3 m above it, in the rooms of the ground
/// floor and of cellars. Land deep above a floor, over an underground hall, stays, and so does land above the
/// ceiling of its room (CeilingSurface): a courtyard over a garage. Objects whose land changes get changed
/// copies of their models. Dynamic and hidden objects, and the land around the place, do not count.
void open_rooms(Scene& scene);

}  // namespace parvis::scene
