#include "places/paper_city/model_triangles.h"

#include <cmath>
#include <numeric>

#include "scene/data/model_parts.h"

namespace parvis::city {
namespace {

constexpr float same_point_m = 0.02f;

/// Triangles that share a corner belong together.
void number_buildings(std::vector<ModelTriangle>& triangles) {
  std::vector<std::size_t> parents(triangles.size());
  std::iota(parents.begin(), parents.end(), std::size_t(0));
  const auto root = [&](std::size_t i) {
    while (parents[i] != i) i = parents[i] = parents[parents[i]];
    return i;
  };
  std::map<std::array<int, 3>, std::size_t> triangle_at;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (const glm::vec3& corner : triangles[i].corners) {
      const glm::ivec3 key(glm::round(corner / same_point_m));
      const auto [known, is_new] = triangle_at.try_emplace({key.x, key.y, key.z}, i);
      if (!is_new) parents[root(i)] = root(known->second);
    }
  for (std::size_t i = 0; i < triangles.size(); ++i) triangles[i].building = root(i);
}

}  // namespace

std::vector<ModelTriangle> take_triangles(scene::Model& model, std::string_view target,
                                          const std::function<bool(glm::vec3 normal)>& is_wanted) {
  const std::vector<glm::mat4> model_from_node = scene::rest_pose(model);
  std::vector<ModelTriangle> taken;
  for (const std::size_t index : scene::matching_parts(model, target)) {
    scene::Part& part = model.parts[index];
    std::vector<std::uint32_t> kept;
    for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3) {
      ModelTriangle triangle;
      triangle.node = part.node;
      for (std::size_t k = 0; k < 3; ++k) {
        triangle.corners_in_node[k] = part.mesh.positions[part.mesh.indices[i + k]];
        triangle.corners[k] =
            glm::vec3(model_from_node[std::size_t(part.node)] * glm::vec4(triangle.corners_in_node[k], 1.0f));
      }
      const glm::vec3 area =
          glm::cross(triangle.corners[1] - triangle.corners[0], triangle.corners[2] - triangle.corners[0]);
      const float length = glm::length(area);
      if (length > 1e-8f && is_wanted(area / length)) {
        triangle.normal = area / length;
        taken.push_back(triangle);
      } else {
        kept.insert(kept.end(), part.mesh.indices.begin() + std::ptrdiff_t(i),
                    part.mesh.indices.begin() + std::ptrdiff_t(i) + 3);
      }
    }
    part.mesh.indices = std::move(kept);
  }
  std::erase_if(model.parts, [](const scene::Part& part) { return part.mesh.indices.empty(); });
  number_buildings(taken);
  return taken;
}

void DressedParts::add(const ModelTriangle& triangle, int material, const std::array<glm::vec2, 3>& uvs) {
  const auto [known, is_new] = parts_.try_emplace({triangle.node, material}, model_.parts.size());
  if (is_new) {
    scene::Part part;
    part.object = object_, part.node = triangle.node, part.material = material;
    model_.parts.push_back(std::move(part));
  }
  Mesh& mesh = model_.parts[known->second].mesh;
  const std::array<glm::vec3, 3>& corners = triangle.corners_in_node;
  const glm::vec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
  for (std::size_t k = 0; k < 3; ++k) {
    mesh.indices.push_back(std::uint32_t(mesh.positions.size()));
    mesh.positions.push_back(corners[k]), mesh.normals.push_back(normal), mesh.uvs.push_back(uvs[k]);
  }
}

int add_texture(scene::Model& model, const std::string& name, Image8 image, bool is_srgb) {
  scene::Texture texture;
  texture.name = name, texture.image = std::move(image), texture.is_srgb = is_srgb;
  model.textures.push_back(std::move(texture));
  return int(model.textures.size()) - 1;
}

}  // namespace parvis::city
