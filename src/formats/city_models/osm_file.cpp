#include "formats/city_models/osm_file.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <osmium/io/pbf_input.hpp>
#include <osmium/io/reader.hpp>
#include <osmium/io/xml_input.hpp>
#include <osmium/visitor.hpp>
#include <set>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <unordered_set>

#include "base/exception_reason.h"
#include "formats/city_models/xml_guard.h"
#include "formats/readers/packed_file.h"
#include "formats/terrain/map_projection.h"
#include "formats/terrain/map_system.h"

namespace parvis::scene {
namespace {

constexpr std::size_t max_osm_warnings = 20;
constexpr double farthest_node_m = 100'000.0;  // no city is so wide, and floats end at centimetres there

bool is_on_earth(glm::dvec2 deg) { return std::abs(deg.x) <= 180.0 && std::abs(deg.y) < max_latitude_deg; }

OsmTags tags_of(const osmium::TagList& list) {
  OsmTags tags;
  for (const osmium::Tag& each : list) tags.insert_or_assign(each.key(), each.value());
  return tags;
}

const char* type_of(osmium::item_type type) {
  return type == osmium::item_type::node ? "node" : type == osmium::item_type::way ? "way" : "relation";
}

/// Elements that an editor (JOSM, Vespucci) keeps until the deletion is uploaded; libosmium reads no
/// "action".
class Deleted {
 public:
  void take(const char* name, const char** attributes) {
    bool is_deleted = false;
    OsmId id = 0;
    for (; *attributes; attributes += 2) {
      const std::string_view key(attributes[0]), value(attributes[1]);
      if (key == "action") is_deleted = value == "delete";
      if (key == "id") std::from_chars(value.data(), value.data() + value.size(), id);
    }
    if (is_deleted) ids_.emplace(name, id);
  }
  bool holds(osmium::item_type type, OsmId id) const {
    return !ids_.empty() && ids_.contains({type_of(type), id});
  }

 private:
  std::set<std::pair<std::string, OsmId>> ids_;
};

/// Takes in one element after the other.
class OsmFileReader {
 public:
  OsmFileReader(const std::filesystem::path& file, const Deleted& deleted, Errors& warnings)
      : file_(file), deleted_(deleted), warnings_(warnings) {}

  /// `format`: "osm" or "pbf". The library throws what it cannot read.
  OsmFile read(const std::string& bytes, const char* format, const std::string& map) {
    osmium::io::Reader reader(osmium::io::File(bytes.data(), bytes.size(), format));
    const osmium::Box box = reader.header().joined_boxes();
    while (const osmium::memory::Buffer buffer = reader.read())
      for (const osmium::OSMEntity& entity : buffer.select<osmium::OSMEntity>()) add(entity);
    reader.close();
    if (osm_.nodes.empty()) return std::move(osm_);
    bound(box);
    lay_on(map);
    return std::move(osm_);
  }

 private:
  void warn(const std::string& message) {
    if (++warning_count_ <= max_osm_warnings) warnings_.push_back({message, {file_.string(), 0, 0}});
  }

  void add(const osmium::OSMEntity& entity) {
    const bool is_object = entity.type() == osmium::item_type::node ||
                           entity.type() == osmium::item_type::way ||
                           entity.type() == osmium::item_type::relation;
    if (!is_object) return;
    const auto& object = static_cast<const osmium::OSMObject&>(entity);
    if (!object.visible() || deleted_.holds(object.type(), object.id())) {
      ++osm_.deleted;
      return;
    }
    if (entity.type() == osmium::item_type::node) return add(static_cast<const osmium::Node&>(entity));
    if (entity.type() == osmium::item_type::way) return add(static_cast<const osmium::Way&>(entity));
    if (entity.type() == osmium::item_type::relation) add(static_cast<const osmium::Relation&>(entity));
  }

  void add(const osmium::Node& node) {
    const osmium::Location at = node.location();
    const glm::dvec2 deg =
        at.valid() ? glm::dvec2(at.lon_without_check(), at.lat_without_check()) : glm::dvec2(1e9);
    if (!is_on_earth(deg))
      return warn(
          fmt::format("node {}: expected a longitude within 180 and a latitude within {} degrees; it is "
                      "left out",
                      node.id(), max_latitude_deg));
    osm_.nodes[node.id()] = deg;
    if (!node.tags().empty() && tagged_.insert(node.id()).second)
      osm_.tagged_nodes.push_back({node.id(), tags_of(node.tags())});
  }

  void add(const osmium::Way& way) {
    OsmWay read{way.id(), {}, tags_of(way.tags())};
    for (const osmium::NodeRef& node : way.nodes()) {
      read.nodes.push_back(node.ref());
      // Overpass ("out geom") and osmium (add-locations-to-ways) write places in ways, some without nodes.
      const osmium::Location at = node.location();
      if (!at.valid()) continue;
      const glm::dvec2 deg(at.lon_without_check(), at.lat_without_check());
      if (is_on_earth(deg)) osm_.nodes.try_emplace(node.ref(), deg);
    }
    const auto [place, is_new] = osm_.way_of.try_emplace(read.id, osm_.ways.size());
    if (is_new)
      osm_.ways.push_back(std::move(read));
    else  // extracts that were joined hold elements twice, histories in several versions: the last one counts
      osm_.ways[place->second] = std::move(read);
  }

