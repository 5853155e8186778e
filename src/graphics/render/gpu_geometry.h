// The triangles of a scene in one vertex and one index buffer. Meshes that bend lie behind all others and are
// written anew, in one piece, in every frame.
#pragma once

#include <cstdint>
#include <vector>

#include "base/mesh.h"
#include "graphics/gl/objects.h"

namespace parvis::render {

/// A mesh in the shared buffers.
struct MeshRange {
  std::uint32_t first_index, index_count;
  std::int32_t base_vertex;
};

class GpuGeometry {
 public:
  struct Vertex {
    glm::vec3 position, normal;
    glm::vec2 uv;
  };

  /// Meshes that stay as they are, before all that bend.
  MeshRange add(const Mesh& mesh);
  /// Other triangles of the vertices of a mesh that was added.
  MeshRange add_triangles(const MeshRange& mesh, const std::vector<std::uint32_t>& indices);
  MeshRange add_bending(const Mesh& mesh);
  /// Makes the buffers: nothing can be added from now on.
  void upload();

  /// Takes over positions and normals of a mesh that bends; the GPU has them after `upload_bent`.
  void bend(const MeshRange& range, const Mesh& mesh);
  void upload_bent();

  GLuint vertex_buffer() const { return vertex_buffer_.name(); }
  GLuint index_buffer() const { return index_buffer_.name(); }

 private:
  std::vector<Vertex> vertices_;  ///< after `upload`: of those that bend alone
  std::vector<std::uint32_t> indices_;
  std::size_t rigid_vertices_ = 0;
  gl::Buffer vertex_buffer_, index_buffer_;
};

}  // namespace parvis::render
