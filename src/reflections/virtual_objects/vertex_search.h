// Searches ahead of a mirrored view: one pass searches for all vertices of meshes, and for the corners of the
// virtual grids that stand in for vertices (Estalella and others 2005, section 5), a texel of a picture each,
// out of which the vertex shader then takes them or interpolates between them.
// Nothing is read back; a fragment shader searches, for it needs neither compute shaders nor storage buffers,
// and runs on all cores of a software renderer.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "graphics/gl/objects.h"
#include "graphics/gl/program.h"
#include "graphics/render/gpu_scene.h"
#include "graphics/render/stream_buffer.h"
#include "scene/data/scene.h"

namespace parvis::virtual_objects {

class VertexSearch {
 public:
  /// Makes grids for all meshes that stay as they are and have enough vertices, after the scene's
  /// reflection(virtual_grid=...). `defines` are those of the search.
  static Result<VertexSearch> create(const scene::Scene& scene, const render::GpuScene& gpu,
                                     const gl::Defines& defines);

  /// Is there a mesh whose vertices are not all searched for by themselves? Else shaders need not know.
  bool has_any() const { return has_any_; }
  /// A grid, or all vertices, for the next search, of an item whose image covers about so many pixels.
  /// Returns what its vertices read: the grid in the table, or, below 0, the number before its first vertex,
  /// turned round; and the first row of results. 0 where each vertex is searched for by itself.
  glm::ivec2 add(const render::Item& item, float area_px);
  /// Searches for all corners that were added. `bind_patch` hands the program the reflector's patch.
  void search(const std::function<void(const gl::Program&)>& bind_patch);
  /// Hands results and grids to a program that has grid_interpolation.glsl.
  void bind(const gl::Program& program) const;

 private:
  /// Grids of a mesh from fine to coarse.
  struct MeshGrids {
    std::size_t vertex_count = 0;
    int first_vertex = 0;       ///< of all on the GPU
    int vertices_in_table = 0;  ///< 0: they are not
    std::vector<std::uint32_t> corner_counts;
    std::vector<int> in_table;
  };
  struct Instance {
    glm::vec4 rows[3];  ///< of world_from_mesh
    glm::ivec2 grid;
  };

  VertexSearch(gl::Program program, bool follows_area, float grid_share, std::vector<MeshGrids> of_part,
               std::span<const glm::vec4> table);
  void upload_table(std::span<const glm::vec4> table);
  void make_results(int rows);

  gl::Program program_;
  bool follows_area_;               ///< coarser where the image is small
  bool is_asked_for_;               ///< large images, too
  float max_stray_px_;              ///< beyond it, a vertex is searched for
  std::vector<MeshGrids> of_part_;  ///< of the GPU scene's parts; those that came later have none
  bool has_any_;
  gl::Texture table_, results_;
  gl::Framebuffer target_;
  gl::VertexArray vertex_array_;
  render::StreamBuffer instance_store_{1 << 14};
  std::vector<Instance> instances_;  ///< to be searched for next
  int rows_ = 0, rows_taken_ = 0;    ///< of `results_`
};

}  // namespace parvis::virtual_objects
