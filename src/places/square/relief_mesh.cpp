#include "places/square/relief_mesh.h"

#include <algorithm>
#include <cmath>

namespace parvis::square {
namespace {

/// Dirt that the street throws up: walls are darker below this height.
constexpr float dirty_below_m = 1.1f, dirt = 0.3f;

bool is_wall(Surface surface) { return surface == Surface::plaster || surface == Surface::ashlar; }

/// Texture coordinates in metres of a point on a plane.
glm::vec2 metres_on_plane(glm::vec3 p, glm::vec3 normal) {
  if (std::abs(normal.z) > 0.9f) return {p.x, -p.y};
  const glm::vec3 along = glm::normalize(glm::cross(glm::vec3(0, 0, 1), normal)),
                  up = glm::cross(normal, along);
  return {glm::dot(p, along), -glm::dot(p, up)};
}

}  // namespace

void ReliefMesh::corner(Mesh& mesh, glm::vec3 position, glm::vec3 normal, glm::vec2 uv) {
  const glm::vec3 p = frame_.point(position.x, position.y, position.z);
  mesh.positions.push_back(p), mesh.normals.push_back(normal), mesh.uvs.push_back(uv);
  const float clean = glm::smoothstep(0.0f, dirty_below_m, p.z);
  mesh.colours.emplace_back(tint_ * glm::mix(1.0f - dirt, 1.0f, clean), 1.0f);
}

void ReliefMesh::quad(Surface surface, const glm::vec3 (&c)[4], const glm::vec2 (&uvs)[4]) {
  Mesh& mesh = meshes_[{group_, surface}];
  const glm::vec3 across = glm::cross(c[2] - c[0], c[3] - c[1]);
  if (glm::length(across) < 1e-9f) return;
  const glm::vec3 n = glm::normalize(across);
  const glm::vec3 normal = n.x * frame_.along + n.y * frame_.inward + glm::vec3(0, 0, n.z);
  const std::uint32_t first = std::uint32_t(mesh.positions.size());
  for (int i = 0; i < 4; ++i) corner(mesh, c[i], normal, uvs[i]);
  mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
  triangles_ += 2;
}

void ReliefMesh::quad(Surface surface, glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d) {
  const glm::vec3 across = glm::cross(c - a, d - b);
  if (glm::length(across) < 1e-9f) return;
  const glm::vec3 n = glm::normalize(across);
  quad(surface, {a, b, c, d},
       {metres_on_plane(a, n), metres_on_plane(b, n), metres_on_plane(c, n), metres_on_plane(d, n)});
}

void ReliefMesh::triangle(Surface surface, glm::vec3 a, glm::vec3 b, glm::vec3 c) {
  Mesh& mesh = meshes_[{group_, surface}];
  const glm::vec3 n = glm::normalize(glm::cross(b - a, c - a));
  const glm::vec3 normal = n.x * frame_.along + n.y * frame_.inward + glm::vec3(0, 0, n.z);
  for (const glm::vec3& p : {a, b, c}) {
    mesh.indices.push_back(std::uint32_t(mesh.positions.size()));
    corner(mesh, p, normal, metres_on_plane(p, n));
  }
  ++triangles_;
}

void ReliefMesh::face(Surface surface, float x0, float x1, float z0, float z1, float y) {
  // A row of corners at the height where dirt ends, for colours are interpolated.
  if (is_wall(surface) && z0 < 0.5f * dirty_below_m && z1 > 1.5f * dirty_below_m) {
    face(surface, x0, x1, z0, dirty_below_m, y);
    z0 = dirty_below_m;
  }
  quad(surface, {x0, y, z0}, {x1, y, z0}, {x1, y, z1}, {x0, y, z1});
}

void ReliefMesh::picture(Surface surface, float x0, float x1, float z0, float z1, float y, glm::vec2 foot,
                         glm::vec2 top) {
  quad(surface, {{x0, y, z0}, {x1, y, z0}, {x1, y, z1}, {x0, y, z1}},
       {foot, {top.x, foot.y}, top, {foot.x, top.y}});
}

void ReliefMesh::box(Surface surface, glm::vec3 a, glm::vec3 b) {
  quad(surface, {a.x, a.y, a.z}, {b.x, a.y, a.z}, {b.x, a.y, b.z}, {a.x, a.y, b.z});
  quad(surface, {a.x, b.y, a.z}, {a.x, a.y, a.z}, {a.x, a.y, b.z}, {a.x, b.y, b.z});
  quad(surface, {b.x, a.y, a.z}, {b.x, b.y, a.z}, {b.x, b.y, b.z}, {b.x, a.y, b.z});
  quad(surface, {a.x, a.y, b.z}, {b.x, a.y, b.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z});
  quad(surface, {a.x, b.y, a.z}, {b.x, b.y, a.z}, {b.x, a.y, a.z}, {a.x, a.y, a.z});
}

void ReliefMesh::moulding(Surface surface, float x0, float x1, float z, std::span<const glm::vec2> profile) {
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const glm::vec2 p = profile[i], q = profile[i + 1];
    quad(surface, {x0, -p.x, z + p.y}, {x1, -p.x, z + p.y}, {x1, -q.x, z + q.y}, {x0, -q.x, z + q.y});
    // Ends: a fan to the wall.
    if (i == 0) continue;
    const glm::vec2 first = profile[0];
    triangle(surface, {x0, -first.x, z + first.y}, {x0, -p.x, z + p.y}, {x0, -q.x, z + q.y});
    triangle(surface, {x1, -first.x, z + first.y}, {x1, -q.x, z + q.y}, {x1, -p.x, z + p.y});
  }
}

void ReliefMesh::mesh(Surface surface, const Mesh& added) {
  Mesh& mesh = meshes_[{group_, surface}];
  const std::uint32_t first = std::uint32_t(mesh.positions.size());
  for (std::size_t i = 0; i < added.positions.size(); ++i) {
    const glm::vec3 n = added.normals[i];
    corner(mesh, added.positions[i], n.x * frame_.along + n.y * frame_.inward + glm::vec3(0, 0, n.z),
           added.uvs[i]);
  }
  for (const std::uint32_t index : added.indices) mesh.indices.push_back(first + index);
  triangles_ += added.triangle_count();
}

void ReliefMesh::move_into(scene::Model& model) {
  for (auto& [key, mesh] : meshes_) {
    scene::Part part;
    part.object = key.first + " " + model.materials[std::size_t(key.second)].name;
    part.mesh = std::move(mesh), part.material = int(key.second);
    part.casts_shadow = key.second != Surface::road && key.second != Surface::zebra;
    model.parts.push_back(std::move(part));
  }
  meshes_.clear();
}

}  // namespace parvis::square
