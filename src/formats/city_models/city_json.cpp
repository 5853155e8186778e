#include "formats/city_models/city_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "base/checked.h"
#include "base/isolated_process.h"
#include "base/json_guard.h"
#include "base/memory_budget.h"
#include "formats/city_models/building_attributes.h"
#include "formats/city_models/city_assembly.h"
#include "formats/city_models/city_coordinates.h"
#include "formats/city_models/city_json_clues.h"
#include "formats/city_models/city_json_sequence.h"
#include "formats/city_models/city_json_values.h"
#include "formats/city_models/city_lod.h"
#include "formats/city_models/city_semantics.h"
#include "formats/readers/packed_file.h"
#include "land/heights/city_surfaces.h"

namespace parvis::scene {
namespace {

namespace fs = std::filesystem;

constexpr std::array versions{"0.2", "0.3", "0.4", "0.5", "0.6", "0.7", "0.8", "0.9", "1.0", "1.1", "2.0"};

struct Problem {
  std::string message;
};

template <class... Args>
[[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) {
  throw Problem{fmt::format(format, std::forward<Args>(args)...)};
}

bool is_known(const std::string& version) {
  return std::any_of(versions.begin(), versions.end(),
                     [&](const char* known) { return version.starts_with(known); });
}

/// The number alone: early files name the version by an address, "http://www.cityjson.org/version/0.2".
std::string version_of(const Json& city) {
  const std::string named = text(member(city, "version"));
  return named.substr(named.rfind('/') + 1);
}

/// Version 0.2 called itself CityModel in some writers.
bool is_city_json(const Json& city) {
  return member(city, "type") == "CityJSON" ||
         (version_of(city).starts_with("0.") && city.contains("CityObjects"));
}

double level_of_detail(const Json& geometry) {
  const Json& lod = member(geometry, "lod");
  if (lod.is_number()) return lod.get<double>();
  return lod.is_string() ? std::atof(lod.get_ref<const std::string&>().c_str()) : 0.0;
}

glm::dvec3 triple(const Json& value, const char* what) {
  if (!value.is_array() || value.size() < 3)
    fail("{} is {}; expected three numbers", what, value.dump().substr(0, 60));
  const glm::dvec3 v(value[0].get<double>(), value[1].get<double>(), value[2].get<double>());
  if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) fail("{} is not finite", what);
  return v;
}

std::vector<glm::dvec3> triples(const Json& list, const char* what) {
  std::vector<glm::dvec3> points;
  for (const Json& point : list) points.push_back(triple(point, what));
  return points;
}

/// Semantics and themes of each surface of a geometry, in lists nested as its boundaries are. Up to version
/// 0.3 semantics were such a list themselves, and up to 0.2 there were no themes.
struct Attached {
  const Json* semantics;
  const Json* material;
  const Json* texture;

  Attached at(std::size_t i) const {
    // A material may be told once for all surfaces: then it is no list.
    return {&element(*semantics, i), material->is_array() ? &element(*material, i) : material,
            &element(*texture, i)};
  }
};

/// The values of the theme that counts.
const Json& themed(const Json& themes, const Json& default_theme) {
  const Json* theme = &themes;
  if (themes.is_array()) return *theme;
  if (themes.is_object() && !themes.contains("values") && !themes.contains("value")) {
    if (themes.empty()) return nothing();
    const auto found = default_theme.is_string() ? themes.find(text(default_theme)) : themes.end();
    theme = found != themes.end() ? &*found : &*themes.begin();
  }
  return theme->is_object() && theme->contains("value") ? member(*theme, "value") : member(*theme, "values");
}

/// Where a geometry's corners lie: among the file's vertices, or among a template's, placed.
struct Corners {
  const std::vector<glm::dvec3>* vertices;
  glm::dmat4 file_from_vertices{1.0};

