// Indexed triangle meshes in flat arrays.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "base/bounds.h"
#include "base/result.h"

namespace parvis {

/// Triangles, counter-clockwise seen from outside. Every array but `indices` has one entry a vertex; the last
/// two may be empty.
struct Mesh {
  std::vector<glm::vec3> positions;  ///< metres
  std::vector<glm::vec3> normals;    ///< unit length
  std::vector<glm::vec2> uvs;        ///< v downward from the picture's top, as glTF has it
  std::vector<std::uint32_t> indices;
  std::vector<glm::vec2> second_uvs;  ///< for textures that lie on the mesh in another way than the first
  std::vector<glm::vec4> colours;     ///< linear, with alpha: they multiply the material's; empty: white

  std::size_t triangle_count() const { return indices.size() / 3; }
  Bounds bounds() const;
};

/// Appends one vertex of `from` with all that it has; `to` has the arrays that `from` has.
void append_vertex(Mesh& to, const Mesh& from, std::size_t vertex);

/// Appends `other`, transformed, to `mesh`.
void append(Mesh& mesh, const Mesh& other, const glm::mat4& mesh_from_other = glm::mat4(1.0f));

/// Replaces missing or zero normals by area-weighted ones (smooth over shared vertices).
void fill_normals(Mesh& mesh);

/// Fails where a renderer could not draw the mesh: arrays of different length, non-finite numbers, indices
/// out of range.
Status check(const Mesh& mesh, const std::string& name);

}  // namespace parvis
