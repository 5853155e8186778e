#include "formats/city_models/osm_reader.h"

#include <cmath>
#include <unordered_map>

#include "formats/city_models/city_assembly.h"
#include "formats/city_models/osm_buildings.h"
#include "formats/city_models/osm_earthworks.h"
#include "formats/city_models/osm_file.h"
#include "formats/city_models/osm_land.h"
#include "formats/city_models/osm_roads.h"
#include "formats/city_models/osm_things.h"
#include "formats/city_models/osm_trenches.h"
#include "formats/city_models/osm_woods.h"
#include "formats/terrain/utm.h"

namespace parvis::scene {
namespace {

constexpr double largest_m = 100'000.0;  // no city is so wide, and floats end at centimetres there

/// OpenStreetMap knows no heights of the ground: it is level, over the file's bounds.
void add_ground(const OsmFile& osm, const Utm& utm, const glm::dvec3& origin, const OsmTrenches& trenches,
                CityAssembly& city) {
  std::vector<std::vector<glm::dvec3>> rings;
  std::vector<glm::dvec3>& ring = rings.emplace_back();
  for (const glm::dvec2 corner : {osm.min_deg, glm::dvec2(osm.max_deg.x, osm.min_deg.y), osm.max_deg,
                                  glm::dvec2(osm.min_deg.x, osm.max_deg.y)})
    ring.emplace_back(utm(corner), origin.z);
  trenches.add_level(rings, {{"ground", "LandUse", ""}}, city);
}

/// The error for a file of which nothing is drawn.
Error nothing_to_show(const OsmFile& osm, const FileLocation& where, bool has_ground,
                      const Errors& warnings) {
  return error_at(
      where,
      "nothing of this OpenStreetMap file can be shown: its {} nodes and {} ways make no building, "
      "land, tree, wall, rail or bridge{}{}; export an area in which there is something "
      "(openstreetmap.org, Export)",
      osm.nodes.size(), osm.ways.size(), has_ground ? "" : ", and its bounds enclose no ground",
      warnings.empty() ? "" : fmt::format(" ({})", warnings.front().message));
}

}  // namespace

Result<Model> model_of_osm(const OsmFile& osm, const std::filesystem::path& file, Errors& warnings,
                           const GroundOnMap& ground, std::optional<glm::dvec2>* place_deg) {
  const FileLocation where{file.string(), 0, 0};
  const glm::dvec2 middle_deg = (osm.min_deg + osm.max_deg) / 2.0;
  const Utm utm(middle_deg);
  const glm::dvec2 size_m = utm(osm.max_deg) - utm(osm.min_deg);
  if (!(glm::length(size_m) < largest_m))
    return error_at(where,
                    "its bounds are wider than {:.0f} km; cut out the part that you need (osmium extract)",
                    largest_m / 1000.0);
  if (place_deg) *place_deg = middle_deg;
  const glm::dvec3 origin(glm::floor(utm(middle_deg)), 0.0);
  std::unordered_map<OsmId, glm::dvec2> places;  // projected once: ways are walked many times
  places.reserve(osm.nodes.size());
  for (const auto& [node, deg] : osm.nodes)
    if (const glm::dvec2 spot = utm(deg); glm::distance(spot, glm::dvec2(origin)) < largest_m)
      places.emplace(node, spot);
  const auto on_map = [&](OsmId node) -> std::optional<glm::dvec2> {
    const auto found = places.find(node);
    return found == places.end() ? std::nullopt : std::optional(found->second);
  };
  CityAssembly city(file, origin, warnings);
  const OsmPlaces place = on_map;
  const OsmRelief relief(osm, place, !ground);
  const OsmTrenches trenches(osm, relief);
  std::vector<Road> roads = osm_roads(osm, place, relief, ground, origin, file, city);
  const GroundOnMap shaped = ground_shaped_for(roads, ground, origin);
  const std::size_t buildings = add_osm_buildings(osm, on_map, shaped, city);
  if (!ground) {
    add_ground(osm, utm, origin, trenches, city);
    add_osm_land(osm, place, origin.z, trenches, city);
    add_osm_tunnels(osm, relief, city);
    add_osm_crossings(osm, place, roads, origin, city);
  }
  add_osm_plants_and_barriers(osm, place, shaped, trenches, city);
  add_osm_woods(osm, place, shaped, trenches, city);
  add_osm_rails(osm, relief, ground, shaped, city);
  add_osm_bridges(osm, relief, ground, half_carriageway_m, city);
  if (city.polygon_count() == 0) return nothing_to_show(osm, where, bool(ground), warnings);
  Result<Model> model = city.finish(buildings);
  if (model) model->roads = std::move(roads);
  return model;
}

Result<Model> read_osm(const std::filesystem::path& file, Errors& warnings, const GroundOnMap& ground,
                       std::optional<glm::dvec2>* place_deg) {
  const Result<OsmFile> osm = read_osm_file(file, warnings);
  if (!osm) return osm.errors();
  return model_of_osm(*osm, file, warnings, ground, place_deg);
}

}  // namespace parvis::scene
