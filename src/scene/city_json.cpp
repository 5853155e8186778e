#include "scene/city_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/files.h"
#include "base/image_io.h"
#include "base/parallel.h"
#include "scene/city_surfaces.h"
#include "scene/placeholder.h"
#include "scene/polygon_triangles.h"

namespace parvis::scene {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr double tile_m = 60.0;  // parts of this size are culled one by one
constexpr std::array<const char*, 8> versions{"0.2", "0.3", "0.5", "0.6", "0.8", "0.9", "1.0", "1.1"};

struct Problem {
  std::string message;
};

template <class... Args>
[[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) {
  throw Problem{fmt::format(format, std::forward<Args>(args)...)};
}

const Json& member(const Json& object, const char* name) {
  static const Json nothing;
  const auto found = object.is_object() ? object.find(name) : object.end();
  return object.is_object() && found != object.end() ? *found : nothing;
}

const Json& element(const Json& list, std::size_t i) {
  static const Json nothing;
  return list.is_array() && i < list.size() ? list[i] : nothing;
}

bool is_known_version(const std::string& version) {
  return version.starts_with("2.0") || version == "0.4" || version == "0.7" ||
         std::any_of(versions.begin(), versions.end(),
                     [&](const char* known) { return version.starts_with(known); });
}

double level_of_detail(const Json& geometry) {
  const Json& lod = member(geometry, "lod");
  if (lod.is_number()) return lod.get<double>();
  return lod.is_string() ? std::atof(lod.get_ref<const std::string&>().c_str()) : 0.0;
}

/// A surface's values in the nested lists beside the boundaries: semantics, material, texture.
struct Attached {
  const Json* semantics;
  const Json* texture;

  Attached at(std::size_t i) const { return {&element(*semantics, i), &element(*texture, i)}; }
};

const Json& first_theme(const Json& themes) {
  static const Json nothing;
  return themes.is_object() && !themes.empty() ? *themes.begin() : nothing;
}

class Reader {
 public:
  Reader(const fs::path& file, const Json& json, Errors& warnings)
      : file_(file), json_(json), warnings_(warnings) {}

  Model read() {
    const std::string version =
        member(json_, "version").is_string() ? json_["version"].get<std::string>() : "";
    if (member(json_, "type") != "CityJSON")
      fail("this is no CityJSON: its \"type\" is {}", member(json_, "type").dump());
    if (!is_known_version(version))
      fail("CityJSON version \"{}\" is not known; versions 0.2 to 2.0 are read", version);
    read_vertices();
    read_texture_vertices();
    const Json& objects = member(json_, "CityObjects");
    if (!objects.is_object()) fail("there are no \"CityObjects\"");
    for (const auto& [name, object] : objects.items()) read_object(name, object);
    if (parts_.empty()) fail("none of the {} city objects has polygons", objects.size());
    return finished();
  }

 private:
  // --- vertices
  // --------------------------------------------------------------------------------------------------------

  static glm::dvec3 triple(const Json& value, const char* what) {
    if (!value.is_array() || value.size() < 3)
      fail("{} is {}; expected three numbers", what, value.dump().substr(0, 60));
    const glm::dvec3 v(value[0].get<double>(), value[1].get<double>(), value[2].get<double>());
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) fail("{} is not finite", what);
    return v;
  }

  void read_vertices() {
    const Json& transform = member(json_, "transform");
    glm::dvec3 scale(1.0), translate(0.0);
    if (transform.is_object()) {
      scale = triple(member(transform, "scale"), "the transform's scale");
      translate = triple(member(transform, "translate"), "the transform's translation");
    }
    const Json& vertices = member(json_, "vertices");
    if (!vertices.is_array()) fail("there are no \"vertices\"");
    glm::dvec3 low(1e300), high(-1e300);
    for (const Json& vertex : vertices) {
      vertices_.push_back(triple(vertex, "a vertex") * scale + translate);
      low = glm::min(low, vertices_.back()), high = glm::max(high, vertices_.back());
    }
    if (vertices_.empty()) return;
    // The middle of the place, in whole metres; heights stay as they are.
    origin_ = {std::round(0.5 * (low.x + high.x)), std::round(0.5 * (low.y + high.y)), 0.0};
    for (glm::dvec3& vertex : vertices_) vertex -= origin_;
  }

  void read_texture_vertices() {
    for (const Json& uv : member(member(json_, "appearance"), "vertices-texture"))
      texture_vertices_.emplace_back(uv.at(0).get<float>(),
                                     1.0f - uv.at(1).get<float>());  // ours run downward
  }

  // --- objects
  // ---------------------------------------------------------------------------------------------------------

  void read_object(const std::string& name, const Json& object) {
    name_ = &name;
    const Json& type = member(object, "type");
    type_ = type.is_string() ? type.get<std::string>() : "";
    const Json& function = member(member(object, "attributes"), "function");
    function_ = function.is_string() ? function.get<std::string>() : "";
    const Json* best = nullptr;
    for (const Json& geometry : member(object, "geometry"))
      if (!best || level_of_detail(geometry) > level_of_detail(*best)) best = &geometry;
    const std::size_t before = polygon_count_;
    if (best) read_geometry(*best);
    const bool has_parts = !member(object, "children").empty() || !member(object, "members").empty();
    if (polygon_count_ == before && !has_parts) warn(fmt::format("object \"{}\" has no polygons", name));
  }

  void read_geometry(const Json& geometry) {
    const std::string type = member(geometry, "type").is_string() ? geometry["type"].get<std::string>() : "";
    const Json& boundaries = member(geometry, "boundaries");
    const Json& semantics = member(geometry, "semantics");
    surfaces_ = &member(semantics, "surfaces");
    const Attached attached{&member(semantics, "values"),
                            &member(first_theme(member(geometry, "texture")), "values")};
    is_solid_ = type.find("Solid") != std::string::npos;
    if (type == "MultiSurface" || type == "CompositeSurface")
      read_surfaces(boundaries, attached);
    else if (type == "Solid")
      read_surfaces(element(boundaries, 0), attached.at(0));  // inner shells are cavities: nobody sees them
    else if (type == "MultiSolid" || type == "CompositeSolid")
      for (std::size_t i = 0; i < boundaries.size(); ++i)
        read_surfaces(element(boundaries[i], 0), attached.at(i).at(0));
    else
      warn(fmt::format("object \"{}\": geometry of type \"{}\" is passed over", *name_, type));
  }

  void read_surfaces(const Json& surfaces, const Attached& attached) {
    for (std::size_t i = 0; i < surfaces.size(); ++i) read_surface(element(surfaces, i), attached.at(i));
  }

  std::string semantics_of(const Json& value) const {
    if (!value.is_number_unsigned()) return "";
    const Json& type = member(element(*surfaces_, value.get<std::size_t>()), "type");
    return type.is_string() ? type.get<std::string>() : "";
  }

  std::vector<std::uint32_t> ring_indices(const Json& ring) const {
    if (!ring.is_array())
      fail("object \"{}\": a ring is {}; expected a list of vertices", *name_, ring.dump().substr(0, 40));
    std::vector<std::uint32_t> indices;
    for (const Json& value : ring) {
      if (!value.is_number_unsigned() || value.get<std::size_t>() >= vertices_.size())
        fail("object \"{}\": vertex {} is out of range; there are {}", *name_, value.dump(),
             vertices_.size());
      const std::uint32_t index = value.get<std::uint32_t>();
      if (indices.empty() || indices.back() != index) indices.push_back(index);
    }
    while (indices.size() > 1 && indices.front() == indices.back()) indices.pop_back();
    return indices;
  }

  void read_surface(const Json& surface, const Attached& attached) {
    if (!surface.is_array()) fail("object \"{}\": a surface is no list of rings", *name_);
    std::vector<std::vector<glm::dvec3>> rings;
    std::vector<std::uint32_t> corners;
    for (const Json& ring : surface) {
      const std::vector<std::uint32_t> indices = ring_indices(ring);
      if (indices.size() < 3) continue;
      std::vector<glm::dvec3> points;
      for (const std::uint32_t index : indices) points.push_back(vertices_[index]);
      corners.insert(corners.end(), indices.begin(), indices.end());
      rings.push_back(std::move(points));
    }
    if (rings.empty()) return;
    const glm::dvec3 area = newell_about_first(rings.front());
    if (glm::length(area) < 1e-9) return;  // a sliver
    glm::dvec3 normal = glm::normalize(area);
    const std::string name = surface_name(semantics_of(*attached.semantics), type_, float(normal.z));
    const bool turns_over = is_ground(name) && normal.z < 0.0;
    if (turns_over) normal = -normal;
    ++polygon_count_;

    std::vector<glm::dvec3> points;
    const std::vector<std::uint32_t> triangles = triangulated(rings, normal, points);
    const std::vector<glm::vec2> photo = photo_coordinates(*attached.texture, points.size());
    add_triangles(name, photo.empty() ? no_index : texture_index(*attached.texture), points, triangles, photo,
                  glm::vec3(normal), turns_over && rings.size() == 1 && points.size() == 3);
  }

  /// Newell's normal with the ring's first point as origin: far coordinates would cost it its digits.
  static glm::dvec3 newell_about_first(std::vector<glm::dvec3> ring) {
    const glm::dvec3 first = ring.front();
    for (glm::dvec3& point : ring) point -= first;
    return newell_normal(ring);
  }

  // --- photographs on walls
  // --------------------------------------------------------------------------------------------

  /// Texture coordinates of all points of a surface, or nothing where it has none.
  std::vector<glm::vec2> photo_coordinates(const Json& rings, std::size_t count) const {
    std::vector<glm::vec2> coordinates;
    for (const Json& ring : rings) {
      if (!ring.is_array() || !element(ring, 0).is_number_unsigned()) return {};
      for (std::size_t i = 1; i < ring.size(); ++i) {
        const Json& index = ring[i];
        if (!index.is_number_unsigned() || index.get<std::size_t>() >= texture_vertices_.size())
          fail("object \"{}\": texture vertex {} is out of range; there are {}", *name_, index.dump(),
               texture_vertices_.size());
        coordinates.push_back(texture_vertices_[index.get<std::size_t>()]);
      }
    }
    if (coordinates.size() != count) return {};
    return coordinates;
  }

  int texture_index(const Json& rings) const {
    const std::size_t index = rings[0][0].get<std::size_t>();
    const std::size_t count = member(member(json_, "appearance"), "textures").size();
    if (index >= count) fail("object \"{}\": texture {} is out of range; there are {}", *name_, index, count);
    return int(index);
  }

  // --- parts
  // -----------------------------------------------------------------------------------------------------------

  std::string object_name(const std::string& surface) const {
    return surface == "Road" && !function_.empty() ? surface + " " + function_ : surface;
  }

  /// Metres along the surface: u level, v down.
  static glm::vec2 plane_coordinates(glm::vec3 point, glm::vec3 normal) {
    if (std::abs(normal.z) > 0.99f) return {point.x, -point.y};
    const glm::vec3 level = glm::normalize(glm::vec3(-normal.y, normal.x, 0.0f));
    return {glm::dot(point, level), -glm::dot(point, glm::cross(normal, level))};
  }

  void add_triangles(const std::string& name, int photo, const std::vector<glm::dvec3>& points,
                     const std::vector<std::uint32_t>& triangles, const std::vector<glm::vec2>& photo_uv,
                     glm::vec3 normal, bool is_turned) {
    const glm::dvec3 place = points.front();
    const std::tuple key{name,
                         object_name(name),
                         photo,
                         is_solid_,
                         int(std::floor(place.x / tile_m)),
                         int(std::floor(place.y / tile_m))};
    Mesh& mesh = parts_[key];
    const std::uint32_t first = std::uint32_t(mesh.positions.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const glm::vec3 point(points[i]);
      mesh.positions.push_back(point);
      mesh.normals.push_back(normal);
      mesh.uvs.push_back(photo_uv.empty() ? plane_coordinates(point, normal) : photo_uv[i]);
    }
    for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
      const std::size_t second = is_turned ? 2 : 1;
      mesh.indices.insert(mesh.indices.end(), {first + triangles[i], first + triangles[i + second],
                                               first + triangles[i + 3 - second]});
    }
  }

