#include "formats/city_models/city_gml_3.h"

#include <expat.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string_view>
#include <vector>

#include "formats/city_models/xml_pieces.h"

namespace parvis::scene {
namespace {

/// Modules of CityGML 3 and of GML 3.2 under the prefixes that version 2 is usually written with.
struct Module {
  std::string_view uri, prefix;
};
constexpr std::string_view core_uri = "http://www.opengis.net/citygml/3.0";
constexpr std::array<Module, 15> modules{{{core_uri, "core"},
                                          {"http://www.opengis.net/citygml/construction/3.0", "con"},
                                          {"http://www.opengis.net/citygml/building/3.0", "bldg"},
                                          {"http://www.opengis.net/citygml/bridge/3.0", "brid"},
                                          {"http://www.opengis.net/citygml/tunnel/3.0", "tun"},
                                          {"http://www.opengis.net/citygml/transportation/3.0", "tran"},
                                          {"http://www.opengis.net/citygml/waterbody/3.0", "wtr"},
                                          {"http://www.opengis.net/citygml/vegetation/3.0", "veg"},
                                          {"http://www.opengis.net/citygml/relief/3.0", "dem"},
                                          {"http://www.opengis.net/citygml/landuse/3.0", "luse"},
                                          {"http://www.opengis.net/citygml/cityfurniture/3.0", "frn"},
                                          {"http://www.opengis.net/citygml/generics/3.0", "gen"},
                                          {"http://www.opengis.net/citygml/appearance/3.0", "app"},
                                          {"http://www.opengis.net/gml/3.2", "gml"},
                                          {"http://www.w3.org/1999/xlink", "xlink"}}};
constexpr std::string_view root_tag =
    "CityModel xmlns=\"http://www.opengis.net/citygml/2.0\" "
    "xmlns:core=\"http://www.opengis.net/citygml/2.0\" "
    "xmlns:bldg=\"http://www.opengis.net/citygml/building/2.0\" "
    "xmlns:brid=\"http://www.opengis.net/citygml/bridge/2.0\" "
    "xmlns:tun=\"http://www.opengis.net/citygml/tunnel/2.0\" "
    "xmlns:tran=\"http://www.opengis.net/citygml/transportation/2.0\" "
    "xmlns:wtr=\"http://www.opengis.net/citygml/waterbody/2.0\" "
    "xmlns:veg=\"http://www.opengis.net/citygml/vegetation/2.0\" "
    "xmlns:dem=\"http://www.opengis.net/citygml/relief/2.0\" "
    "xmlns:luse=\"http://www.opengis.net/citygml/landuse/2.0\" "
    "xmlns:frn=\"http://www.opengis.net/citygml/cityfurniture/2.0\" "
    "xmlns:gen=\"http://www.opengis.net/citygml/generics/2.0\" "
    "xmlns:app=\"http://www.opengis.net/citygml/appearance/2.0\" xmlns:gml=\"http://www.opengis.net/gml\" "
    "xmlns:xlink=\"http://www.w3.org/1999/xlink\"";

struct Renaming {
  std::string_view in_3, in_2;
};
/// Elements of modules that version 2 has keep their names, but for these. Of core and construction these
/// alone are read, beside geometries.
constexpr std::array<Renaming, 45> renamings{
    {{"core:cityObjectMember", "core:cityObjectMember"},
     {"core:appearanceMember", "app:appearanceMember"},
     {"core:appearance", "app:appearance"},
     {"core:boundary", "bldg:boundedBy"},
     {"core:ClosureSurface", "bldg:ClosureSurface"},
     {"core:ImplicitGeometry", "core:ImplicitGeometry"},
     {"core:transformationMatrix", "core:transformationMatrix"},
     {"core:referencePoint", "core:referencePoint"},
     {"core:relativeGeometry", "core:relativeGMLGeometry"},
     {"con:WallSurface", "bldg:WallSurface"},
     {"con:RoofSurface", "bldg:RoofSurface"},
     {"con:GroundSurface", "bldg:GroundSurface"},
     {"con:FloorSurface", "bldg:FloorSurface"},
     {"con:CeilingSurface", "bldg:CeilingSurface"},
     {"con:InteriorWallSurface", "bldg:InteriorWallSurface"},
     {"con:OuterFloorSurface", "bldg:OuterFloorSurface"},
     {"con:OuterCeilingSurface", "bldg:OuterCeilingSurface"},
     {"con:fillingSurface", "bldg:opening"},
     {"con:filling", "bldg:opening"},
     {"con:WindowSurface", "bldg:Window"},
     {"con:Window", "bldg:Window"},
     {"con:DoorSurface", "bldg:Door"},
     {"con:Door", "bldg:Door"},
     {"con:OtherConstruction", "bldg:Building"},
     {"con:dateOfConstruction", "bldg:yearOfConstruction"},
     {"bldg:buildingPart", "bldg:consistsOfBuildingPart"},
     {"bldg:buildingRoom", "bldg:interiorRoom"},
     {"bldg:BuildingRoom", "bldg:Room"},
     {"bldg:buildingFurniture", "bldg:interiorFurniture"},
     {"bldg:buildingInstallation", "bldg:outerBuildingInstallation"},
     {"bldg:buildingConstructiveElement", "bldg:outerBuildingInstallation"},
     {"bldg:BuildingConstructiveElement", "bldg:BuildingInstallation"},
     {"brid:bridgePart", "brid:consistsOfBridgePart"},
     {"brid:bridgeInstallation", "brid:outerBridgeInstallation"},
     {"brid:bridgeConstructiveElement", "brid:outerBridgeConstruction"},
     {"brid:BridgeConstructiveElement", "brid:BridgeConstructionElement"},
     {"tun:tunnelPart", "tun:consistsOfTunnelPart"},
     {"app:surfaceData", "app:surfaceDataMember"},
     {"gen:StringAttribute", "gen:stringAttribute"},
     {"gen:CodeAttribute", "gen:stringAttribute"},
     {"gen:IntAttribute", "gen:intAttribute"},
     {"gen:DoubleAttribute", "gen:doubleAttribute"},
     {"gen:MeasureAttribute", "gen:doubleAttribute"},
     {"gen:DateAttribute", "gen:dateAttribute"},
     {"gen:UriAttribute", "gen:uriAttribute"}}};

/// Properties whose content takes their place.
constexpr std::array<std::string_view, 8> opened_properties{
    {"core:genericAttribute", "bldg:buildingSubdivision", "tran:section", "tran:intersection",
     "tran:trafficSpace", "tran:auxiliaryTrafficSpace", "app:textureParameterization",
     "app:TextureAssociation"}};
/// Objects of which only what they contain is read, without their own attributes and geometries.
constexpr std::array<std::string_view, 6> opened_objects{{"bldg:Storey", "bldg:BuildingUnit", "tran:Section",
                                                          "tran:Intersection", "tran:TrafficSpace",
                                                          "tran:AuxiliaryTrafficSpace"}};
constexpr std::array<std::string_view, 7> contents{
    {"core:boundary", "bldg:buildingRoom", "bldg:buildingInstallation", "bldg:buildingFurniture",
     "bldg:buildingConstructiveElement", "tran:trafficSpace", "tran:auxiliaryTrafficSpace"}};

template <class List>
bool list_holds(const List& list, std::string_view name) {
  return std::ranges::find(list, name) != list.end();
}

/// "core:lod2MultiSurface" as version 2 has it for buildings: libcitygml takes it in every object.
std::string geometry_in_2(std::string_view in_3) {
  constexpr std::string_view lod = "core:lod";
  if (!in_3.starts_with(lod) || in_3.size() <= lod.size() + 1) return {};
  const char level = in_3[lod.size()];
  const std::string_view kind = in_3.substr(lod.size() + 1);
  if (level < '0' || level > '3') return {};
  if (kind == "ImplicitRepresentation") return fmt::format("frn:lod{}ImplicitRepresentation", level);
  if (level == '0') return kind == "MultiSurface" ? "gen:lod0Geometry" : "";
  if (kind == "MultiSurface" || kind == "Solid") return fmt::format("bldg:lod{}{}", level, kind);
  return {};
}

/// The name in version 2; empty where there is none.
std::string name_in_2(std::string_view in_3) {
  for (const Renaming& renaming : renamings)
    if (renaming.in_3 == in_3) return std::string(renaming.in_2);
  if (in_3.starts_with("core:")) return geometry_in_2(in_3);
  if (in_3.starts_with("con:")) return {};
  return std::string(in_3);
}

/// Geometries are referred to (xlink:href). Of other properties what is referred to stands elsewhere in the
/// file.
bool may_be_empty(std::string_view in_3) {
  const char first = in_3[in_3.find(':') + 1];
  const bool is_property = first >= 'a' && first <= 'z';
  return !is_property || in_3.starts_with("gml:") || in_3.starts_with("core:lod") ||
         in_3 == "core:relativeGeometry";
}

std::string escaped(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  for (const char c : text) switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  return result;
}

/// The prefixed form of a name of expat, "namespace\nname". Empty for other schemas, the name alone where it
/// has no namespace.
std::string with_prefix(std::string_view name) {
  const std::size_t end = name.find('\n');
  if (end == std::string_view::npos) return std::string(name);
  const auto found = std::ranges::find(modules, name.substr(0, end), &Module::uri);
  if (found == modules.end()) return {};
  return fmt::format("{}:{}", found->prefix, name.substr(end + 1));
}

/// Writes version 2 as expat reads version 3.
class Translation {
 public:
  void start(std::string_view name, const char** attributes) {
    const std::string in_3 = with_prefix(name);
    if (skipped_ > 0 || is_left_out(in_3)) {
      if (skipped_++ == 0 && !open_.empty()) open_.back().has_lost = true;
      return;
    }
    const std::string parent = open_.empty() ? "" : open_.back().in_3;
    Element element{.in_3 = in_3, .tag = "", .begin = text_.size()};
    if (open_.empty()) {
      element.tag = "CityModel";
      text_ += fmt::format("<{}>", root_tag);
    } else if (is_kept_text(in_3, parent)) {
      kept_.clear();
      element.keeps_text = true;
    } else if (!list_holds(opened_properties, in_3) && !list_holds(opened_objects, in_3) &&
               !is_named_attribute(in_3)) {
      element.tag = name_in_2(in_3);
      write_start(element.tag, attributes);
    }
    if (in_3 == "app:TexCoordList") coordinates_.clear(), rings_.clear();
    element.content_begin = text_.size();
    open_.push_back(std::move(element));
  }

