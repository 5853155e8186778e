#include "formats/city_models/osm_file.h"

#include <expat.h>

#include <charconv>
#include <cmath>
#include <memory>
#include <string_view>

#include "formats/city_models/xml_guard.h"

namespace parvis::scene {
namespace {

constexpr std::size_t max_warnings = 20;

/// The attributes of one element.
class Attributes {
 public:
  explicit Attributes(const char** list) : list_(list) {}

  std::string_view text(std::string_view name) const {
    for (const char** each = list_; *each; each += 2)
      if (name == each[0]) return each[1];
    return {};
  }

  template <class T>
  std::optional<T> number(std::string_view name) const {
    const std::string_view written = text(name);
    T value{};
    const auto [end, problem] = std::from_chars(written.data(), written.data() + written.size(), value);
    if (problem != std::errc() || end != written.data() + written.size()) return std::nullopt;
    return value;
  }

 private:
  const char** list_;
};

/// Takes in one element after the other.
class Reader {
 public:
  Reader(const std::filesystem::path& file, Errors& warnings)
      : file_(file), warnings_(warnings), parser_(XML_ParserCreate(nullptr), XML_ParserFree) {
    XML_SetUserData(parser_.get(), this);
    XML_SetElementHandler(
        parser_.get(),
        [](void* user, const char* name, const char** attributes) {
          static_cast<Reader*>(user)->begin(name, Attributes(attributes));
        },
        [](void* user, const char* name) { static_cast<Reader*>(user)->end(name); });
  }

  /// The bytes are well-formed: read_xml says so.
  OsmFile read(const std::string& bytes) {
    constexpr std::size_t piece = 1 << 20;
    for (std::size_t at = 0; at < bytes.size(); at += piece) {
      const std::size_t length = std::min(piece, bytes.size() - at);
      XML_Parse(parser_.get(), bytes.data() + at, int(length), at + length == bytes.size());
    }
    if (!has_bounds_) bound_nodes();
    return std::move(osm_);
  }

 private:
  int line() const { return int(XML_GetCurrentLineNumber(parser_.get())); }

  void warn(const std::string& message) {
    if (++warning_count_ <= max_warnings) warnings_.push_back({message, {file_.string(), line(), 0}});
  }

  void begin(std::string_view name, const Attributes& attributes) {
    if (name == "bounds") return read_bounds(attributes);
    if (name == "node") return read_node(attributes);
    if (name == "way") return begin_way(attributes);
    if (name == "relation") return begin_relation(attributes);
    if (name == "tag" && tags_)
      tags_->insert_or_assign(std::string(attributes.text("k")), attributes.text("v"));
    if (name == "nd" && way_) {
      if (const auto node = attributes.number<OsmId>("ref")) way_->nodes.push_back(*node);
    }
    if (name == "member" && relation_) {
      if (const auto id = attributes.number<OsmId>("ref"))
        relation_->members.push_back(
            {std::string(attributes.text("type")), std::string(attributes.text("role")), *id});
    }
  }

  void end(std::string_view name) {
    if (name != "way" && name != "relation") return;
    way_ = nullptr, relation_ = nullptr, tags_ = nullptr;
  }

  void read_bounds(const Attributes& attributes) {
    const auto west = attributes.number<double>("minlon"), south = attributes.number<double>("minlat"),
               east = attributes.number<double>("maxlon"), north = attributes.number<double>("maxlat");
    has_bounds_ = west && south && east && north && is_on_earth(*west, *south) && is_on_earth(*east, *north);
    if (!has_bounds_) return warn("these bounds lie nowhere on the earth; those of the nodes stand for them");
    osm_.min_deg = {*west, *south};
    osm_.max_deg = {*east, *north};
  }

  static bool is_on_earth(double longitude_deg, double latitude_deg) {
    return std::abs(longitude_deg) <= 180.0 && std::abs(latitude_deg) < 84.0;  // as far as UTM goes
  }

  void read_node(const Attributes& attributes) {
    const auto id = attributes.number<OsmId>("id");
    const auto longitude_deg = attributes.number<double>("lon"),
               latitude_deg = attributes.number<double>("lat");
    if (!id || !longitude_deg || !latitude_deg || !is_on_earth(*longitude_deg, *latitude_deg))
      return warn(
          fmt::format("node {}: expected an id, a lon within 180 and a lat within 84 degrees; it is left "
                      "out",
                      attributes.text("id")));
    osm_.nodes[*id] = {*longitude_deg, *latitude_deg};
  }

  void begin_way(const Attributes& attributes) {
    const auto id = attributes.number<OsmId>("id");
    if (!id) return warn("a way without an id is left out");
    osm_.way_of[*id] = osm_.ways.size();
    way_ = &osm_.ways.emplace_back();
    way_->id = *id;
    way_->line = line();
    tags_ = &way_->tags;
  }

  void begin_relation(const Attributes& attributes) {
    const auto id = attributes.number<OsmId>("id");
    if (!id) return warn("a relation without an id is left out");
    relation_ = &osm_.relations.emplace_back();
    relation_->id = *id;
    tags_ = &relation_->tags;
  }

  void bound_nodes() {
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
  std::unique_ptr<std::remove_pointer_t<XML_Parser>, void (*)(XML_Parser)> parser_;
  OsmFile osm_;
  bool has_bounds_ = false;
  OsmWay* way_ = nullptr;  ///< that is open
  OsmRelation* relation_ = nullptr;
  OsmTags* tags_ = nullptr;  ///< of the open one
};

}  // namespace

const std::string& tag(const OsmTags& tags, const std::string& key) {
  static const std::string none;
  const auto found = tags.find(key);
  return found == tags.end() ? none : found->second;
}

Result<OsmFile> read_osm_file(const std::filesystem::path& file, Errors& warnings) {
  const FileLocation where{file.string(), 0, 0};
  const Result<XmlText> xml = read_xml(file);
  if (!xml) return xml.errors();
  if (xml->root != "osm")
    return error_at(where, "this is no OpenStreetMap file: its outermost element is <{}>; expected <osm>",
                    xml->root);
  OsmFile osm = Reader(file, warnings).read(xml->bytes);
  if (osm.nodes.empty()) return error_at(where, "this OpenStreetMap file has no nodes");
  return osm;
}

}  // namespace parvis::scene