  glm::dvec3 at(std::size_t i) const {
    return glm::dvec3(file_from_vertices * glm::dvec4((*vertices)[i], 1.0));
  }
  bool is_mirrored() const { return glm::determinant(glm::dmat3(file_from_vertices)) < 0.0; }
};

/// The name of the system of the coordinates; up to version 0.8 its number alone. May be empty.
std::string system_of(const Json& city) {
  const Json& metadata = member(city, "metadata");
  if (const Json& number = member(member(metadata, "crs"), "epsg"); number.is_number_unsigned())
    return "EPSG:" + number.dump();
  return text(member(metadata, "referenceSystem"));
}

class CityJsonReader {
 public:
  CityJsonReader(const fs::path& file, const Json& json, Errors& warnings, std::optional<double> max_detail,
                 const std::string& map)
      : json_(json), max_detail_(max_detail), city_(file, read_vertices(file, map, warnings), warnings) {}

  /// The middle of the place on the earth (degrees: east, north), where the file says it.
  const std::optional<glm::dvec2>& place_deg() const { return coordinates_.place_deg(); }

  Result<Model> read() {
    read_templates();
    read_appearance();
    const Json& objects = member(json_, "CityObjects");
    if (!objects.is_object()) fail("there are no \"CityObjects\"");
    charge_instances(objects);
    for (const auto& [name, object] : objects.items()) read_object(name, object);
    Result<Model> model = city_.finish(objects.size());
    if (model) model->map = coordinates_.map(), model->true_north_deg = coordinates_.true_north_deg();
    return model;
  }

 private:
  // --- vertices and appearance

  /// Fills `vertices_`, in metres; gives the middle of the place, in whole metres: heights stay as they are.
  glm::dvec3 read_vertices(const fs::path& file, const std::string& map, Errors& warnings) {
    if (!is_city_json(json_)) fail("this is no CityJSON: its \"type\" is {}", member(json_, "type").dump());
    if (const std::string version = version_of(json_); !is_known(version))
      fail("CityJSON version \"{}\" is not known; versions 0.2 to 2.0 are read", version);
    const Json& transform = member(json_, "transform");
    glm::dvec3 scale(1.0), translate(0.0);
    if (transform.is_object()) {
      scale = triple(member(transform, "scale"), "the transform's scale");
      translate = triple(member(transform, "translate"), "the transform's translation");
    }
    if (!member(json_, "vertices").is_array()) fail("there are no \"vertices\"");
    vertices_ = triples(json_["vertices"], "a vertex");
    for (glm::dvec3& vertex : vertices_) vertex = vertex * scale + translate;
    const std::vector<bool> is_named = named_vertices(json_, vertices_.size());
    CoordinateClues clues = coordinate_clues(json_, vertices_, is_named);
    clues.system = system_of(json_);
    Result<CityCoordinates> coordinates = CityCoordinates::find(clues, file, warnings, map);
    if (!coordinates) fail("{}", coordinates.errors().front().message);
    coordinates_ = *std::move(coordinates);
    glm::dvec3 low(1e300), high(-1e300);
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      glm::dvec3& vertex = vertices_[i];
      vertex = coordinates_(vertex);
      if (!is_named[i] || !std::isfinite(vertex.x + vertex.y)) continue;
      low = glm::min(low, vertex), high = glm::max(high, vertex);
    }
    if (!(low.x <= high.x)) return glm::dvec3(0.0);
    return {std::round(0.5 * (low.x + high.x)), std::round(0.5 * (low.y + high.y)), 0.0};
  }

  void read_templates() {
    template_vertices_ =
        triples(member(member(json_, "geometry-templates"), "vertices-templates"), "a template's vertex");
  }

  /// Numbers in lists in lists: the corners of a geometry's boundaries.
  static std::uint64_t corner_count(const Json& boundaries) {
    if (!boundaries.is_array()) return 1;
    std::uint64_t count = 0;
    for (const Json& inner : boundaries) count += corner_count(inner);
    return count;
  }