  void end() {
    if (skipped_ > 0) return void(--skipped_);
    const Element element = std::move(open_.back());
    open_.pop_back();
    if (element.keeps_text) use_kept(element.in_3);
    if (element.in_3 == "app:TexCoordList") write_coordinates();
    const bool must_hold = element.has_lost || !may_be_empty(element.in_3);
    if (must_hold && !open_.empty() && is_blank_from(element.content_begin)) {
      text_.resize(element.begin);  // libcitygml takes no property without the object that it is for
      open_.back().has_lost = true;
      return;
    }
    if (!element.tag.empty()) text_ += fmt::format("</{}>", element.tag);
  }

  void characters(std::string_view text) {
    if (skipped_ > 0 || open_.empty()) return;
    if (open_.back().keeps_text)
      kept_ += text;
    else if (!open_.back().tag.empty())
      text_ += escaped(text);
  }

  std::string take() && { return std::move(text_); }

 private:
  struct Element {
    std::string in_3;
    std::string tag;                           ///< that is open in version 2; may be empty
    bool keeps_text = false;                   ///< which is written later, elsewhere
    bool has_lost = false;                     ///< elements that are left out
    std::size_t begin = 0, content_begin = 0;  ///< in the text written
  };

  bool is_blank_from(std::size_t begin) const {
    return text_.find_first_not_of(" \t\r\n", begin) == std::string::npos;
  }

