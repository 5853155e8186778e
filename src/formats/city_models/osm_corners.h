// Corners of outlines as people draw them: with points along their sides, repeated points and spikes.
#pragma once

#include "formats/city_models/osm_areas.h"

namespace parvis::scene {

/// The ring without points within 2 cm of the one before, without spikes, whose two sides lie on each other,
/// and without points along its sides. All points that are left out lie within 5 cm of the sides that remain,
/// but for the tips of spikes: arcs stay round. The ring as it is where fewer than three corners remain.
OsmRing corners_of(const OsmRing& ring);

}  // namespace parvis::scene
