// All triangles of a scene in one vertex and one index buffer, which grow as meshes come. Deforming meshes
// that were added one after another are uploaded together every frame.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/mesh.h"
#include "graphics/gl/objects.h"

namespace parvis::render {

/// Range of a mesh in the shared buffers.
struct MeshRange {
  std::uint32_t first_index, index_count;
  std::int32_t base_vertex;
};

/// The shared vertex and index buffer of a scene: meshes are added, uploaded, and deforming ones updated
/// every frame.
class GpuGeometry {
 public:
  /// Layout of the vertex buffer; mesh frame.
  struct Vertex {
    glm::vec3 position, normal;
    glm::vec2 uv;
    float openness;  ///< scene::LeafOpenness
  };

  /// Attributes that only some meshes have: a second buffer, with an entry for each vertex if any mesh of the
  /// scene has it.
  struct Detail {
    glm::vec4 colour{1.0f};
    glm::vec2 second_uv{0.0f};
  };

  /// Appends a rigid mesh. `openness`: by vertex; empty: all is open.
  MeshRange add(const Mesh& mesh, std::span<const float> openness = {});
  /// Appends further triangles over the vertices of `mesh` (a coarser level of detail).
  MeshRange add_triangles(const MeshRange& mesh, const std::vector<std::uint32_t>& indices);
  /// Appends a mesh that deforms.
  MeshRange add_deforming(const Mesh& mesh);
  /// Uploads what was added since the last call; the buffers may be others afterwards.
  void upload();

  /// Copies positions and normals of a deformed mesh, which has as many vertices as the one added;
  /// `upload_deformed` sends them to the GPU.
  void deform(const MeshRange& range, const Mesh& mesh);
  /// Uploads all deforming vertices in one call; does nothing where there are none.
  void upload_deformed();

  GLuint vertex_buffer() const { return vertex_buffer_.name(); }  ///< interleaved Vertex; 0 before `upload`
  GLuint detail_buffer() const { return detail_buffer_.name(); }  ///< of Detail; 0 where no mesh has any
  /// Buffer of 32-bit indices relative to MeshRange::base_vertex.
  GLuint index_buffer() const { return index_buffer_.name(); }

 private:
  MeshRange append(const Mesh& mesh, std::span<const float> openness);

  /// Deforming vertices side by side, in the buffer as well.
  struct Run {
    std::size_t first_in_buffer, first, count;
  };
  std::size_t end_vertex() const { return uploaded_vertices_ + vertices_.size(); }

  std::vector<Vertex> vertices_;        ///< to be uploaded
  std::vector<Detail> details_;         ///< of them, where any mesh has some
  std::vector<std::uint32_t> indices_;  ///< to be uploaded
  std::vector<Vertex> deforming_;
  std::vector<Run> runs_;     ///< of them, ascending
  std::vector<Run> changed_;  ///< since they were uploaded
  std::size_t uploaded_vertices_ = 0, uploaded_details_ = 0, uploaded_indices_ = 0;
  std::size_t vertex_room_ = 0, detail_room_ = 0, index_room_ = 0;  ///< of the buffers
  gl::Buffer vertex_buffer_, detail_buffer_, index_buffer_;
};

}  // namespace parvis::render
