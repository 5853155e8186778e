// Small places for the tests of all rooms: quads, boxes and spheres with one material each.
#pragma once

#include <cmath>
#include <memory>

#include "scene/data/scene.h"

namespace parvis::scene {

inline Mesh quad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d) {
  Mesh mesh;
  mesh.positions = {a, b, c, d};
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  mesh.normals.assign(4, glm::normalize(glm::cross(b - a, c - a)));
  return mesh;
}

/// A level square of ground about the origin.
inline Mesh ground(float half_m) {
  return quad({-half_m, -half_m, 0}, {half_m, -half_m, 0}, {half_m, half_m, 0}, {-half_m, half_m, 0});
}

inline Mesh box(glm::vec3 low, glm::vec3 high) {
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.0f, 1.0f}) {
      glm::vec3 normal(0.0f), u(0.0f);
      normal[axis] = side;
      u[(axis + 1) % 3] = 1.0f;
      const glm::vec3 v = glm::cross(normal, u), centre = 0.5f * (low + high), half = 0.5f * (high - low);
      append(mesh, quad(centre + half * (normal - u - v), centre + half * (normal + u - v),
                        centre + half * (normal + u + v), centre + half * (normal - u + v)));
    }
  return mesh;
}

inline Mesh sphere(glm::vec3 centre, float radius, int rings = 32) {
  Mesh mesh;
  for (int i = 0; i <= rings; ++i)
    for (int j = 0; j <= 2 * rings; ++j) {
      const float polar = 3.14159265f * float(i) / float(rings), turn = 3.14159265f * float(j) / float(rings);
      const glm::vec3 n(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar));
      mesh.positions.push_back(centre + radius * n);
      mesh.normals.push_back(n);
      mesh.uvs.push_back({float(j) / float(2 * rings), float(i) / float(rings)});
    }
  const auto vertex = [&](int i, int j) { return std::uint32_t(i * (2 * rings + 1) + j); };
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < 2 * rings; ++j)
      for (const std::uint32_t v : {vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j),
                                    vertex(i + 1, j + 1), vertex(i, j + 1)})
        mesh.indices.push_back(v);
  return mesh;
}

/// A torus about the z axis: a tube of radius `tube` round a circle of radius `ring`; as finely made as a
/// sphere of so many rings.
inline Mesh torus(float ring, float tube, int rings = 32) {
  Mesh mesh = sphere(glm::vec3(0.0f), 1.0f, rings);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const float turn = 6.28318531f * mesh.uvs[i].x, around = 6.28318531f * mesh.uvs[i].y;
    const glm::vec3 out(std::cos(turn), std::sin(turn), 0.0f);
    mesh.normals[i] = std::sin(around) * out + glm::vec3(0, 0, std::cos(around));
    mesh.positions[i] = ring * out + tube * mesh.normals[i];
  }
  return mesh;
}

inline Material matt(glm::vec3 colour) {
  Material material;
  material.base_colour = colour;
  material.roughness = 1.0f;
  return material;
}

inline std::shared_ptr<Model> model_of(Mesh mesh, const Material& material) {
  auto model = std::make_shared<Model>();
  model->materials.push_back(material);
  model->parts.push_back({"part", std::move(mesh), 0, 0, true});
  return model;
}

/// Area of the parts of this name.
inline double area_m2(const Model& model, const std::string& name) {
  double sum = 0.0;
  for (const Part& part : model.parts)
    for (std::size_t i = 0; part.object == name && i + 2 < part.mesh.indices.size(); i += 3) {
      const auto at = [&](std::size_t k) { return part.mesh.positions[part.mesh.indices[i + k]]; };
      sum += 0.5 * double(glm::length(glm::cross(at(1) - at(0), at(2) - at(0))));
    }
  return sum;
}

/// Adds an object; returns its index.
inline int add(Scene& scene, std::shared_ptr<const Model> model, bool moves = false,
               const glm::mat4& world_from_model = glm::mat4(1.0f)) {
  Object object;
  object.model = std::move(model);
  object.world_from_model = world_from_model;
  object.is_dynamic = moves;
  scene.objects.push_back(std::move(object));
  return int(scene.objects.size()) - 1;
}

}  // namespace parvis::scene
