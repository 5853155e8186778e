// Collects the triangles of the city by group and material, so that groups outside the view are culled as a
// whole.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "places/paper_city/city_material.h"
#include "scene/data/model.h"

namespace parvis::city {

/// A corner of a face.
struct Corner {
  glm::vec3 position{0.0f};
  glm::vec2 uv{0.0f};
};

/// Triangles of the city under construction.
class CityMesh {
 public:
  /// Starts a group: subsequent triangles belong to it.
  void begin_group(std::string name) { group_ = std::move(name); }

  /// Adds a triangle, counter-clockwise seen from outside, with a flat normal.
  void triangle(CityMaterial material, const Corner& a, const Corner& b, const Corner& c);
  /// Adds a planar quad in the same way, as two triangles.
  void quad(CityMaterial material, const Corner& a, const Corner& b, const Corner& c, const Corner& d);
  /// Adds a quad whose corner `a` has texture coordinates `foot`, and the opposite corner `c` has `top`.
  void quad(CityMaterial material, glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d, glm::vec2 foot,
            glm::vec2 top);

  std::size_t triangle_count() const { return triangles_; }  ///< of all groups
  /// Moves all meshes into parts of `model`, named "group material", on node 0.
  void move_into(scene::Model& model);

 private:
  void face(CityMaterial material, std::initializer_list<Corner> corners);

  std::string group_;
  std::map<std::pair<std::string, CityMaterial>, Mesh> meshes_;
  std::size_t triangles_ = 0;
};

}  // namespace parvis::city
