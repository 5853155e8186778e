#include "formats/city_models/city_json_sequence.h"

#include <array>
#include <sstream>

#include "base/json_guard.h"

namespace parvis::scene {
namespace {

using Json = nlohmann::json;

constexpr int deepest_list = 6;  // lists in each other: solids, shells, surfaces, rings, vertices

/// How many a list of the whole had before a feature's were appended to it.
struct Offsets {
  std::size_t vertices = 0, texture_vertices = 0, textures = 0, materials = 0;
};

/// Adds to every index in lists within lists.
void shift(Json& indices, std::size_t offset, int depth = deepest_list) {
  if (indices.is_number_unsigned()) indices = indices.get<std::size_t>() + offset;
  if (!indices.is_array() || depth == 0) return;
  for (Json& each : indices) shift(each, offset, depth - 1);
}

/// The innermost lists name a texture first, then a texture vertex for each corner.
void shift_textures(Json& values, const Offsets& offsets, int depth = deepest_list) {
  if (!values.is_array() || depth == 0) return;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i].is_number_unsigned())
      shift(values[i], i == 0 ? offsets.textures : offsets.texture_vertices);
    else
      shift_textures(values[i], offsets, depth - 1);
  }
}

template <class Change>
void each_theme(Json& geometry, const char* name, const Change& change) {
  if (!geometry.contains(name) || !geometry[name].is_object()) return;
  for (Json& theme : geometry[name])
    for (const char* list : {"value", "values"})
      if (theme.is_object() && theme.contains(list)) change(theme[list]);
}

void shift_geometry(Json& geometry, const Offsets& offsets) {
  if (!geometry.is_object()) return;
  if (geometry.contains("boundaries")) shift(geometry["boundaries"], offsets.vertices);
  each_theme(geometry, "material", [&](Json& values) { shift(values, offsets.materials); });
  each_theme(geometry, "texture", [&](Json& values) { shift_textures(values, offsets); });
}

/// Appends the list `name` of a feature to that of the whole; gives how long this was.
std::size_t append(Json& whole, const Json& part, const char* name) {
  Json& list = whole[name];
  if (!list.is_array()) list = Json::array();
  const std::size_t before = list.size();
  if (const auto found = part.find(name); found != part.end() && found->is_array())
    list.insert(list.end(), found->begin(), found->end());
  return before;
}

void append_feature(Json& city, Json& feature) {
  Offsets offsets;
  offsets.vertices = append(city, feature, "vertices");
  if (const auto appearance = feature.find("appearance");
      appearance != feature.end() && appearance->is_object()) {
    Json& whole = city["appearance"];
    if (!whole.is_object()) whole = Json::object();
    offsets.texture_vertices = append(whole, *appearance, "vertices-texture");
    offsets.textures = append(whole, *appearance, "textures");
    offsets.materials = append(whole, *appearance, "materials");
  }
  for (auto& [name, object] : feature["CityObjects"].items()) {
    if (object.is_object() && object.contains("geometry") && object["geometry"].is_array())
      for (Json& geometry : object["geometry"]) shift_geometry(geometry, offsets);
    city["CityObjects"][name] = std::move(object);
  }
}

}  // namespace

Result<Json> city_json_of_sequence(const std::filesystem::path& file, const std::string& text) {
  std::istringstream lines(text);
  Json city;
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    const FileLocation where{file.string(), ++number, 0};
    if (line.find_first_not_of(" \t\r\x1e") == std::string::npos) continue;
    if (const Status depth = check_json_depth(line, "this line"); !depth)
      return Error{depth.errors().front().message, where};
    Json json = Json::parse(line, nullptr, false);
    const std::string type = json.is_object() ? json.value("type", Json()).dump() : "no JSON object";
    const char* expected = city.is_null() ? "\"CityJSON\"" : "\"CityJSONFeature\"";
    if (type != expected)
      return error_at(where, "this line of a CityJSON sequence is {}; expected {}", type, expected);
    if (city.is_null()) {
      city = std::move(json);
      if (!city["CityObjects"].is_object()) city["CityObjects"] = Json::object();
    } else if (json.contains("CityObjects") && json["CityObjects"].is_object()) {
      append_feature(city, json);
    }
  }
  if (city.is_null()) return error_at({file.string(), 0, 0}, "this CityJSON sequence is empty");
  return city;
}

}  // namespace parvis::scene
