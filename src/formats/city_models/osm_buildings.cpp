#include "formats/city_models/osm_buildings.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <unordered_map>

#include "formats/city_models/building_attributes.h"
#include "formats/city_models/osm_building_relations.h"
#include "formats/city_models/osm_canopies.h"
#include "formats/city_models/osm_corners.h"
#include "formats/city_models/osm_curves.h"
#include "formats/city_models/osm_measures.h"
#include "formats/city_models/osm_passages.h"
#include "formats/city_models/osm_points.h"
#include "formats/city_models/osm_relief.h"
#include "formats/city_models/osm_roof_finish.h"
#include "formats/city_models/osm_roofs.h"

namespace parvis::scene {
namespace {

using glm::dvec2, glm::dvec3;
using Ring = OsmRing;

constexpr double usual_levels = 2.0;
constexpr double lintel_m = 0.3;  // of wall between a passage and the eaves

/// Storeys of buildings without tags for their height.
struct UsualLevels {
  const char* kind;
  double levels;
};
constexpr std::array<UsualLevels, 17> usual_levels_of{{{"garage", 0.8},
                                                       {"garages", 0.8},
                                                       {"shed", 0.8},
                                                       {"hut", 0.8},
                                                       {"carport", 0.8},
                                                       {"roof", 1.5},
                                                       {"canopy", 1.5},
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

double usual_height_m(const OsmTags& tags) {
  const std::string& kind = tag(tags, tag(tags, "building").empty() ? "building:part" : "building");
  const auto found = std::ranges::find(usual_levels_of, kind,
                                       [](const UsualLevels& each) { return std::string(each.kind); });
  return osm_level_m * (found == usual_levels_of.end() ? usual_levels : found->levels);
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

/// Data of the map with which all its buildings are drawn.
struct MapContext {
  const OsmPassages& passages;
  OsmPosts& posts;
  CityAssembly& city;
  FlatRoofs& flat;
};

/// Draws one building.
class Building {
 public:
  Building(const OsmArea& footprint, const CityObject& object, const MapContext& around)
      : rings_(footprint.rings),
        ground_m_(footprint.ground_m),
        object_(object),
        posts_(around.posts),
        city_(around.city),
        is_canopy_(is_osm_canopy(*footprint.tags)) {
    const OsmTags& tags = *footprint.tags;
    std::vector<Ring> corners;
    corners.reserve(rings_.size());
    for (const Ring& ring : rings_) corners.push_back(corners_of(ring));
    const OsmRoofTags roof_tags{tag(tags, "roof:shape"), tag(tags, "roof:orientation") == "across",
                                degrees_in(tag(tags, "roof:direction")), degrees_in(tag(tags, "roof:angle"))};
    std::string why_flat;
    roof_ = find_osm_roof(roof_tags, corners, why_flat);
    if (!why_flat.empty()) around.flat.add(footprint.name, roof_tags.shape, why_flat);
    if (roof_) rings_ = std::move(corners);  // walls end where the roof begins
    finish_ = finish_of_osm_roof(tags, roof_ && !roof_->skeleton ? roof_->shape : "", is_canopy_, city_);
    find_heights(tags);
    if (!is_canopy_ && base_m_ == 0.0) find_opening(around.passages, footprint.name);
  }

  void draw() {
    if (is_canopy_) return draw_canopy();
    draw_walls();
    if (base_m_ > 0.0) add("OuterCeilingSurface", level_surface(base_m_, true));
    draw_roof();
  }

 private:
  using Edge = std::array<double, 4>;

  static Edge edge(dvec2 a, dvec2 b) { return {a.x, a.y, b.x, b.y}; }

  template <class Use>
  static void each_edge(const std::vector<Ring>& rings, const Use& use) {
    for (const Ring& ring : rings)
      for (std::size_t i = 0; i < ring.size(); ++i) use(ring[i], ring[(i + 1) % ring.size()]);
  }

  void find_heights(const OsmTags& tags) {
    base_m_ = std::max(metres_or(tags, "min_height", "building:min_level", 0.0), 0.0);
    const bool hangs = is_canopy_ && base_m_ >= headroom_m;  // min_height is where its slab begins
    const bool is_estimated = tag(tags, "height").empty() && metres_in(tag(tags, "est_height")).has_value();
    const char* const height = is_estimated ? "est_height" : "height";
    top_m_ =
        metres_or(tags, height, "building:levels", base_m_ + (hangs ? canopy_slab_m : usual_height_m(tags)));
    const bool gives_top = metres_in(tag(tags, height)).has_value();
    const double roof_m =
        std::max(roof_ ? metres_or(tags, "roof:height", "roof:levels", usual_osm_roof_m(*roof_)) : 0.0, 0.0);
    if (!gives_top) top_m_ = std::max(top_m_, base_m_) + roof_m;  // levels do not count those in the roof
    if (top_m_ <= base_m_)
      top_m_ = base_m_ + (hangs        ? canopy_slab_m
                          : is_canopy_ ? usual_height_m(tags)
                                       : metres_or(tags, "roof:height", "roof:levels", osm_level_m));
    if (top_m_ <= base_m_) top_m_ = base_m_ + osm_level_m;
    eaves_m_ = std::max(top_m_ - roof_m, base_m_);
    if (is_canopy_ && !hangs) base_m_ = std::max(eaves_m_ - canopy_slab_m, 0.0);
  }

  void find_opening(const OsmPassages& passages, const std::string& name) {
    opening_ = passages.through(rings_, name);
    if (!opening_) return;
    opening_m_ = std::min(opening_->top_m - ground_m_, eaves_m_ - lintel_m);
    if (opening_m_ >= headroom_m) return;
    opening_.reset();
    city_.warn(
        fmt::format("{}: its walls are {:.1f} m high, too low for the passage that leads through it; it "
                    "is drawn without",
                    name, eaves_m_));
  }

  void wall(dvec2 a, dvec2 b, double low_m, double high_m) {
    if (high_m > low_m) add("WallSurface", {{{a, low_m}, {b, low_m}, {b, high_m}, {a, high_m}}});
  }

  /// Draws walls of one piece each, round where they turn by little.
  void draw_whole_walls() {
    if (!(eaves_m_ > base_m_)) return;
    std::vector<OsmFacet> walls, facets;
    std::vector<bool> is_facet;
    each_edge(rings_, [&](dvec2 a, dvec2 b) {
      walls.push_back({{a, base_m_}, {b, base_m_}, {b, eaves_m_}, {a, eaves_m_}});
      is_facet.push_back(is_curved(a, b));
      if (is_facet.back()) facets.push_back(walls.back());
    });
    std::vector<std::vector<glm::vec3>> normals = curved_normals(facets);
    for (std::size_t i = 0, facet = 0; i < walls.size(); ++i)
      add("WallSurface", {std::move(walls[i])},
          is_facet[i] ? std::move(normals[facet++]) : std::vector<glm::vec3>());
  }

  void draw_walls() {
    if (!opening_) return draw_whole_walls();
    std::set<Edge> own, whole;
    each_edge(rings_, [&](dvec2 a, dvec2 b) { own.insert(edge(a, b)); });
    each_edge(opening_->ground, [&](dvec2 a, dvec2 b) {
      if (own.contains(edge(a, b)))
        whole.insert(edge(a, b));
      else
        wall(a, b, base_m_, opening_m_);
    });
    each_edge(rings_, [&](dvec2 a, dvec2 b) {
      wall(a, b, whole.contains(edge(a, b)) ? base_m_ : opening_m_, eaves_m_);
    });
    for (const auto& [a, b, c] : opening_->ceiling)
      add("OuterCeilingSurface", {{{c, opening_m_}, {b, opening_m_}, {a, opening_m_}}});
  }

  void draw_roof() {
    if (!roof_) return add("RoofSurface", level_surface(top_m_, false));
    std::vector<OsmRoofFace> faces = osm_roof_faces(*roof_, eaves_m_, top_m_);
    std::vector<std::vector<glm::vec3>> normals(faces.size());
    if (is_curved(*roof_)) {
      std::vector<OsmFacet> facets;
      facets.reserve(faces.size());
      for (const OsmRoofFace& face : faces) facets.push_back(face.points);
      normals = curved_normals(facets);
    }
    for (std::size_t i = 0; i < faces.size(); ++i)
      add(is_canopy_ ? "RoofSurface" : faces[i].semantics, {std::move(faces[i].points)},
          std::move(normals[i]));
  }

  /// A slab on posts, or what its tags put on top of one; open below.
  void draw_canopy() {
    if (eaves_m_ > base_m_)
      each_edge(rings_, [&](dvec2 a, dvec2 b) {
        add("RoofSurface", {{{a, base_m_}, {b, base_m_}, {b, eaves_m_}, {a, eaves_m_}}});
      });
    add("OuterCeilingSurface", level_surface(base_m_, true));
    draw_roof();
    posts_.add(rings_, ground_m_ + base_m_);
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

  void add(const std::string& semantics, std::vector<std::vector<dvec3>> rings,
           std::vector<glm::vec3> normals = {}) {
    for (std::vector<dvec3>& ring : rings)
      for (dvec3& point : ring) point.z += ground_m_;
    CitySurface surface;
    surface.rings = std::move(rings);
    surface.normals = std::move(normals);
    surface.semantics = semantics;
    surface.is_of_solid = true;
    if (semantics == "RoofSurface") surface.finish = finish_.name, surface.material = finish_.material;
    city_.add(object_, surface);
  }

  std::vector<Ring> rings_;
  double ground_m_;
  const CityObject& object_;
  OsmPosts& posts_;
  CityAssembly& city_;
  bool is_canopy_;
  std::optional<OsmRoof> roof_;  ///< nothing: it is flat
  OsmRoofFinish finish_;
  double base_m_ = 0.0, eaves_m_ = 0.0, top_m_ = 0.0;  ///< above the ground
  std::optional<OsmOpening> opening_;                  ///< of passages
  double opening_m_ = 0.0;                             ///< its height above the ground
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
  const OsmBuildingRelations relations(osm);
  std::vector<OsmArea> drawn = areas.find(has_key("building:part"), "a building"), outlines;
  std::unordered_map<std::string, std::size_t> part_by_name;
  for (OsmArea& area : areas.find(has_key("building"), "a building")) {
    const bool is_part = says_yes(*area.tags, "building:part");  // it is among them
    if (!is_part && relations.is_part(area.name))
      drawn.push_back(std::move(area));
    else
      outlines.push_back(std::move(area));
  }
  OsmPoints<std::size_t> parts;     // by the middles of their outlines
  std::vector<BuildingKind> kinds;  // of those that are drawn
  kinds.reserve(drawn.size() + outlines.size());
  for (OsmArea& part : drawn) {
    kinds.push_back(kind_of_osm_building(*part.tags));
    part.ground_m = lowest_m(part.rings[0], ground);
    parts.add(middle(part.rings[0]), kinds.size() - 1);
    part_by_name.emplace(part.name, kinds.size() - 1);
  }
  const std::size_t part_count = drawn.size();
  drawn.reserve(part_count + outlines.size());  // parts are pointed to
  for (OsmArea& outline : outlines) {
    outline.ground_m = lowest_m(outline.rings[0], ground);
    const BuildingKind kind = kind_of_osm_building(*outline.tags);
    std::vector<const OsmArea*> own_parts;
    const auto take = [&](std::size_t i) {
      if (drawn[i].tags == outline.tags) return;
      drawn[i].ground_m = outline.ground_m;  // the parts of a building stand level with each other
      kinds[i] = completed(kinds[i], kind);
      own_parts.push_back(&drawn[i]);
    };
    const auto [low, high] = box_of(outline.rings[0]);
    parts.each_in(low, high, [&](dvec2 point, std::size_t i) {
      if (holds(outline.rings[0], point)) take(i);
    });
    for (const std::string& name : relations.parts_of(outline.name))
      if (const auto part = part_by_name.find(name); part != part_by_name.end()) take(part->second);
    const bool is_drawn = says_yes(*outline.tags, "building:part");  // as a part of itself
    if (is_drawn || (!own_parts.empty() && parts_cover(outline, own_parts))) continue;
    kinds.push_back(kind);
    drawn.push_back(std::move(outline));
  }
  const OsmPassages passages(osm, place, ground, city);
  OsmPosts posts(ground, city);
  FlatRoofs flat;
  const MapContext around{passages, posts, city, flat};
  for (std::size_t i = 0; i < drawn.size(); ++i)
    Building(drawn[i], {"building", "Building", "", kinds[i]}, around).draw();
  flat.warn(city);
  return drawn.size();
}

}  // namespace parvis::scene
