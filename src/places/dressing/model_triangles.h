// Moves triangles of a city model to other materials.
#pragma once

#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "scene/data/building_kind.h"
#include "scene/data/model.h"

namespace parvis::dressing {

/// Distance up to which two points of a file count as one.
inline constexpr float same_point_m = 0.02f;

/// A triangle taken out of a model.
struct ModelTriangle {
  std::array<glm::vec3, 3> corners;  ///< in the model's frame
  glm::vec3 normal{0.0f};            ///< unit
  int node = 0;
  std::array<glm::vec3, 3> corners_in_node;
  std::size_t building = 0;  ///< number of its building: equal for connected triangles
  std::size_t surface =
      0;  ///< number of its surface in the file: equal where triangles share points of a mesh
  scene::BuildingKind kind{};  ///< which the name of its part has words for
};

/// Removes the triangles that are wanted, by their part of the model and unit normal, from the parts that
/// match the pattern `target`, and numbers buildings and surfaces.
std::vector<ModelTriangle> take_triangles(
    scene::Model& model, std::string_view target,
    const std::function<bool(const scene::Part&, glm::vec3)>& is_wanted);

/// The part of a triangle where low <= dot(axis, point) <= high, as triangles; unit axis in the model's
/// frame.
std::vector<ModelTriangle> clipped(const std::vector<ModelTriangle>& triangles, glm::vec3 axis, float low,
                                   float high);

/// Adds triangles to a model as parts with one object name, one for each node and material.
class DressedParts {
 public:
  /// `model` must outlive this; `object` is the name of the parts.
  DressedParts(scene::Model& model, std::string object)
      : model_(model), object_(std::move(object)), model_from_node_(scene::rest_pose(model)) {}

  /// Adds a triangle with its texture coordinates to the part of its node and this material. It is flat.
  void add(const ModelTriangle& triangle, int material, const std::array<glm::vec2, 3>& uvs);
  /// The same with normals of its corners: unit, in the model's frame.
  void add(const ModelTriangle& triangle, int material, const std::array<glm::vec2, 3>& uvs,
           const std::array<glm::vec3, 3>& normals);

 private:
  void add_in_node(const ModelTriangle& triangle, int material, const std::array<glm::vec2, 3>& uvs,
                   const std::array<glm::vec3, 3>& normals);

  scene::Model& model_;
  std::string object_;
  std::vector<glm::mat4> model_from_node_;
  std::map<std::pair<int, int>, std::size_t> parts_;
};

/// Adds a texture and returns its index.
int add_texture(scene::Model& model, const std::string& name, Image8 image, bool is_srgb);

}  // namespace parvis::dressing
