#include "formats/city_models/osm_reader.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
#include <set>
#include <string_view>
#include <utility>

#include "formats/city_models/city_assembly.h"
#include "formats/city_models/osm_buildings.h"
#include "formats/city_models/osm_earthworks.h"
#include "formats/city_models/osm_file.h"
#include "formats/city_models/osm_land.h"
#include "formats/city_models/osm_measures.h"
#include "formats/city_models/osm_roads.h"
#include "formats/city_models/osm_things.h"
#include "formats/city_models/osm_trenches.h"
#include "formats/city_models/osm_woods.h"

namespace parvis::scene {
namespace {

constexpr double max_city_m = 100'000.0;  // no city is so wide, and floats end at centimetres there

/// OpenStreetMap knows no heights of the ground: it is level, over the file's bounds.
void add_ground(const OsmFile& osm, const glm::dvec3& origin, const OsmTrenches& trenches,
                CityAssembly& city) {
  std::vector<std::vector<glm::dvec3>> rings;
  std::vector<glm::dvec3>& ring = rings.emplace_back();
  for (const glm::dvec2& corner : osm.corners) ring.emplace_back(corner, origin.z);
  trenches.add_level(rings, {{"ground", "LandUse", ""}}, city);
}

/// Whether something is drawn of an element with these tags; `is_alone`: it stands on level ground.
bool is_drawn(const OsmTags& tags, bool is_alone) {
  const auto is = [&](const char* key, std::initializer_list<std::string_view> values) {
    return std::ranges::find(values, std::string_view(tag(tags, key))) != values.end();
  };
  if (says_yes(tags, "building") || says_yes(tags, "building:part") || is_street(tags) || is_bridge(tags))
    return true;
  if (is_alone && (is_on_ground(tags) || is("highway", {"crossing"}))) return true;
  // Nodes of the model: lights and poles are set up there.
  if (is("highway", {"traffic_signals", "bus_stop"})) return true;
  return is("natural", {"tree", "tree_row", "wood"}) || is("landuse", {"forest"}) ||
         is("railway", {"tram", "rail", "light_rail", "narrow_gauge", "subway"}) ||
         is("barrier", {"hedge", "fence", "wall", "retaining_wall", "city_wall"});
}

/// The kind of an element, "amenity=bench"; empty where its tags say nothing of that.
std::string kind_of_element(const OsmTags& tags) {
  for (const char* key :
       {"building", "highway", "railway", "waterway", "barrier", "natural", "landuse", "leisure", "amenity",
        "man_made", "power", "tourism", "historic", "aeroway", "public_transport"})
    if (says_yes(tags, key)) return std::string(key) + "=" + tag(tags, key);
  return "";
}

void account_for(const OsmFile& osm, bool has_ground, FileAccount& account) {
  account_for_measures(osm, account);
  account.unneeded("elements", "an editor has deleted them", "", osm.deleted);
  std::map<std::string, std::size_t> not_drawn;
  std::size_t drawn = 0;
  const auto look = [&](const OsmTags& tags) {
    const std::string kind = kind_of_element(tags);
    if (kind.empty()) return;
    if (is_drawn(tags, !has_ground))
      ++drawn;
    else
      ++not_drawn[kind];
  };
  for (const OsmNode& node : osm.tagged_nodes) look(node.tags);
  for (const OsmWay& way : osm.ways) look(way.tags);
  for (const OsmRelation& relation : osm.relations) look(relation.tags);
  account.used("elements with a kind", drawn);
  std::vector<std::pair<std::size_t, std::string>> by_count;
  for (const auto& [kind, count] : not_drawn) by_count.emplace_back(count, fmt::format("{} {}", count, kind));
  std::ranges::sort(by_count, std::greater{});
  std::size_t total = 0;
  for (const auto& [count, name] : by_count) total += count;
  if (by_count.empty()) return;
  account.left_out("elements with a kind", "nothing is drawn of what they are", by_count.front().second,
                   total);
  for (std::size_t i = 1; i < by_count.size(); ++i) account.name_last(by_count[i].second);
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
                           const GroundOnMap& ground, std::optional<glm::dvec2>* place_deg,
                           FileAccount* account) {
  const FileLocation where{file.string(), 0, 0};
  const glm::dvec2 size_m = osm.corners[2] - osm.corners[0];
  if (!(glm::length(size_m) < max_city_m))
    return error_at(where,
                    "its bounds are wider than {:.0f} km; cut out the part that you need (osmium extract)",
                    max_city_m / 1000.0);
  if (place_deg) *place_deg = osm.middle_deg;
  if (account) account_for(osm, bool(ground), *account);
  const glm::dvec3 origin(glm::floor(osm.middle), 0.0);
  const auto on_map = [&](OsmId node) -> std::optional<glm::dvec2> {
    const auto found = osm.nodes.find(node);
    return found == osm.nodes.end() ? std::nullopt : std::optional(found->second);
  };
  CityAssembly city(file, origin, warnings);
  const OsmPlaces place = on_map;
  const OsmRelief relief(osm, place, !ground);
  const OsmTrenches trenches(osm, relief);
  std::vector<Road> roads = osm_roads(osm, place, relief, ground, origin, file, city);
  std::set<std::string> bridges;
  for (const OsmWay& way : osm.ways)
    if (is_bridge(way.tags)) bridges.insert(fmt::format("way {}", way.id));
  const std::shared_ptr<const Earthworks> ramps =
      ground ? nullptr
             : works_for_ramps(roads, [&](const Road& road) { return bridges.contains(road.name); });
  const GroundOnMap shaped = ground_shaped_for(roads, ground, origin);
  const GroundOnMap planted =
      ramps ? [ramps, origin](
                  glm::dvec2 spot) { return double(ramps->at(glm::vec2(spot - glm::dvec2(origin)), 0.0f)); }
            : shaped;
  const std::size_t buildings = add_osm_buildings(osm, on_map, shaped, city);
  if (!ground) {
    add_ground(osm, origin, trenches, city);
    add_osm_land(osm, place, origin.z, trenches, city);
    add_osm_tunnels(osm, relief, city);
    add_osm_crossings(osm, place, roads, origin, city);
  }
  const RaisedWays raised(osm, relief);
  add_osm_plants_and_barriers(osm, place, planted, trenches, raised, city);
  add_osm_woods(osm, place, planted, trenches, raised, city);
  add_osm_rails(osm, relief, ground, shaped, city);
  add_osm_bridges(osm, relief, ground, half_carriageway_m, city);
  if (city.polygon_count() == 0) return nothing_to_show(osm, where, bool(ground), warnings);
  Result<Model> model = city.finish(buildings);
  if (!model) return model;
  if (ramps) raise_ground(*model, *ramps);
  add_osm_signals_and_stops(osm, place, roads, origin, shaped, *model);
  model->roads = std::move(roads);
  model->map = osm.map;
  model->true_north_deg = osm.true_north_deg;
  return model;
}

Result<Model> read_osm(const std::filesystem::path& file, Errors& warnings, const GroundOnMap& ground,
                       std::optional<glm::dvec2>* place_deg, const std::string& map, FileAccount* account) {
  const Result<OsmFile> osm = read_osm_file(file, warnings, map);
  if (!osm) return osm.errors();
  return model_of_osm(*osm, file, warnings, ground, place_deg, account);
}

}  // namespace parvis::scene