  static bool is_named_attribute(std::string_view in_3) {
    return in_3.starts_with("gen:") && in_3.ends_with("Attribute");
  }

  /// Names of attributes, targets of textures, rings and their coordinates become attributes of elements.
  static bool is_kept_text(std::string_view in_3, std::string_view parent) {
    return (in_3 == "gen:name" && is_named_attribute(parent)) ||
           (in_3 == "app:target" && parent == "app:TextureAssociation") ||
           (parent == "app:TexCoordList" && (in_3 == "app:textureCoordinates" || in_3 == "app:ring"));
  }

  bool is_left_out(std::string_view in_3) const {
    if (in_3.find(':') == std::string_view::npos) return true;  // of another schema, or of none
    if (open_.empty()) return false;
    const std::string_view parent = open_.back().in_3;
    if (list_holds(opened_objects, parent) && !list_holds(contents, in_3)) return true;
    return !list_holds(opened_properties, in_3) && !list_holds(opened_objects, in_3) &&
           name_in_2(in_3).empty();
  }

  void write_start(std::string_view tag, const char** attributes) {
    text_ += fmt::format("<{}", tag);
    for (; *attributes; attributes += 2)
      if (const std::string attribute = with_prefix(attributes[0]); !attribute.empty())
        text_ += fmt::format(" {}=\"{}\"", attribute, escaped(attributes[1]));
    text_ += '>';
  }

