#include "places/dressing/model_triangles.h"

#include <algorithm>
#include <cmath>

#include "base/cut_polygon.h"
#include "base/disjoint_sets.h"
#include "scene/data/model_parts.h"

namespace parvis::dressing {
namespace {

/// Triangles that share a corner belong together.
void number_buildings(std::vector<ModelTriangle>& triangles) {
  TrianglesAtCorners joined(same_point_m);
  for (const ModelTriangle& triangle : triangles) joined.add(triangle.corners);
  for (std::size_t i = 0; i < triangles.size(); ++i) triangles[i].building = joined.root(i);
}

/// A point of a polygon under the knife, in both frames.
struct CutPoint {
  glm::vec3 in_model, in_node;
};

/// Unit normal in the triangle's node.
glm::vec3 flat_in_node(const ModelTriangle& triangle) {
  const std::array<glm::vec3, 3>& corners = triangle.corners_in_node;
  return glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
}

CutPoint mix(const CutPoint& a, const CutPoint& b, float weight) {
  return {glm::mix(a.in_model, b.in_model, weight), glm::mix(a.in_node, b.in_node, weight)};
}

}  // namespace

std::vector<ModelTriangle> take_triangles(
    scene::Model& model, std::string_view target,
    const std::function<bool(const scene::Part&, glm::vec3)>& is_wanted) {
  const std::vector<glm::mat4> model_from_node = scene::rest_pose(model);
  std::vector<ModelTriangle> taken;
  std::size_t points_before = 0;
  for (const std::size_t index : scene::matching_parts(model, target)) {
    scene::Part& part = model.parts[index];
    DisjointSets points(part.mesh.positions.size());
    const std::size_t first = taken.size();
    std::vector<std::uint32_t> kept;
    const bool is_city_wall = part.object.starts_with("WallSurface ");  // other names may say anything
    const scene::BuildingKind kind = is_city_wall ? scene::kind_of_words(part.object) : scene::BuildingKind{};
    for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3) {
      ModelTriangle triangle;
      triangle.node = part.node, triangle.kind = kind;
      for (std::size_t k = 0; k < 3; ++k) {
        triangle.corners_in_node[k] = part.mesh.positions[part.mesh.indices[i + k]];
        triangle.corners[k] =
            glm::vec3(model_from_node[std::size_t(part.node)] * glm::vec4(triangle.corners_in_node[k], 1.0f));
      }
      const glm::vec3 area =
          glm::cross(triangle.corners[1] - triangle.corners[0], triangle.corners[2] - triangle.corners[0]);
      const float length = glm::length(area);
      if (length > 1e-8f && is_wanted(part, area / length)) {
        triangle.normal = area / length;
        triangle.surface = part.mesh.indices[i];
        for (std::size_t k = 1; k < 3; ++k) points.join(part.mesh.indices[i + k], part.mesh.indices[i]);
        taken.push_back(triangle);
      } else {
        kept.insert(kept.end(), part.mesh.indices.begin() + std::ptrdiff_t(i),
                    part.mesh.indices.begin() + std::ptrdiff_t(i) + 3);
      }
    }
    part.mesh.indices = std::move(kept);
    for (std::size_t i = first; i < taken.size(); ++i)
      taken[i].surface = points_before + points.root(taken[i].surface);
    points_before += part.mesh.positions.size();
  }
  std::erase_if(model.parts, [](const scene::Part& part) { return part.mesh.indices.empty(); });
  number_buildings(taken);
  return taken;
}

std::vector<ModelTriangle> clipped(const std::vector<ModelTriangle>& triangles, glm::vec3 axis, float low,
                                   float high) {
  constexpr float smallest_m2 = 1e-5f;
  std::vector<ModelTriangle> result;
  for (const ModelTriangle& triangle : triangles) {
    const bool is_inside = std::ranges::all_of(triangle.corners, [&](const glm::vec3& corner) {
      return glm::dot(axis, corner) >= low && glm::dot(axis, corner) <= high;
    });
    if (is_inside) {
      result.push_back(triangle);
      continue;
    }
    std::vector<CutPoint> polygon;
    polygon.reserve(3);
    for (std::size_t k = 0; k < 3; ++k) polygon.push_back({triangle.corners[k], triangle.corners_in_node[k]});
    polygon = cut(polygon, [&](const CutPoint& point) { return glm::dot(axis, point.in_model) - low; });
    polygon = cut(polygon, [&](const CutPoint& point) { return high - glm::dot(axis, point.in_model); });
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
      ModelTriangle piece = triangle;
      const std::array<CutPoint, 3> corners{polygon[0], polygon[i], polygon[i + 1]};
      for (std::size_t k = 0; k < 3; ++k)
        piece.corners[k] = corners[k].in_model, piece.corners_in_node[k] = corners[k].in_node;
      const glm::vec3 area =
          glm::cross(piece.corners[1] - piece.corners[0], piece.corners[2] - piece.corners[0]);
      if (glm::length(area) > 2.0f * smallest_m2) result.push_back(piece);
    }
  }
  return result;
}

void DressedParts::add(const ModelTriangle& triangle, int material, const std::array<glm::vec2, 3>& uvs) {
  const glm::vec3 flat = flat_in_node(triangle);
  add_in_node(triangle, material, uvs, {flat, flat, flat});
}

void DressedParts::add(const ModelTriangle& triangle, int material, const std::array<glm::vec2, 3>& uvs,
                       const std::array<glm::vec3, 3>& normals) {
  const glm::mat3 node_from_model_of_normals =
      glm::transpose(glm::mat3(model_from_node_[std::size_t(triangle.node)]));
  const glm::vec3 flat = flat_in_node(triangle);
  std::array<glm::vec3, 3> in_node;
  for (std::size_t k = 0; k < 3; ++k) {
    in_node[k] = glm::normalize(node_from_model_of_normals * normals[k]);
    if (glm::dot(in_node[k], flat) < 0.0f) in_node[k] = -in_node[k];  // of a mirrored node
  }
  add_in_node(triangle, material, uvs, in_node);
}

void DressedParts::add_in_node(const ModelTriangle& triangle, int material,
                               const std::array<glm::vec2, 3>& uvs, const std::array<glm::vec3, 3>& normals) {
  const auto [known, is_new] = parts_.try_emplace({triangle.node, material}, model_.parts.size());
  if (is_new) {
    scene::Part part;
    part.object = object_, part.node = triangle.node, part.material = material;
    model_.parts.push_back(std::move(part));
  }
  Mesh& mesh = model_.parts[known->second].mesh;
  for (std::size_t k = 0; k < 3; ++k) {
    mesh.indices.push_back(std::uint32_t(mesh.positions.size()));
    mesh.positions.push_back(triangle.corners_in_node[k]);
    mesh.normals.push_back(normals[k]), mesh.uvs.push_back(uvs[k]);
  }
}

int add_texture(scene::Model& model, const std::string& name, Image8 image, bool is_srgb) {
  scene::Texture texture;
  texture.name = name, texture.image = std::move(image), texture.is_srgb = is_srgb;
  model.textures.push_back(std::move(texture));
  return int(model.textures.size()) - 1;
}

}  // namespace parvis::dressing
