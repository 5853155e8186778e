// The coarse model that layers are made of: named objects, their planar faces ("polygons" in the thesis) and
// triangles.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "base/mesh.h"
#include "base/result.h"

namespace parvis::facades {

/// A named mesh of the model's file, in world coordinates.
struct NamedMesh {
  std::string name;
  Mesh mesh;
};

/// Name of the object that stands for all that is far away: sky, hills, other streets. It hides nothing, no
/// hidden part of it is ever wanted, and it casts no shadow.
inline constexpr const char* backdrop_name = "backdrop";

/// Faces of an object beyond which it is dense.
inline constexpr std::uint32_t max_faces_in_layers = 400;

/// A triangle of the coarse model, with the object and face that it belongs to.
struct LayerTriangle {
  std::array<glm::dvec3, 3> corners;  ///< in world
  std::uint32_t object = 0;           ///< into LayerModel::objects
  std::uint32_t face = 0;             ///< of the model: coplanar triangles of an object that share edges
  std::uint32_t source = 0;           ///< the triangle before any cut; pieces of one triangle share it
};

/// Axes of a triangle's plane: `v` is upright where the plane is a wall, and u, v and `normal` right-handed.
struct PlaneFrame {
  glm::dvec3 origin, u, v, normal;
};
/// The frame of a triangle's plane, at its first corner.
PlaneFrame frame_of(const LayerTriangle& triangle);

/// A named object of the coarse model.
struct LayerObject {
  std::string name;
  /// Bounds a body, with triangles counter-clockwise seen from outside: its back faces are never seen. Other
  /// objects are seen from both sides.
  bool is_closed = false;
  bool is_backdrop = false;  ///< see backdrop_name
  /// An object of more faces than are worth a layer each (a scan, a relief) is one layer of its nearest
  /// surface in each pixel; the parts that it hides of itself are known by depth.
  bool is_dense = false;
};

/// The coarse model as triangles of named objects, the input of visibility layers.
struct LayerModel {
  std::vector<LayerObject> objects;
  std::vector<LayerTriangle> triangles;
  std::uint32_t face_count = 0;
  std::uint32_t source_count = 0;  ///< triangles before any cut

  double size() const;  ///< length of the diagonal of the bounds
};

/// The model, and a note of each thing left out of it.
struct LayerModelResult {
  LayerModel model;
  Errors warnings;  ///< an entry for each object with triangles that are degenerate or lie twice in the model
};

/// Joins `meshes` into a model. Degenerate triangles and exact duplicates (the same three positions, in this
/// or another object) are left out and reported. Fails where no triangle remains, or where an index or a
/// position is invalid.
Result<LayerModelResult> layer_model(const std::vector<NamedMesh>& meshes);

}  // namespace parvis::facades