  void use_kept(std::string_view in_3) {
    Element& parent = open_.back();
    if (in_3 == "gen:name") {
      parent.tag = name_in_2(parent.in_3);
      text_ += fmt::format("<{} name=\"{}\">", parent.tag, escaped(kept_));
    } else if (in_3 == "app:target") {
      parent.tag = "app:target";
      text_ += fmt::format("<app:target uri=\"{}\">", escaped(kept_));
    } else {
      (in_3 == "app:ring" ? rings_ : coordinates_).push_back(kept_);
    }
  }

  void write_coordinates() {
    for (std::size_t i = 0; i < std::min(rings_.size(), coordinates_.size()); ++i)
      text_ += fmt::format("<app:textureCoordinates ring=\"{}\">{}</app:textureCoordinates>",
                           escaped(rings_[i]), escaped(coordinates_[i]));
  }

  std::string text_;
  std::vector<Element> open_;
  int skipped_ = 0;  ///< elements that are open and left out
  std::string kept_;
  std::vector<std::string> coordinates_, rings_;  ///< of a TexCoordList
};

void start_element(void* user, const char* name, const char** attributes) {
  static_cast<Translation*>(user)->start(name, attributes);
}
void end_element(void* user, const char*) { static_cast<Translation*>(user)->end(); }
void on_text(void* user, const char* text, int length) {
  static_cast<Translation*>(user)->characters({text, std::size_t(length)});
}

}  // namespace

bool is_city_gml_3(const std::string& root) { return root.find(core_uri) != std::string::npos; }

Result<std::string> city_gml_2_of(const std::string& xml, const FileLocation& where) {
  const std::unique_ptr<std::remove_pointer_t<XML_Parser>, void (*)(XML_Parser)> parser(
      XML_ParserCreateNS(nullptr, '\n'), XML_ParserFree);
  Translation translation;
  XML_SetUserData(parser.get(), &translation);
  XML_SetElementHandler(parser.get(), start_element, end_element);
  XML_SetCharacterDataHandler(parser.get(), on_text);
  if (!parse_in_pieces(parser.get(), xml))
    return error_at({where.file, int(XML_GetCurrentLineNumber(parser.get())),
                     int(XML_GetCurrentColumnNumber(parser.get())) + 1},
                    "its namespaces cannot be read: {}", XML_ErrorString(XML_GetErrorCode(parser.get())));
  return std::move(translation).take();
}

}  // namespace parvis::scene