  /// Corners of the terrain that fall together share one normal: a TIN is shaded as the smooth ground that it
  /// stands for.
  static void smooth(Mesh& mesh) {
    const auto less = [](glm::vec3 a, glm::vec3 b) {
      return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    };
    std::map<glm::vec3, glm::vec3, decltype(less)> sums(less);
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      const glm::vec3 a = mesh.positions[mesh.indices[i]], b = mesh.positions[mesh.indices[i + 1]],
                      c = mesh.positions[mesh.indices[i + 2]];
      for (const glm::vec3& corner : {a, b, c}) sums[corner] += glm::cross(b - a, c - a);
    }
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
      if (const auto sum = sums.find(mesh.positions[i]); sum != sums.end() && glm::length(sum->second) > 0.0f)
        mesh.normals[i] = glm::normalize(sum->second);
  }

  Model finished() {
    Model model;
    model.name = file_.stem().string();
    model.origin = origin_;
    model.nodes.front().name = model.name;
    read_photos(model);
    std::map<std::tuple<std::string, int, bool>, int> materials;
    for (auto& [key, mesh] : parts_) {
      const auto& [name, object, photo, is_solid, x, y] = key;
      const auto [material, is_new] =
          materials.try_emplace({name, photo, is_solid}, int(model.materials.size()));
      if (is_new) {
        model.materials.push_back(surface_material(name));
        model.materials.back().is_double_sided = !is_solid && !is_ground(name);
        model.materials.back().base_colour_texture = photo;
        if (photo != no_index) model.materials.back().base_colour = glm::vec3(1.0f);
      }
      if (name == "TINRelief") smooth(mesh);
      if (const Status status = check(mesh, name); !status) fail("{}", status.errors().front().message);
      model.parts.push_back({object, std::move(mesh), material->second, 0, true});
    }
    return model;
  }

  void read_photos(Model& model) {
    const Json& textures = member(member(json_, "appearance"), "textures");
    if (!textures.is_array()) return;
    const Roots roots(file_.parent_path());
    std::vector<Errors> problems(textures.size());
    model.textures.resize(textures.size());
    parallel_for(textures.size(), [&](std::size_t i) {
      const Json& image = member(textures[i], "image");
      Texture& texture = model.textures[i];
      texture.name = image.is_string() ? image.get<std::string>() : "";
      const Result<fs::path> path = roots.find(texture.name, {});
      Result<Image8> picture = path ? read_image8(*path) : Result<Image8>(path.errors());
      if (!picture) problems[i] = picture.errors();
      texture.image = picture ? *std::move(picture) : placeholder_picture();
    });
    for (const Errors& list : problems)
      for (const Error& problem : list) warn(problem.message + "; a checker stands for it");
  }

  void warn(const std::string& message) {
    constexpr std::size_t most = 20;
    if (++warning_count_ <= most) warnings_.push_back({message, {file_.string(), 0, 0}});
    if (warning_count_ == most + 1)
      warnings_.push_back({"more warnings of this kind are not told", {file_.string(), 0, 0}});
  }

  const fs::path& file_;
  const Json& json_;
  Errors& warnings_;
  std::size_t warning_count_ = 0;
  std::vector<glm::dvec3> vertices_;  ///< about the origin
  std::vector<glm::vec2> texture_vertices_;
  glm::dvec3 origin_{0.0};

  // of the object that is being read
  const std::string* name_ = nullptr;
  std::string type_, function_;
  const Json* surfaces_ = nullptr;
  bool is_solid_ = false;

  std::map<std::tuple<std::string, std::string, int, bool, int, int>, Mesh>
      parts_;  ///< by material, object, photograph, solid, tile
  std::size_t polygon_count_ = 0;
};

}  // namespace

Result<Model> read_city_model(const fs::path& file, Errors& warnings) {
  const FileLocation where{file.string(), 0, 0};
  const Result<std::string> text = read_file(file);
  if (!text) return text.errors();
  try {
    const Json json = Json::parse(*text);
    return Reader(file, json, warnings).read();
  } catch (const Problem& problem) {
    return Error{problem.message, where};
  } catch (const Json::exception& problem) {
    return error_at(where, "a value is not what CityJSON asks for ({})", problem.what());
  }
}

}  // namespace parvis::scene