  /// A template of some bytes may be placed by any number of objects, and each gets triangles of its own.
  void charge_instances(const Json& objects) const {
    constexpr std::uint64_t bytes_per_corner =
        2 * sizeof(glm::vec3) + sizeof(glm::vec2) + 3 * sizeof(std::uint32_t);
    std::map<const Json*, std::uint64_t> corners_of;
    std::optional<std::uint64_t> corners = 0;
    std::size_t instances = 0;
    for (const auto& [name, object] : objects.items())
      for (const Json& geometry : member(object, "geometry")) {
        if (text(member(geometry, "type")) != "GeometryInstance") continue;
        const Json& shape = template_of(geometry);
        const auto [known, is_new] = corners_of.try_emplace(&shape, 0);
        if (is_new) known->second = corner_count(member(shape, "boundaries"));
        if (corners) corners = checked_sum({*corners, known->second});
        ++instances;
      }
    const auto bytes = corners ? checked_product({*corners, bytes_per_corner}) : std::nullopt;
    if (const Status status =
            check_memory(bytes, fmt::format("placing {} templates {} times", corners_of.size(), instances));
        !status)
      fail("{}", status.errors().front().message);
  }

  static glm::vec3 colour(const Json& value, glm::vec3 otherwise) {
    return value.is_array() ? glm::vec3(triple(value, "a material's colour")) : otherwise;
  }

  void read_appearance() {
    const Json& appearance = member(json_, "appearance");
    for (const Json& uv : member(appearance, "vertices-texture"))
      texture_vertices_.emplace_back(uv.at(0).get<float>(),
                                     1.0f - uv.at(1).get<float>());  // ours run downward
    for (const Json& texture : member(appearance, "textures")) {
      const std::string wrap = text(member(texture, "wrapMode"));
      pictures_.push_back(city_.add_picture(text(member(texture, "image")),
                                            wrap.empty() || wrap == "wrap" || wrap == "mirror"));
    }
    for (const Json& source : member(appearance, "materials")) {
      CityMaterial material;
      material.diffuse = colour(member(source, "diffuseColor"), material.diffuse);
      material.emissive = colour(member(source, "emissiveColor"), material.emissive);
      if (const Json& value = member(source, "transparency"); value.is_number())
        material.transparency = value;
      if (const Json& value = member(source, "shininess"); value.is_number()) material.shininess = value;
      materials_.push_back(city_.add_material(material));
    }
  }

  // --- objects

  void read_object(const std::string& name, const Json& object) {
    object_ = {name, text(member(object, "type")), text(member(member(object, "attributes"), "function")),
               kind_of(object)};
    std::vector<const Json*> geometries;
    std::vector<double> levels;
    for (const Json& geometry : member(object, "geometry"))
      if (has_surfaces(geometry)) geometries.push_back(&geometry), levels.push_back(level_of(geometry));
    const std::size_t before = city_.polygon_count();
    surfaces_of_object_.clear();
    has_listed_kinds_ = false;
    known_rings_.clear();
    if (const auto best = wanted_level(levels, max_detail_))
      for (std::size_t i = 0; i < geometries.size();
           ++i)  // roofs, walls and footprint may be one geometry each
        if (levels[i] == *best) read_geometry(*geometries[i]);
    add_surfaces();
    // Where the object's polygons are others' business; "Parts" and "Installations" up to version 0.6.
    const bool has_parts = std::any_of(group_members.begin(), group_members.end(),
                                       [&](const char* parts) { return !member(object, parts).empty(); });
    if (city_.polygon_count() == before && !has_parts)
      city_.warn(fmt::format("object \"{}\" has no polygons", name));
  }

  /// The value of an attribute as text; of a list (a building with several functions) the first.
  static std::string attribute_text(const Json& value) {
    const Json& first = value.is_array() ? element(value, 0) : value;
    if (first.is_object()) return text(member(first, "value"));  // beside its "codeSpace"
    return first.is_string() ? first.get<std::string>() : first.is_number() ? first.dump() : "";
  }

