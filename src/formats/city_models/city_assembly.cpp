#include "formats/city_models/city_assembly.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/colour.h"
#include "base/files.h"
#include "base/image_io.h"
#include "base/parallel.h"
#include "formats/city_models/polygon_crossings.h"
#include "formats/city_models/polygon_triangles.h"
#include "formats/readers/packed_file.h"
#include "land/heights/city_surfaces.h"
#include "scene/data/placeholder.h"

namespace parvis::scene {
namespace {

constexpr double tile_m = 60.0;            // parts of this size are culled one by one
constexpr double smallest_area_m2 = 1e-9;  // below it a ring has no direction
constexpr double farthest_m = 1e7;         // of a surface from the origin: no place on earth is as wide
constexpr std::size_t max_warnings_of_a_kind = 20, max_warnings = 200;
constexpr std::size_t max_named_pictures = 3;  // missing ones; the others are counted
/// Folders beside the file in which towns put pictures that the file names without a folder.
constexpr std::array<const char*, 2> picture_folders{"appearances", "textures"};

/// The message without figures and names, which is the same for any object.
std::string kind_of_warning(const std::string& message) {
  std::string kind;
  bool is_name = false;
  for (const char c : message) {
    if (c == '"') is_name = !is_name;
    if (!is_name && (c < '0' || c > '9')) kind += c;
  }
  return kind;
}

/// Newell's normal with the ring's first point as origin: far coordinates would cost it its digits.
glm::dvec3 newell_about_first(std::vector<glm::dvec3> ring) {
  const glm::dvec3 first = ring.front();
  for (glm::dvec3& point : ring) point -= first;
  return newell_normal(ring);
}

/// Metres along the surface: u level, v down.
glm::vec2 plane_coordinates(glm::vec3 point, glm::vec3 normal) {
  if (std::abs(normal.z) > 0.99f) return {point.x, -point.y};
  const glm::vec3 level = glm::normalize(glm::vec3(-normal.y, normal.x, 0.0f));
  return {glm::dot(point, level), -glm::dot(point, glm::cross(normal, level))};
}

/// Corners of the terrain that fall together share one normal: a TIN is shaded as the smooth ground that it
/// stands for.
void smooth(Mesh& mesh) {
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

/// X3D's exponent is 128 times the shininess; the Blinn lobe of exponent n has GGX's width sqrt(2 / (n + 2)),
/// of which glTF's roughness is the root (Walter et al. 2007).
float roughness_of(float shininess) {
  return std::pow(2.0f / (128.0f * std::clamp(shininess, 0.0f, 1.0f) + 2.0f), 0.25f);
}

glm::vec3 linear(glm::vec3 srgb) { return linear_from_srgb(glm::clamp(srgb, 0.0f, 1.0f)); }

/// The words that stand beside the name of such objects.
std::string words_for(const std::string& name, const CityObject& object) {
  if (name == "Road" || name == "SolitaryVegetationObject") return object.use;
  return name == "WallSurface" ? words_of(object.kind) : "";
}

bool reaches_too_far(const std::vector<std::vector<glm::dvec3>>& rings) {
  return std::ranges::any_of(rings, [](const std::vector<glm::dvec3>& ring) {
    return std::ranges::any_of(ring, [](glm::dvec3 p) {
      return !(std::abs(p.x) < farthest_m && std::abs(p.y) < farthest_m && std::abs(p.z) < farthest_m);
    });
  });
}

}  // namespace

Result<std::filesystem::path> city_picture_path(const Roots& roots, const std::string& name) {
  Result<std::filesystem::path> path = roots.find(name, {});
  for (const char* folder : picture_folders) {
    if (path) break;
    if (Result<std::filesystem::path> there = roots.find(std::string(folder) + "/" + name, {})) return there;
  }
  return path;
}

int CityAssembly::add_material(const CityMaterial& m) {
  const std::array<float, 8> key{m.diffuse.x,  m.diffuse.y,  m.diffuse.z,    m.emissive.x,
                                 m.emissive.y, m.emissive.z, m.transparency, m.shininess.value_or(-1.0f)};
  const auto [known, is_new] = known_materials_.try_emplace(key, int(materials_.size()));
  if (is_new) materials_.push_back(m);
  return known->second;
}

int CityAssembly::add_picture(const std::string& file, bool repeats) {
  pictures_.push_back({.name = file, .image = {}});
  pictures_.back().set_repeats(repeats);
  return int(pictures_.size()) - 1;
}

void CityAssembly::warn(const std::string& message) {
  const FileLocation where{file_.string(), 0, 0};
  const auto is_same = [&](const Error& warning) { return warning.message == message; };
  if (std::ranges::any_of(warnings_, is_same)) return;
  const std::size_t of_kind = ++warnings_of_kind_[kind_of_warning(message)];
  if (of_kind > max_warnings_of_a_kind + 1 || ++warning_count_ > max_warnings + 1) return;
  if (warning_count_ == max_warnings + 1)
    warnings_.push_back({"more warnings are not shown", where});
  else if (of_kind <= max_warnings_of_a_kind)
    warnings_.push_back({message, where});
  else
    warnings_.push_back({"more warnings of this kind are not shown", where});
}

void CityAssembly::add(const CityObject& object, const CitySurface& surface) {
  std::vector<std::vector<glm::dvec3>> rings = surface.rings;
  for (std::vector<glm::dvec3>& ring : rings)
    for (glm::dvec3& point : ring) point -= origin_;
  if (rings.empty() || rings.front().size() < 3) return;
  if (reaches_too_far(rings))
    return warn(
        fmt::format("a surface of {} reaches {:.0f} km from the place's origin or farther; it is left out",
                    object.name, farthest_m / 1000.0));
  const glm::dvec3 area = newell_about_first(rings.front());
  if (!(glm::length(area) > smallest_area_m2)) return;
  glm::dvec3 normal = glm::normalize(area);
  const std::string kind = surface_name(surface.semantics, object.type, float(normal.z));
  const bool turns_over = is_ground(kind) && normal.z < 0.0 && !surface.is_of_solid;
  if (turns_over) normal = -normal;
  if (!can_be_triangulated(rings, normal))
    return warn(fmt::format(
        "a surface of {} ({} holes) crosses or covers itself more than {} times, or its holes are too many "
        "to be cut out; it is left out",
        object.name, rings.size() - 1, max_edge_crossings));
  ++polygon_count_, ++polygons_of_[kind];
  if (!surface.finish.empty()) ++finished_roofs_;

  std::vector<glm::dvec3> points;
  std::vector<std::uint32_t> triangles = triangulated(rings, normal, points);
  if (turns_over && rings.size() == 1 && points.size() == 3) std::swap(triangles[1], triangles[2]);
  const bool is_pictured = surface.picture != no_index && surface.picture_uv.size() == points.size();
  const std::string words = words_for(kind, object);
  const std::string name = surface.finish.empty() ? kind : kind + " " + surface.finish;
  const PartKey key{name,
                    words.empty() ? name : name + " " + words,
                    surface.material,
                    is_pictured ? surface.picture : no_index,
                    surface.is_of_solid,
                    int(std::floor(points.front().x / tile_m)),
                    int(std::floor(points.front().y / tile_m))};
  add_triangles(key, surface, points, triangles, glm::vec3(normal));
}

void CityAssembly::add_triangles(const PartKey& key, const CitySurface& surface,
                                 const std::vector<glm::dvec3>& points,
                                 const std::vector<std::uint32_t>& triangles, glm::vec3 normal) {
  const bool is_pictured = std::get<3>(key) != no_index, is_curved = surface.normals.size() == points.size();
  Mesh& mesh = parts_[key];
  const std::uint32_t first = std::uint32_t(mesh.positions.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::vec3 point(points[i]);
    mesh.positions.push_back(point);
    mesh.normals.push_back(is_curved ? surface.normals[i] : normal);
    mesh.uvs.push_back(is_pictured ? surface.picture_uv[i] : plane_coordinates(point, normal));
  }
  for (const std::uint32_t index : triangles) mesh.indices.push_back(first + index);
}

Material CityAssembly::material_of(const PartKey& key) const {
  const auto& [name, object, given, picture, is_solid, x, y] = key;
  Material material = surface_material(name.substr(0, name.find(' ')));  // without the finish
  material.name = name;
  material.is_double_sided = !is_solid && !is_ground(name);
  if (given != no_index) {
    const CityMaterial& own = materials_[std::size_t(given)];
    material.base_colour = linear(own.diffuse);
    material.emission = linear(own.emissive);
    if (own.shininess) material.roughness = roughness_of(*own.shininess);
    material.alpha = 1.0f - std::clamp(own.transparency, 0.0f, 1.0f);
    if (material.alpha < 1.0f) material.alpha_mode = Alpha::blend;
  }
  // Without its picture a surface is what its file says of shapes alone, and can be dressed as such.
  if (picture == no_index || is_missing_[std::size_t(picture)]) return material;
  material.base_colour_texture = picture;
  material.base_colour = glm::vec3(1.0f);
  return material;
}

void CityAssembly::read_pictures(Model& model) {
  const Roots roots(file_.parent_path());
  std::vector<Errors> problems(pictures_.size());
  parallel_for(pictures_.size(), [&](std::size_t i) {
    const Result<std::filesystem::path> path = city_picture_path(roots, pictures_[i].name);
    Result<Image8> picture = path ? read_image8(*path) : Result<Image8>(path.errors());
    if (!picture) problems[i] = picture.errors();
    pictures_[i].image = picture ? *std::move(picture) : placeholder_picture();
  });
  std::size_t missing = 0;
  for (const Errors& list : problems) is_missing_.push_back(!list.empty());
  for (const Errors& list : problems) {
    if (!list.empty() && ++missing > max_named_pictures) continue;
    for (const Error& problem : list) warn(problem.message + "; its surfaces are plain");
  }
  if (missing > max_named_pictures)
    warn(
        fmt::format("{} pictures more of {} are missing, too: put them beside the file, or into a folder "
                    "\"{}\" beside it",
                    missing - max_named_pictures, pictures_.size(), picture_folders.front()));
  model.textures = std::move(pictures_);
}

/// Warns of many roofs without walls, or walls without roofs: the file was read in part, or holds only half
/// of its surfaces.
void CityAssembly::warn_of_implausible_counts() {
  constexpr std::size_t enough = 20;  // surfaces that make a place
  const auto count = [&](const char* name) {
    const auto found = polygons_of_.find(name);
    return found == polygons_of_.end() ? 0 : found->second;
  };
  const auto expect = [&](std::size_t found, const char* there, const char* missing) {
    if (found >= enough && count(missing) == 0)
      warn(fmt::format(
          "{} polygons are a {}, none is a {}; expected both, as houses have roofs and walls: choose another "
          "level of detail with lod, or name the surfaces' kinds in the file",
          found, there, missing));
  };
  expect(count("RoofSurface") - finished_roofs_, "RoofSurface", "WallSurface");  // canopies have no walls
  expect(count("WallSurface"), "WallSurface", "RoofSurface");
}

/// Houses higher than the place is wide: their plan is in degrees.
bool CityAssembly::is_in_degrees() const {
  constexpr float narrow_m = 1.0f, high_m = 2.0f;
  Bounds bounds;
  for (const auto& [key, mesh] : parts_) bounds.add(mesh.bounds());
  const glm::vec3 size = bounds.size();
  const bool has_houses = polygons_of_.contains("WallSurface") || polygons_of_.contains("RoofSurface");
  return has_houses && std::max(size.x, size.y) < narrow_m && size.z > high_m;
}

Result<Model> CityAssembly::finish(std::size_t object_count) {
  const FileLocation where{file_.string(), 0, 0};
  if (parts_.empty() && !warnings_.empty())
    return error_at(where, "none of the {} city objects has polygons: {}", object_count,
                    warnings_.front().message);
  if (parts_.empty()) return error_at(where, "none of the {} city objects has polygons", object_count);
  if (is_in_degrees())
    return error_at(
        where,
        "its houses are higher than the whole place is wide: its coordinates seem to be degrees of "
        "longitude and latitude. Convert it to metres, with cjio or citygml-tools, say");
  warn_of_implausible_counts();
  Model model;
  model.name = formats::model_stem(file_);
  model.origin = origin_;
  model.nodes.front().name = model.name;
  read_pictures(model);
  std::map<std::tuple<std::string, int, int, bool>, int> materials;
  for (auto& [key, mesh] : parts_) {
    const auto& [name, object, given, picture, is_solid, x, y] = key;
    const auto [material, is_new] =
        materials.try_emplace({name, given, picture, is_solid}, int(model.materials.size()));
    if (is_new) model.materials.push_back(material_of(key));
    if (name == "TINRelief") smooth(mesh);
    if (const Status status = check(mesh, name); !status)
      return Error{status.errors().front().message, where};
    model.parts.push_back({object, std::move(mesh), material->second, 0, true});
  }
  return model;
}

}  // namespace parvis::scene
