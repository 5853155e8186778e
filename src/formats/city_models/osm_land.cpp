#include "formats/city_models/osm_land.h"

#include <algorithm>
#include <array>

#include "formats/city_models/osm_measures.h"
#include "formats/city_models/osm_relief.h"
#include "formats/city_models/osm_shapes.h"

namespace parvis::scene {
namespace {

using glm::dvec3;

/// The cover of areas with a tag, and how high it lies among others.
struct Cover {
  const char *key, *value;  ///< "*": any
  const char *type, *use;
  double lift_m;
};
constexpr std::array<Cover, 35> covers{{
    {"natural", "water", "WaterBody", "", 0.020},
    {"water", "*", "WaterBody", "", 0.020},
    {"waterway", "riverbank", "WaterBody", "", 0.020},
    {"waterway", "dock", "WaterBody", "", 0.020},
    {"landuse", "basin", "WaterBody", "", 0.020},
    {"landuse", "reservoir", "WaterBody", "", 0.020},
    {"leisure", "swimming_pool", "WaterBody", "", 0.022},
    {"amenity", "parking", "Road", "parking", 0.016},
    {"place", "square", "TransportSquare", "", 0.014},
    {"highway", "pedestrian", "TransportSquare", "", 0.015},
    {"highway", "footway", "TransportSquare", "", 0.015},
    {"highway", "service", "TransportSquare", "", 0.015},
    {"leisure", "playground", "TransportSquare", "", 0.013},
    {"leisure", "pitch", "PlantCover", "", 0.012},
    {"natural", "wood", "PlantCover", "", 0.010},
    {"natural", "scrub", "PlantCover", "", 0.010},
    {"natural", "grassland", "PlantCover", "", 0.010},
    {"natural", "heath", "PlantCover", "", 0.010},
    {"leisure", "park", "PlantCover", "", 0.008},
    {"leisure", "garden", "PlantCover", "", 0.009},
    {"leisure", "golf_course", "PlantCover", "", 0.008},
    {"landuse", "grass", "PlantCover", "", 0.009},
    {"landuse", "meadow", "PlantCover", "", 0.006},
    {"landuse", "village_green", "PlantCover", "", 0.008},
    {"landuse", "recreation_ground", "PlantCover", "", 0.006},
    {"landuse", "forest", "PlantCover", "", 0.006},
    {"landuse", "cemetery", "PlantCover", "", 0.006},
    {"landuse", "allotments", "PlantCover", "", 0.006},
    {"landuse", "orchard", "PlantCover", "", 0.006},
    {"landuse", "vineyard", "PlantCover", "", 0.006},
    {"landuse", "farmland", "PlantCover", "", 0.004},
    {"landuse", "flowerbed", "PlantCover", "", 0.012},
    {"landuse", "greenfield", "PlantCover", "", 0.004},
    {"landuse", "village", "PlantCover", "", 0.002},
    {"landcover", "grass", "PlantCover", "", 0.009},
}};

/// The cover and width of ways with a tag that are no areas.
struct Ribbon {
  const char *key, *value, *type, *use;
  double width_m, lift_m;
};
constexpr std::array<Ribbon, 9> ribbons{{{"waterway", "river", "WaterBody", "", 14.0, 0.019},
                                         {"waterway", "canal", "WaterBody", "", 9.0, 0.019},
                                         {"waterway", "stream", "WaterBody", "", 2.0, 0.019},
                                         {"highway", "footway", "Road", "footway", 2.0, 0.024},
                                         {"highway", "path", "Road", "footway", 1.6, 0.023},
                                         {"highway", "cycleway", "Road", "cycleway", 2.2, 0.025},
                                         {"highway", "pedestrian", "Road", "pedestrian", 5.0, 0.026},
                                         {"highway", "steps", "Road", "footway", 2.0, 0.024},
                                         {"highway", "track", "Road", "track", 2.6, 0.022}}};

bool has(const OsmTags& tags, const char* key, std::string_view value) {
  const std::string& given = tag(tags, key);
  return value == "*" ? !given.empty() && given != "no" : given == value;
}

const Cover* cover_of(const OsmTags& tags) {
  if (is_underground(tags) || is_bridge(tags) || says_yes(tags, "building")) return nullptr;
  if (has(tags, "parking", "underground") || has(tags, "parking", "multi-storey")) return nullptr;
  const bool is_way =
      says_yes(tags, "highway") && tag(tags, "area") != "yes" && tag(tags, "type") != "multipolygon";
  const auto found = std::ranges::find_if(covers, [&](const Cover& cover) {
    return has(tags, cover.key, cover.value) && !(is_way && std::string_view(cover.key) == "highway");
  });
  return found == covers.end() ? nullptr : &*found;
}

/// Pavements and crossings belong to the carriageway that they lie along or across.
const Ribbon* ribbon_of(const OsmTags& tags) {
  if (is_underground(tags) || tag(tags, "area") == "yes") return nullptr;
  for (const char* use : {"sidewalk", "crossing"})
    if (has(tags, "footway", use) || has(tags, "cycleway", use)) return nullptr;
  const auto found = std::ranges::find_if(
      ribbons, [&](const Ribbon& ribbon) { return has(tags, ribbon.key, ribbon.value); });
  return found == ribbons.end() ? nullptr : &*found;
}

double width_m(const OsmTags& tags, double usual_m) {
  return metres_within(tags, "width", 0.3, 200.0, usual_m);
}

}  // namespace

bool is_on_ground(const OsmTags& tags) { return cover_of(tags) || ribbon_of(tags); }

double half_path_m(const OsmTags& tags) {
  const Ribbon* ribbon = ribbon_of(tags);
  if (!ribbon || std::string_view(ribbon->key) != "highway") return 0.0;
  return 0.5 * width_m(tags, ribbon->width_m);
}

void add_osm_land(const OsmFile& osm, const OsmPlaces& place, double ground_m, const OsmTrenches& trenches,
                  CityAssembly& city) {
  const OsmAreas areas(osm, place, city);
  for (const OsmArea& area : areas.find([](const OsmTags& tags) { return cover_of(tags) != nullptr; }, "")) {
    const Cover& cover = *cover_of(*area.tags);
    std::vector<std::vector<dvec3>> rings;
    for (const OsmRing& ring : area.rings) {
      rings.emplace_back();
      for (const glm::dvec2& point : ring) rings.back().emplace_back(point, ground_m + cover.lift_m);
    }
    trenches.add_level(rings, {{cover.type, cover.type, cover.use}}, city);
  }
  for (const OsmWay& way : osm.ways) {
    const Ribbon* ribbon = ribbon_of(way.tags);
    if (!ribbon || is_bridge(way.tags) || (way.is_closed() && cover_of(way.tags))) continue;
    std::vector<dvec3> line;
    for (const OsmId node : way.nodes)
      if (const auto point = place(node)) line.emplace_back(*point, ground_m);
    const double half_m = 0.5 * width_m(way.tags, ribbon->width_m);
    const Sides sides = sides_of(line, -half_m, half_m, ribbon->lift_m);
    for (std::size_t i = 0; i + 1 < sides.left.size(); ++i)
      trenches.add_level({{sides.right[i], sides.right[i + 1], sides.left[i + 1], sides.left[i]}},
                         {{ribbon->type, ribbon->type, ribbon->use}}, city);
  }
}

}  // namespace parvis::scene