  static BuildingKind own_kind(const Json& object) {
    if (!is_building(text(member(object, "type")))) return {};
    BuildingAttributes attributes;
    const Json& given = member(object, "attributes");
    if (given.is_object())
      for (const auto& [name, value] : given.items()) attributes.emplace(name, attribute_text(value));
    return kind_of_building(attributes);
  }

  /// The kind of an object, completed by that of the building of which it is a part.
  BuildingKind kind_of(const Json& object) const {
    const std::string whole = text(element(member(object, "parents"), 0));
    const BuildingKind own = own_kind(object);
    return whole.empty() ? own
                         : completed(own, own_kind(member(member(json_, "CityObjects"), whole.c_str())));
  }

  void add_surfaces() {
    if (is_building(object_.type)) {
      drop_listed_kinds_that_are_all_alike();
      drop_implausible_semantics(surfaces_of_object_);
      infer_semantics(surfaces_of_object_);
    }
    for (const CitySurface& surface : surfaces_of_object_) city_.add(object_, surface);
  }

  const Json& template_of(const Json& instance) const {
    const Json& index = member(instance, "template");
    return index.is_number_unsigned()
               ? element(member(member(json_, "geometry-templates"), "templates"), index.get<std::size_t>())
               : nothing();
  }

  double level_of(const Json& geometry) const {
    return level_of_detail(text(member(geometry, "type")) == "GeometryInstance" ? template_of(geometry)
                                                                                : geometry);
  }

  /// Points and lines have none.
  static bool has_surfaces(const Json& geometry) {
    const std::string type = text(member(geometry, "type"));
    return type == "GeometryInstance" || type.ends_with("Surface") || type.ends_with("Solid");
  }

  void read_geometry(const Json& geometry) {
    if (text(member(geometry, "type")) == "GeometryInstance")
      read_instance(geometry);
    else
      read_boundaries(geometry, {&vertices_});
  }

  /// A template's shape, placed by a matrix and moved to a vertex of the file.
  void read_instance(const Json& instance) {
    const Json& shape = template_of(instance);
    if (shape.is_null())
      fail("object \"{}\": template {} is out of range; there are {}", object_.name,
           member(instance, "template").dump(),
           member(member(json_, "geometry-templates"), "templates").size());
    if (text(member(shape, "type")) == "GeometryInstance")
      fail("object \"{}\": a template that is itself an instance", object_.name);
    const std::size_t place = index(element(member(instance, "boundaries"), 0), vertices_.size(), "vertex");
    Corners corners{&template_vertices_};
    if (const Json& matrix = member(instance, "transformationMatrix"); !matrix.is_null()) {
      if (!matrix.is_array() || matrix.size() != 16)
        fail("object \"{}\": a transformation matrix of {} numbers; expected 16", object_.name,
             matrix.size());
      for (int i = 0; i < 16; ++i)  // row after row
        corners.file_from_vertices[i % 4][i / 4] = matrix[std::size_t(i)].get<double>();
    }
    corners.file_from_vertices[3] += glm::dvec4(vertices_[place], 0.0);
    read_boundaries(shape, corners);
  }

  void read_boundaries(const Json& geometry, const Corners& corners) {
    geometry_ = &geometry;
    const Json& semantics = member(geometry, "semantics");
    const Json& appearance = member(json_, "appearance");
    is_solid_ = is_solid(geometry);
    const bool has_list = semantics.is_array();
    has_listed_kinds_ = has_listed_kinds_ || has_list;
    const Attached attached{
        has_list ? &semantics : &told(semantics),
        &themed(member(geometry, "material"), member(appearance, "default-theme-material")),
        &themed(member(geometry, "texture"), member(appearance, "default-theme-texture"))};
    each_shell(geometry, attached, [&](const Json& surfaces, const Attached& of_shell) {
      read_surfaces(surfaces, of_shell, corners);
    });
  }