  void add(const osmium::Relation& relation) {
    OsmRelation read{relation.id(), {}, tags_of(relation.tags())};
    for (const osmium::RelationMember& member : relation.members())
      read.members.push_back({type_of(member.type()), member.role(), member.ref()});
    const auto [place, is_new] = relation_of_.try_emplace(read.id, osm_.relations.size());
    if (is_new)
      osm_.relations.push_back(std::move(read));
    else
      osm_.relations[place->second] = std::move(read);
  }

  /// The bounds in degrees; across the date line they reach beyond 180.
  void bound(const osmium::Box& box) {
    if (box.valid()) {
      low_ = {box.bottom_left().lon_without_check(), box.bottom_left().lat_without_check()};
      high_ = {box.top_right().lon_without_check(), box.top_right().lat_without_check()};
      if (is_on_earth(low_) && is_on_earth(high_)) {
        if (high_.x - low_.x > 180.0) std::tie(low_.x, high_.x) = std::pair(high_.x, low_.x + 360.0);
        return;
      }
      warn("these bounds lie nowhere on the earth; those of the nodes stand for them");
    }
    for (const bool crosses_date_line : {false, true}) {
      low_ = glm::dvec2(1e9), high_ = glm::dvec2(-1e9);
      for (auto [id, deg] : osm_.nodes) {
        if (crosses_date_line && deg.x < 0.0) deg.x += 360.0;
        low_ = glm::min(low_, deg), high_ = glm::max(high_, deg);
      }
      if (high_.x - low_.x <= 180.0) return;
    }
  }

  /// Degrees become metres; what lies too far away to be drawn is dropped.
  void lay_on(const std::string& map) {
    osm_.middle_deg = 0.5 * (low_ + high_);
    std::optional<MapProjection> given = MapProjection::of(map);
    if (given && !std::isfinite((*given)(osm_.middle_deg).x)) given.reset();
    const MapProjection projection = given.value_or(MapProjection::utm(osm_.middle_deg));
    osm_.corners = {projection(low_), projection({high_.x, low_.y}), projection(high_),
                    projection({low_.x, high_.y})};
    osm_.middle = projection(osm_.middle_deg);
    osm_.map = projection.system();
    osm_.true_north_deg = projection.true_north_deg(osm_.middle_deg);
    if (osm_.middle_deg.x > 180.0) osm_.middle_deg.x -= 360.0;
    for (auto& [id, place] : osm_.nodes) place = projection(place);
    if (glm::distance(osm_.corners[0], osm_.corners[2]) < farthest_node_m)  // else all of it is refused
      std::erase_if(osm_.nodes, [&](const auto& node) {
        return !(glm::distance(node.second, osm_.middle) < farthest_node_m);
      });
  }

  const std::filesystem::path& file_;
  const Deleted& deleted_;
  Errors& warnings_;
  std::size_t warning_count_ = 0;
  glm::dvec2 low_{0.0}, high_{0.0};
  std::unordered_map<OsmId, std::size_t> relation_of_;  ///< index into the relations
  std::unordered_set<OsmId> tagged_;
  OsmFile osm_;
};

/// The bytes of the file, after XML has been looked through.
Result<std::string> guarded_bytes(const std::filesystem::path& file, bool is_xml, Deleted& deleted) {
  if (!is_xml) return formats::read_unpacked(file);
  Result<XmlText> xml =
      read_xml(file, [&](const char* name, const char** attributes) { deleted.take(name, attributes); });
  if (!xml) return xml.errors();
  if (xml->root != "osm")
    return error_at({file.string(), 0, 0},
                    "this is no OpenStreetMap file: its outermost element is <{}>; expected <osm>",
                    xml->root);
  return std::move(xml->bytes);
}

}  // namespace

const std::string& tag(const OsmTags& tags, const std::string& key) {
  static const std::string none;
  const auto found = tags.find(key);
  return found == tags.end() ? none : found->second;
}

Result<OsmFile> read_osm_file(const std::filesystem::path& file, Errors& warnings, const std::string& map) {
  if (const Status known = projections_known(); !known) return known.errors();
  const FileLocation where{file.string(), 0, 0};
  const bool is_xml = formats::model_extension(file) != ".pbf";
  Deleted deleted;
  const Result<std::string> bytes = guarded_bytes(file, is_xml, deleted);
  if (!bytes) return bytes.errors();
  try {
    OsmFile osm = OsmFileReader(file, deleted, warnings).read(*bytes, is_xml ? "osm" : "pbf", map);
    if (osm.nodes.empty())
      return error_at(
          where,
          "this OpenStreetMap file has no nodes, and so no place to show; export an area in which "
          "there is something (openstreetmap.org, Export)");
    return osm;
  } catch (const std::exception& problem) {  // of the library: what the file holds is not OpenStreetMap's
    return error_at(where, "this is no OpenStreetMap file that can be read: {}", reason_of(problem));
  }
}

}  // namespace parvis::scene
