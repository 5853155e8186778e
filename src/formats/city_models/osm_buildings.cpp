#include "formats/city_models/osm_buildings.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>

#include "formats/city_models/building_attributes.h"
#include "formats/city_models/osm_corners.h"
#include "formats/city_models/osm_relief.h"
#include "formats/city_models/osm_roofs.h"

namespace parvis::scene {
namespace {

using glm::dvec2, glm::dvec3;
using Ring = OsmRing;

constexpr double level_m = 3.0, usual_levels = 2.0;

/// Storeys of buildings without tags for their height.
struct UsualLevels {
  const char* kind;
  double levels;
};
constexpr std::array<UsualLevels, 15> usual_levels_of{{{"garage", 0.8},
                                                       {"garages", 0.8},
                                                       {"shed", 0.8},
                                                       {"hut", 0.8},
                                                       {"carport", 0.8},
                                                       {"kiosk", 1.0},
                                                       {"greenhouse", 1.0},
                                                       {"service", 1.0},
                                                       {"apartments", 4.0},
                                                       {"office", 4.0},
                                                       {"hotel", 4.0},
                                                       {"hospital", 4.0},
                                                       {"church", 4.0},
                                                       {"school", 3.0},
                                                       {"university", 4.0}}};

/// "12", "12.5 m", "40'" (feet), "12;15" (the first).
std::optional<double> metres(const std::string& text) {
  double value = 0.0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc() || !(std::abs(value) < 2000.0)) return std::nullopt;  // no building is as high
  constexpr double foot_m = 0.3048;
  return *end == '\'' ? value * foot_m : value;
}

/// "90", or a point of the compass ("E", "SSW").
std::optional<double> degrees(const std::string& text) {
  constexpr std::array<const char*, 16> points{"N", "NNE", "NE", "ENE", "E", "ESE", "SE", "SSE",
                                               "S", "SSW", "SW", "WSW", "W", "WNW", "NW", "NNW"};
  if (const auto point = std::ranges::find(points, text); point != points.end())
    return 22.5 * double(point - points.begin());
  double value = 0.0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  return problem == std::errc() && std::abs(value) <= 360.0 ? std::optional(value) : std::nullopt;
}

double metres_or(const OsmTags& tags, const char* height, const char* levels, double otherwise) {
  if (const auto given = metres(tag(tags, height))) return *given;
  if (const auto given = metres(tag(tags, levels))) return *given * level_m;
  return otherwise;
}

double usual_height_m(const OsmTags& tags) {
  const auto found = std::ranges::find(usual_levels_of, tag(tags, "building"),
                                       [](const UsualLevels& each) { return std::string(each.kind); });
  return level_m * (found == usual_levels_of.end() ? usual_levels : found->levels);
}

/// Buildings whose roofs are drawn flat though their tags say otherwise.
class FlatRoofs {
 public:
  void add(const std::string& building, std::string shape, const std::string& why) {
    constexpr std::size_t longest = 30;  // letters of a shape that nobody knows
    if (shape.size() > longest) shape.resize(longest);
    buildings_[why].push_back(fmt::format("{} ({})", building, shape));
  }
  /// One warning for each reason, with the first buildings' names.
  void warn(CityAssembly& city) const {
    constexpr std::size_t max_names = 5;
    for (const auto& [why, names] : buildings_) {
      std::string list = names.front();
      for (std::size_t i = 1; i < std::min(names.size(), max_names); ++i) list += ", " + names[i];
      if (names.size() > max_names) list += fmt::format(" and {} more", names.size() - max_names);
      city.warn(fmt::format("{}: drawn with a flat roof: {}", list, why));
    }
  }

 private:
  std::map<std::string, std::vector<std::string>> buildings_;  ///< by reason
};

/// Draws one building.
class Building {
 public:
  Building(const OsmArea& footprint, const CityObject& object, CityAssembly& city, FlatRoofs& flat)
      : rings_(footprint.rings), ground_m_(footprint.ground_m), object_(object), city_(city) {
    const OsmTags& tags = *footprint.tags;
    std::vector<Ring> corners;
    corners.reserve(rings_.size());
    for (const Ring& ring : rings_) corners.push_back(corners_of(ring));
    const OsmRoofTags roof_tags{tag(tags, "roof:shape"), tag(tags, "roof:orientation") == "across",
                                degrees(tag(tags, "roof:direction"))};
    std::string why_flat;
    roof_ = find_osm_roof(roof_tags, corners, why_flat);
    if (!why_flat.empty()) flat.add(footprint.name, roof_tags.shape, why_flat);
    if (roof_) rings_ = std::move(corners);  // walls end where the roof begins
    base_m_ = std::max(metres_or(tags, "min_height", "building:min_level", 0.0), 0.0);
    top_m_ = metres_or(tags, "height", "building:levels", base_m_ + usual_height_m(tags));
    if (top_m_ <= base_m_) top_m_ = base_m_ + level_m;
    const bool gives_top = !tag(tags, "height").empty();
    const double roof_m =
        std::max(roof_ ? metres_or(tags, "roof:height", "roof:levels", usual_osm_roof_m(*roof_)) : 0.0, 0.0);
    if (!gives_top) top_m_ += roof_m;  // levels do not count those in the roof
    eaves_m_ = std::max(top_m_ - roof_m, base_m_);
  }