  /// The kind of each surface; nothing where the file gives one kind to all surfaces of a solid, which has
  /// several. In versions 0.2 and 0.3 the semantics are that list.
  const Json& told(const Json& semantics) const {
    const Json& values = member(semantics, "values");
    return is_solid_ && is_one_for_all(values) ? nothing() : values;
  }

  /// Writers of versions 0.2 and 0.3, which list a kind per surface, called every surface of a building a
  /// wall, in however many geometries.
  void drop_listed_kinds_that_are_all_alike() {
    std::vector<CitySurface>& surfaces = surfaces_of_object_;
    const bool are_alike = std::ranges::all_of(surfaces, [&](const CitySurface& surface) {
      return surface.semantics == surfaces.front().semantics;
    });
    if (!has_listed_kinds_ || surfaces.size() < 2 || !are_alike) return;
    for (CitySurface& surface : surfaces) surface.semantics.clear();
  }

  /// Decides whether values in lists nested as the boundaries hold one value for all surfaces.
  static bool is_one_for_all(const Json& values) {
    std::size_t count = 0;
    const Json* first = nullptr;
    const auto all_alike = [&](const auto& self, const Json& list) -> bool {
      if (list.is_array())
        return std::all_of(list.begin(), list.end(), [&](const Json& inner) { return self(self, inner); });
      if (first == nullptr) first = &list;
      return ++count > 0 && list == *first;
    };
    return all_alike(all_alike, values) && count > 1;
  }

  void read_surfaces(const Json& surfaces, const Attached& attached, const Corners& corners) {
    for (std::size_t i = 0; i < surfaces.size(); ++i)
      read_surface(element(surfaces, i), attached.at(i), corners);
  }

  // --- surfaces

  std::size_t index(const Json& value, std::size_t count, const char* what) const {
    if (!value.is_number_unsigned() || value.get<std::size_t>() >= count)
      fail("object \"{}\": {} {} is out of range; there are {}", object_.name, what, value.dump(), count);
    return value.get<std::size_t>();
  }

  void read_surface(const Json& surface, const Attached& attached, const Corners& corners) {
    if (!surface.is_array()) fail("object \"{}\": a surface is no list of rings", object_.name);
    CitySurface polygon;
    polygon.semantics = semantics_of(*geometry_, *attached.semantics);
    polygon.is_of_solid = is_solid_;
    if (attached.material->is_number())
      polygon.material = materials_[index(*attached.material, materials_.size(), "material")];
    const Json& pictured = element(element(*attached.texture, 0), 0);
    if (pictured.is_number()) polygon.picture = pictures_[index(pictured, pictures_.size(), "texture")];
    bool is_pictured = polygon.picture != no_index;
    for (std::size_t i = 0; i < surface.size(); ++i)
      is_pictured = read_ring(surface[i], element(*attached.texture, i), corners, polygon) && is_pictured;
    if (!is_pictured) polygon.picture_uv.clear();
    // Files may give a shape twice at one level, as a solid and as surfaces.
    if (polygon.rings.empty() || !known_rings_.insert(corners_of(polygon.rings.front())).second) return;
    surfaces_of_object_.push_back(std::move(polygon));
  }

  /// The same for rings that begin at another corner or run the other way round.
  static std::vector<std::array<double, 3>> corners_of(const std::vector<glm::dvec3>& ring) {
    std::vector<std::array<double, 3>> corners;
    corners.reserve(ring.size());
    for (const glm::dvec3& point : ring) corners.push_back({point.x, point.y, point.z});
    std::ranges::sort(corners);
    return corners;
  }

