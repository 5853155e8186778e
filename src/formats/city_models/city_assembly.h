// Assembles the polygons of a city model, given in the file's coordinates, into one model in metres about a
// local origin. Shared by CityJSON and CityGML.
#pragma once

#include <array>
#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "base/files.h"
#include "base/result.h"
#include "scene/data/building_kind.h"
#include "scene/data/model.h"

namespace parvis::scene {

/// The city object that a surface belongs to.
struct CityObject {
  std::string name;
  std::string type;     ///< "Building", "Road", "+Extension"; CityJSON's names
  std::string use;      ///< function of a road ("voetpad"), species of a tree ("Quercus robur"), or empty
  BuildingKind kind{};  ///< of a building
};

/// One polygon of a city object.
struct CitySurface {
  std::vector<std::vector<glm::dvec3>> rings;  ///< the outer one, then holes; m, x east, y north, z up
  std::string semantics;                       ///< semantic surface type, "RoofSurface"; may be empty
  int material = no_index;                     ///< index from add_material()
  int picture = no_index;                      ///< index from add_picture()
  /// Texture coordinates of all points, ring by ring, v downward; empty: untextured.
  std::vector<glm::vec2> picture_uv;
  /// Normals of all points, ring by ring, of a facet of a curved surface; empty: it is flat.
  std::vector<glm::vec3> normals{};
  bool is_of_solid = false;  ///< part of a closed solid: its back is never visible
  /// The finish of a roof ("metal") that shall keep its own material; it stands in the names of its object
  /// and material ("RoofSurface metal"), so that a node that tiles "RoofSurface" leaves it alone. May be
  /// empty.
  std::string finish{};
};

/// A material as city formats describe it, after X3D.
struct CityMaterial {
  glm::vec3 diffuse{0.8f};   ///< sRGB, 0..1
  glm::vec3 emissive{0.0f};  ///< sRGB, 0..1
  float transparency = 0.0f;
  std::optional<float> shininess;  ///< 0..1
};

/// Where a picture of a city file lies below the file's folder: where the file says, else in one of the
/// folders in which towns put pictures, beside it.
Result<std::filesystem::path> city_picture_path(const Roots& roots, const std::string& name);

/// Collects surfaces, materials and textures of one city file; `finish` builds the model.
class CityAssembly {
 public:
  /// `origin`: the point in the file's coordinates that becomes the model's (0, 0, 0). `warnings` must
  /// outlive the assembly.
  CityAssembly(const std::filesystem::path& file, const glm::dvec3& origin, Errors& warnings)
      : file_(file), origin_(origin), warnings_(warnings) {}

  /// Index of the material; equal materials get the same index.
  int add_material(const CityMaterial& material);
  /// Index of a texture; `file` lies beside the city's file or below its folder, or in a folder "appearances"
  /// or "textures" beside it.
  int add_picture(const std::string& file, bool repeats);
  /// Triangulates and adds a surface. Slivers are dropped; ground surfaces that belong to no solid are turned
  /// to face upward. A surface too far from the origin is left out with a warning.
  void add(const CityObject& object, const CitySurface& surface);

  /// Number of surfaces added, without those left out.
  std::size_t polygon_count() const { return polygon_count_; }
  /// Records a warning about the file, once where it is the same. After the first 20 that differ in names and
  /// figures alone, and the first 200 in all, it says that there are more.
  void warn(const std::string& message);

  /// Builds the model: parts by tile, name and material. Objects and materials are named after their surfaces
  /// ("WallSurface"), with their finish where they have one; roads' objects add their function,
  /// trees' objects their species, walls' objects the words of their building's kind. A missing texture is a
  /// warning, and its surfaces are plain. Errors: no polygon at all (in `object_count` objects), or a
  /// coordinate that is not finite.
  Result<Model> finish(std::size_t object_count);

 private:
  /// A part's key: name of the surface, object, material, picture, solid, tile.
  using PartKey = std::tuple<std::string, std::string, int, int, bool, int, int>;

  void add_triangles(const PartKey& key, const CitySurface& surface, const std::vector<glm::dvec3>& points,
                     const std::vector<std::uint32_t>& triangles, glm::vec3 normal);
  Material material_of(const PartKey& key) const;
  void warn_of_implausible_counts();
  bool is_in_degrees() const;
  void read_pictures(Model& model);

  std::filesystem::path file_;
  glm::dvec3 origin_;
  Errors& warnings_;
  std::size_t warning_count_ = 0;
  std::map<std::string, std::size_t> warnings_of_kind_;
  std::size_t polygon_count_ = 0;
  std::map<std::string, std::size_t> polygons_of_;  ///< by the kind of the surface
  std::size_t finished_roofs_ = 0;                  ///< of these, roofs that have a finish
  std::vector<CityMaterial> materials_;
  std::map<std::array<float, 8>, int> known_materials_;
  std::vector<Texture> pictures_;
  std::vector<bool> is_missing_;  ///< of each picture, once they are read
  std::map<PartKey, Mesh> parts_;
};

}  // namespace parvis::scene
