#include "base/mesh.h"

#include <algorithm>
#include <cmath>

namespace parvis {

Bounds Mesh::bounds() const {
  Bounds bounds;
  for (const glm::vec3& position : positions) bounds.add(position);
  return bounds;
}

void append_vertex(Mesh& to, const Mesh& from, std::size_t vertex) {
  to.positions.push_back(from.positions[vertex]);
  if (!from.normals.empty()) to.normals.push_back(from.normals[vertex]);
  if (!from.uvs.empty()) to.uvs.push_back(from.uvs[vertex]);
  if (!from.second_uvs.empty()) to.second_uvs.push_back(from.second_uvs[vertex]);
  if (!from.colours.empty()) to.colours.push_back(from.colours[vertex]);
}

namespace {

/// Joins arrays that one of two meshes may lack: its vertices have the value `otherwise`.
template <class T>
void join(std::vector<T>& values, std::size_t count, const std::vector<T>& others, std::size_t other_count,
          const T& otherwise) {
  if (values.empty() && others.empty()) return;
  values.resize(count, otherwise);
  values.insert(values.end(), others.begin(), others.end());
  values.resize(count + other_count, otherwise);
}

}  // namespace

void append(Mesh& mesh, const Mesh& other, const glm::mat4& mesh_from_other) {
  const glm::mat3 normal_matrix = glm::transpose(glm::inverse(glm::mat3(mesh_from_other)));
  const bool mirrors = glm::determinant(glm::mat3(mesh_from_other)) < 0.0f;
  const std::uint32_t first = std::uint32_t(mesh.positions.size());
  join(mesh.second_uvs, first, other.second_uvs, other.positions.size(), glm::vec2(0.0f));
  join(mesh.colours, first, other.colours, other.positions.size(), glm::vec4(1.0f));
  for (const glm::vec3& p : other.positions) mesh.positions.push_back(mesh_from_other * glm::vec4(p, 1.0f));
  for (const glm::vec3& n : other.normals) mesh.normals.push_back(glm::normalize(normal_matrix * n));
  mesh.uvs.insert(mesh.uvs.end(), other.uvs.begin(), other.uvs.end());
  for (std::size_t i = 0; i + 2 < other.indices.size(); i += 3) {
    const std::size_t second = mirrors ? 2 : 1;  // a mirrored triangle turns its back: turn it round
    mesh.indices.push_back(first + other.indices[i]);
    mesh.indices.push_back(first + other.indices[i + second]);
    mesh.indices.push_back(first + other.indices[i + 3 - second]);
  }
}

void fill_normals(Mesh& mesh) {
  mesh.normals.resize(mesh.positions.size(), glm::vec3(0.0f));
  std::vector<glm::vec3> sums(mesh.positions.size(), glm::vec3(0.0f));
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
    const glm::vec3 area =
        glm::cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
    sums[a] += area, sums[b] += area, sums[c] += area;
  }
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    if (glm::dot(mesh.normals[i], mesh.normals[i]) > 0.25f) continue;
    const float length = glm::length(sums[i]);
    mesh.normals[i] = length > 0.0f ? sums[i] / length : glm::vec3(0.0f, 0.0f, 1.0f);
  }
}

Status check(const Mesh& mesh, const std::string& name) {
  const std::size_t count = mesh.positions.size();
  const auto fits = [&](std::size_t size) { return size == 0 || size == count; };
  if (!fits(mesh.second_uvs.size()) || !fits(mesh.colours.size()))
    return error(
        "{}: {} positions, {} second texture coordinates and {} colours; expected none or as many of each",
        name, count, mesh.second_uvs.size(), mesh.colours.size());
  if (mesh.normals.size() != count || mesh.uvs.size() != count)
    return error("{}: {} positions, {} normals and {} texture coordinates; expected as many of each", name,
                 count, mesh.normals.size(), mesh.uvs.size());
  const auto finite = [](glm::vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  };
  constexpr float max_coordinate = 1e9f;  // volumes, products of three lengths, stay finite within it
  for (std::size_t i = 0; i < count; ++i) {
    const glm::vec3 size = glm::abs(mesh.positions[i]);
    if (std::max({size.x, size.y, size.z}) > max_coordinate)
      return error("{}: vertex {} lies at {} {} {}; expected coordinates of up to {:g}", name, i,
                   mesh.positions[i].x, mesh.positions[i].y, mesh.positions[i].z, max_coordinate);
  }
  for (std::size_t i = 0; i < count; ++i)
    if (!finite(mesh.positions[i]) || !finite(mesh.normals[i]) || !finite(glm::vec3(mesh.uvs[i], 0.0f)))
      return error("{}: vertex {} is not a finite number; export the model again without NaN or infinity",
                   name, i);
  for (std::size_t i = 0; i < mesh.second_uvs.size(); ++i)
    if (!finite(glm::vec3(mesh.second_uvs[i], 0.0f)))
      return error("{}: a second texture coordinate of vertex {} is not a finite number", name, i);
  for (std::size_t i = 0; i < mesh.colours.size(); ++i)
    if (!finite(glm::vec3(mesh.colours[i])) || !std::isfinite(mesh.colours[i].w))
      return error("{}: the colour of vertex {} is not a finite number", name, i);
  if (mesh.indices.size() % 3 != 0)
    return error("{}: {} indices do not make whole triangles", name, mesh.indices.size());
  for (std::size_t i = 0; i < mesh.indices.size(); ++i)
    if (mesh.indices[i] >= count)
      return error("{}: index {} of triangle {} is out of range; there are {} vertices", name,
                   mesh.indices[i], i / 3, count);
  return Ok{};
}

}  // namespace parvis