  /// Adds a ring without repeated points. False where its texture coordinates are not as many as its
  /// points.
  bool read_ring(const Json& ring, const Json& texture, const Corners& corners, CitySurface& polygon) const {
    if (!ring.is_array())
      fail("object \"{}\": a ring is {}; expected a list of vertices", object_.name,
           ring.dump().substr(0, 40));
    const bool is_pictured = texture.is_array() && texture.size() == ring.size() + 1;
    std::vector<glm::dvec3> points;
    std::vector<glm::vec2> uvs;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const std::size_t corner = index(ring[i], corners.vertices->size(), "vertex");
      const bool repeats = ring.size() > 1 && ring[i] == ring[i + 1 < ring.size() ? i + 1 : 0];
      const glm::vec2 uv =
          is_pictured ? texture_vertices_[index(texture[i + 1], texture_vertices_.size(), "texture vertex")]
                      : glm::vec2(0.0f);
      if (repeats) continue;
      points.push_back(corners.at(corner));
      uvs.push_back(uv);
    }
    if (points.size() < 3) return is_pictured;
    if (corners.is_mirrored())
      std::reverse(points.begin(), points.end()), std::reverse(uvs.begin(), uvs.end());
    polygon.rings.push_back(std::move(points));
    polygon.picture_uv.insert(polygon.picture_uv.end(), uvs.begin(), uvs.end());
    return is_pictured;
  }

  static constexpr std::array group_members{"children", "members", "Parts", "Installations"};

  const Json& json_;
  std::optional<double> max_detail_;
  CityCoordinates coordinates_;
  std::vector<glm::dvec3> vertices_, template_vertices_;
  std::vector<glm::vec2> texture_vertices_;
  CityAssembly city_;
  std::vector<int> pictures_, materials_;  ///< of the assembly, by the file's indices

  CityObject object_;  ///< that is being read
  std::vector<CitySurface> surfaces_of_object_;
  std::set<std::vector<std::array<double, 3>>> known_rings_;  ///< of that object
  const Json* geometry_ = nullptr;                            ///< that is being read
  bool is_solid_ = false;
  bool has_listed_kinds_ = false;  ///< of that object
};

/// Objects by what they are, and what of their geometry is no surface.
void account_for(const Json& city, FileAccount& account) {
  const Json& objects = member(city, "CityObjects");
  if (!objects.is_object()) return;
  for (const auto& [name, object] : objects.items()) {
    const std::string type = text(member(object, "type"));
    const Json& geometries = member(object, "geometry");
    const bool has_parts = !member(object, "children").empty();
    if (!geometries.is_array() || geometries.empty())
      account.unneeded("city objects",
                       has_parts ? "their parts have their geometry" : "they have no geometry", name);
    else if (type.starts_with('+'))
      account.changed("city objects", "kinds of extensions are shown by their geometry alone", type);
    else
      account.used("city objects");
    if (!geometries.is_array()) continue;
    for (const Json& geometry : geometries)
      if (const std::string kind = text(member(geometry, "type"));
          kind == "MultiPoint" || kind == "MultiLineString")
        account.left_out("geometries " + kind, "points and lines are not drawn", name);
  }
}

}  // namespace

Result<Model> read_city_model(const fs::path& file, Errors& warnings, std::optional<double> max_detail,
                              std::optional<glm::dvec2>* place_deg, const std::string& map,
                              FileAccount* account) {
  const FileLocation where{file.string(), 0, 0};
  const Result<std::string> bytes = formats::read_unpacked(file);
  if (!bytes) return bytes.errors();
  const bool is_sequence = formats::model_extension(file) == ".jsonl";
  if (Status depth = check_json_depth(*bytes, file.string()); !depth && !is_sequence) return depth.errors();
  try {
    const LeftInWorker<const Result<Json>> json(
        new Result<Json>(is_sequence ? city_json_of_sequence(file, *bytes) : Json::parse(*bytes)));
    if (!*json) return json->errors();
    CityJsonReader reader(file, **json, warnings, max_detail, map);
    if (place_deg) *place_deg = reader.place_deg();
    if (account) account_for(**json, *account);
    return reader.read();
  } catch (const Problem& problem) {
    return Error{problem.message, where};
  } catch (const Json::exception& problem) {
    return error_at(where, "a value is not what CityJSON asks for ({})", json_reason(problem.what()));
  }
}

}  // namespace parvis::scene
