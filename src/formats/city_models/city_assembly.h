// A city as one model: polygons of any city format, in the file's own coordinates, become parts in metres
// about a local origin. CityJSON and CityGML share it.
#pragma once

#include <array>
#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "base/result.h"
#include "scene/data/model.h"

namespace parvis::scene {

/// What a surface belongs to.
struct CityObject {
  std::string name;
  std::string type;  ///< "Building", "Road", "+Extension"; CityJSON's names
  std::string use;   ///< what a road is for ("voetpad"), or empty
};

/// One polygon.
struct CitySurface {
  std::vector<std::vector<glm::dvec3>> rings;  ///< the outer one, then holes; m, x east, y north, z up
  std::string semantics;                       ///< "RoofSurface", or empty
  int material = no_index;                     ///< of add_material()
  int picture = no_index;                      ///< of add_picture()
  std::vector<glm::vec2> picture_uv;  ///< of all points, ring after ring, v downward; empty: not pictured
  bool is_of_solid = false;           ///< its back is never seen
};

/// A material as city formats give it, after X3D.
struct CityMaterial {
  glm::vec3 diffuse{0.8f};   ///< sRGB, 0..1
  glm::vec3 emissive{0.0f};  ///< sRGB, 0..1
  float transparency = 0.0f;
  std::optional<float> shininess;  ///< 0..1
};

class CityAssembly {
 public:
  /// `origin`: the file's coordinates of what becomes the model's (0, 0, 0).
  CityAssembly(const std::filesystem::path& file, const glm::dvec3& origin, Errors& warnings)
      : file_(file), origin_(origin), warnings_(warnings) {}

  /// Materials that look alike are one.
  int add_material(const CityMaterial& material);
  /// A picture file beside the city's, or below its folder.
  int add_picture(const std::string& file, bool repeats);
  /// Slivers are dropped. Grounds that are no solids are turned to face up.
  void add(const CityObject& object, const CitySurface& surface);

  std::size_t polygon_count() const { return polygon_count_; }
  /// The first 20 are kept.
  void warn(const std::string& message);

  /// Parts by tile, name and material. Objects and materials are named after their surfaces ("WallSurface");
  /// roads' objects add their use. A missing picture is a warning, and a checker stands for it. An error
  /// where there is no polygon at all (`object_count` objects were looked at), or a coordinate is not finite.
  Result<Model> finish(std::size_t object_count);

 private:
  /// By name of the surface, object, material, picture, solid, tile.
  using PartKey = std::tuple<std::string, std::string, int, int, bool, int, int>;

  void add_triangles(const PartKey& key, const CitySurface& surface, const std::vector<glm::dvec3>& points,
                     const std::vector<std::uint32_t>& triangles, glm::vec3 normal);
  Material material_of(const PartKey& key) const;
  void warn_of_implausible_counts();
  void read_pictures(Model& model);

  std::filesystem::path file_;
  glm::dvec3 origin_;
  Errors& warnings_;
  std::size_t warning_count_ = 0;
  std::size_t polygon_count_ = 0;
  std::map<std::string, std::size_t> polygons_of_;  ///< by the name of the surface
  std::vector<CityMaterial> materials_;
  std::map<std::array<float, 8>, int> known_materials_;
  std::vector<Texture> pictures_;
  std::map<PartKey, Mesh> parts_;
};

}  // namespace parvis::scene
