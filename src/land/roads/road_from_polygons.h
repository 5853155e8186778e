// Roads from the surfaces that city models draw them as: the middle lines of what vehicles may use.
#pragma once

#include <span>
#include <vector>

#include "land/roads/road_builder.h"
#include "land/roads/road_polygon.h"

namespace parvis::scene {

/// Centre lines, with widths and heights, of the drivable ones among `polygons` (footpaths, cycle paths,
/// steps, parking spaces, railways are not): their union is drawn as cells of half a metre, thinned to a
/// graph and smoothed. Roads meet exactly at junctions, so that build_road_graph joins them. What is too
/// narrow for a car is left out, what is too narrow for two becomes one-way where that cuts nothing off, and
/// so are pieces that end after a few metres and dead ends in which no car could turn (unless there is
/// nothing else). Nothing drivable gives no roads.
std::vector<Road> roads_from_polygons(std::span<const RoadPolygon> polygons);

/// Whether vehicles use a road surface with this description ("rijbaan lokale weg", "voetpad", ...).
bool is_drivable(const std::string& function);

}  // namespace parvis::scene