  void draw() {
    for (const Ring& ring : rings_)
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const dvec2 a = ring[i], b = ring[(i + 1) % ring.size()];
        if (eaves_m_ > base_m_)
          add("WallSurface", {{{a, base_m_}, {b, base_m_}, {b, eaves_m_}, {a, eaves_m_}}});
      }
    if (base_m_ > 0.0) add("OuterCeilingSurface", level_surface(base_m_, true));
    draw_roof();
  }

 private:
  void draw_roof() {
    if (!roof_) return add("RoofSurface", level_surface(top_m_, false));
    for (OsmRoofFace& face : osm_roof_faces(*roof_, eaves_m_, top_m_))
      add(face.semantics, {std::move(face.points)});
  }

  std::vector<std::vector<dvec3>> level_surface(double height_m, bool faces_down) const {
    std::vector<std::vector<dvec3>> surface;
    for (const Ring& ring : rings_) {
      std::vector<dvec3>& points = surface.emplace_back();
      for (const dvec2& point : ring) points.emplace_back(point, height_m);
      if (faces_down) std::reverse(points.begin(), points.end());
    }
    return surface;
  }

  void add(const char* semantics, std::vector<std::vector<dvec3>> rings) {
    for (std::vector<dvec3>& ring : rings)
      for (dvec3& point : ring) point.z += ground_m_;
    CitySurface surface;
    surface.rings = std::move(rings);
    surface.semantics = semantics;
    surface.is_of_solid = true;
    city_.add(object_, surface);
  }

  std::vector<Ring> rings_;
  double ground_m_;
  const CityObject& object_;
  CityAssembly& city_;
  std::optional<OsmRoof> roof_;      ///< nothing: it is flat
  double base_m_, eaves_m_, top_m_;  ///< above the ground
};

double lowest_m(const Ring& ring, const GroundOnMap& ground) {
  if (!ground) return 0.0;
  double min_m = ground(ring.front());
  for (const dvec2& point : ring) min_m = std::min(min_m, ground(point));
  return min_m;
}

}  // namespace

std::size_t add_osm_buildings(const OsmFile& osm, const OsmPlaces& place, const GroundOnMap& ground,
                              CityAssembly& city) {
  const OsmAreas areas(osm, place, city);
  const auto has_key = [](const char* key) {
    return [key](const OsmTags& tags) { return says_yes(tags, key) && !is_underground(tags); };
  };
  std::vector<OsmArea> drawn = areas.find(has_key("building:part"), "a building");
  const std::size_t parts = drawn.size();
  std::vector<BuildingKind> kinds;  // of those that are drawn
  kinds.reserve(drawn.size());
  for (const OsmArea& part : drawn) kinds.push_back(kind_of_osm_building(*part.tags));
  for (OsmArea& part : drawn) part.ground_m = lowest_m(part.rings[0], ground);
  for (OsmArea& outline : areas.find(has_key("building"), "a building")) {
    outline.ground_m = lowest_m(outline.rings[0], ground);
    bool has_parts = false;
    for (std::size_t i = 0; i < parts; ++i) {
      if (drawn[i].tags == outline.tags || !holds(outline.rings[0], middle(drawn[i].rings[0]))) continue;
      has_parts = true;
      drawn[i].ground_m = outline.ground_m;  // the parts of a building stand level with each other
      kinds[i] = completed(kinds[i], kind_of_osm_building(*outline.tags));
    }
    if (has_parts) continue;
    kinds.push_back(kind_of_osm_building(*outline.tags));
    drawn.push_back(std::move(outline));
  }
  FlatRoofs flat;
  for (std::size_t i = 0; i < drawn.size(); ++i)
    Building(drawn[i], {"building", "Building", "", kinds[i]}, city, flat).draw();
  flat.warn(city);
  return drawn.size();
}

}  // namespace parvis::scene
