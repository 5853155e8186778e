#include "formats/city_models/osm_file.h"

#include <cmath>
#include <osmium/io/pbf_input.hpp>
#include <osmium/io/reader.hpp>
#include <osmium/io/xml_input.hpp>
#include <osmium/visitor.hpp>

#include "base/exception_reason.h"
#include "formats/city_models/xml_guard.h"
#include "formats/readers/packed_file.h"

namespace parvis::scene {
namespace {

constexpr std::size_t max_warnings = 20;
constexpr double max_latitude_deg = 84.0;  // as far as UTM goes

bool is_on_earth(glm::dvec2 deg) { return std::abs(deg.x) <= 180.0 && std::abs(deg.y) < max_latitude_deg; }

OsmTags tags_of(const osmium::TagList& list) {
  OsmTags tags;
  for (const osmium::Tag& each : list) tags.insert_or_assign(each.key(), each.value());
  return tags;
}

const char* type_of(osmium::item_type type) {
  return type == osmium::item_type::node ? "node" : type == osmium::item_type::way ? "way" : "relation";
}

/// Takes in one element after the other.
class Reader {
 public:
  Reader(const std::filesystem::path& file, Errors& warnings) : file_(file), warnings_(warnings) {}

  /// `format`: "osm" or "pbf". The library throws what it cannot read.
  OsmFile read(const std::string& bytes, const char* format) {
    osmium::io::Reader reader(osmium::io::File(bytes.data(), bytes.size(), format));
    const osmium::Box box = reader.header().joined_boxes();
    while (const osmium::memory::Buffer buffer = reader.read())
      for (const osmium::OSMEntity& entity : buffer.select<osmium::OSMEntity>()) add(entity);
    reader.close();
    bound(box);
    return std::move(osm_);
  }

 private:
  void warn(const std::string& message) {
    if (++warning_count_ <= max_warnings) warnings_.push_back({message, {file_.string(), 0, 0}});
  }

  void add(const osmium::OSMEntity& entity) {
    if (entity.type() == osmium::item_type::node) return add(static_cast<const osmium::Node&>(entity));
    if (entity.type() == osmium::item_type::way) return add(static_cast<const osmium::Way&>(entity));
    if (entity.type() == osmium::item_type::relation) add(static_cast<const osmium::Relation&>(entity));
  }

  void add(const osmium::Node& node) {
    if (!node.visible()) return;
    const osmium::Location at = node.location();
    const glm::dvec2 deg =
        at.valid() ? glm::dvec2(at.lon_without_check(), at.lat_without_check()) : glm::dvec2(1e9);
    if (!is_on_earth(deg))
      return warn(
          fmt::format("node {}: expected a longitude within 180 and a latitude within {} degrees; it is "
                      "left out",
                      node.id(), max_latitude_deg));
    osm_.nodes[node.id()] = deg;
    if (!node.tags().empty()) osm_.tagged_nodes.push_back({node.id(), tags_of(node.tags())});
  }

  void add(const osmium::Way& way) {
    if (!way.visible()) return;
    OsmWay read{way.id(), {}, tags_of(way.tags())};
    for (const osmium::NodeRef& node : way.nodes()) read.nodes.push_back(node.ref());
    osm_.way_of[read.id] = osm_.ways.size();
    osm_.ways.push_back(std::move(read));
  }

  void add(const osmium::Relation& relation) {
    if (!relation.visible()) return;
    OsmRelation read{relation.id(), {}, tags_of(relation.tags())};
    for (const osmium::RelationMember& member : relation.members())
      read.members.push_back({type_of(member.type()), member.role(), member.ref()});
    osm_.relations.push_back(std::move(read));
  }

  void bound(const osmium::Box& box) {
    if (box.valid()) {
      osm_.min_deg = {box.bottom_left().lon_without_check(), box.bottom_left().lat_without_check()};
      osm_.max_deg = {box.top_right().lon_without_check(), box.top_right().lat_without_check()};
      if (is_on_earth(osm_.min_deg) && is_on_earth(osm_.max_deg)) return;
      warn("these bounds lie nowhere on the earth; those of the nodes stand for them");
    }
    osm_.min_deg = glm::dvec2(1e9);
    osm_.max_deg = glm::dvec2(-1e9);
    for (const auto& [id, place] : osm_.nodes) {
      osm_.min_deg = glm::min(osm_.min_deg, place);
      osm_.max_deg = glm::max(osm_.max_deg, place);
    }
  }

  const std::filesystem::path& file_;
  Errors& warnings_;
  std::size_t warning_count_ = 0;
  OsmFile osm_;
};

/// The bytes of the file, after XML has been looked through.
Result<std::string> guarded_bytes(const std::filesystem::path& file, bool is_xml) {
  if (!is_xml) return formats::read_unpacked(file);
  Result<XmlText> xml = read_xml(file);
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

Result<OsmFile> read_osm_file(const std::filesystem::path& file, Errors& warnings) {
  const FileLocation where{file.string(), 0, 0};
  const bool is_xml = formats::model_extension(file) != ".pbf";
  const Result<std::string> bytes = guarded_bytes(file, is_xml);
  if (!bytes) return bytes.errors();
  try {
    OsmFile osm = Reader(file, warnings).read(*bytes, is_xml ? "osm" : "pbf");
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
