// Draws the scene's objects: culled per view, sorted by material, submitted by multi-draw indirect.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "graphics/gl/program.h"
#include "graphics/render/gpu_scene.h"
#include "graphics/render/stream_buffer.h"
#include "graphics/render/surface_shader.h"
#include "graphics/render/view.h"
#include "graphics/render/virtual_vertices.h"

namespace parvis::render {

/// Counters of one view.
struct DrawStatistics {
  int items_in_frustum = 0;  ///< in a mirrored view: items that the mirror may show
  int items_hidden = 0;      ///< within the frustum, culled by occlusion
  int draws = 0;
  std::size_t triangles = 0;
};

/// The drawable of Scene::objects.
class SceneDrawable final : public Drawable {
 public:
  /// Uploads the scene and compiles its shaders; fails only if a shader does not compile. Needs a current
  /// OpenGL context.
  static Result<SceneDrawable> create(const scene::Scene& scene);

  /// Sets how mirror-like parts are shaded; null: they reflect the sky alone. Replaces the previous shader at
  /// once.
  Status set_reflection(SurfaceShader* shader);

  void update(const scene::Scene& scene) override;
  Extents extents() const override;
  void prepare(const View& view, const Culling& culling) override;
  void draw(const View& view, Pass pass) override;

  /// Indices of the objects in the main view, ascending: those that reflections should be computed for.
  const std::vector<int>& visible_objects() const { return visible_objects_; }
  /// Statistics of the main view as prepared last.
  const DrawStatistics& main_statistics() const { return main_list_.statistics; }
  const GpuScene& gpu() const { return gpu_; }  ///< the scene's models and items on the GPU

 private:
  struct Command {  // DrawElementsIndirectCommand
    std::uint32_t count, instances, first_index;
    std::int32_t base_vertex;
    std::uint32_t base_instance;
  };
  struct Batch {
    int material;
    int mirror_object;  ///< -1: none
    std::uint32_t first_command, command_count;
  };
  struct Programs {
    SurfacePrograms surface;
    gl::Program depth, solid_depth, picking;
  };

  /// The draw list of one view. The main view's list is kept while others are prepared and drawn.
  struct ViewList {
    struct Entry {
      std::uint64_t key;  ///< by which entries are sorted
      int item;
      int level;  ///< 0: the mesh itself; then of the scene's levels
      glm::ivec2 vertex_data{0};
    };
    std::vector<Entry> order;
    std::vector<Item::Record> records;
    std::vector<Command> commands;
    std::array<std::vector<Batch>, pass_count> batches;
    StreamBuffer record_store{1 << 18}, command_store{1 << 16};
    GLintptr first_record = 0, first_command = 0;
    DrawStatistics statistics;
  };

  SceneDrawable(GpuScene gpu, Programs programs);
  const gl::Program& program_for(const View& view, const Batch& batch) const;
  bool is_mirror_in(const View& view, const Item& item) const;
  bool refracts(const Item& item) const;
  int level_of(const Item& item, const Culling& culling) const;
  std::uint64_t sort_key(const Item& item, int level, const View& view) const;
  static void sort(ViewList& list);
  void gather(const View& view, const Culling& culling, ViewList& list);
  void gather_mirrors(const View& view, ViewList& list) const;
  void batch(const View& view, ViewList& list) const;
  void draw_commands(const ViewList& list, std::uint32_t first, std::uint32_t count) const;
  void draw_depth(const ViewList& list) const;
  const ViewList& list_of(const View& view) const {
    return view.kind == ViewKind::main ? main_list_ : other_list_;
  }

  GpuScene gpu_;
  Programs programs_;
  SurfaceShader* reflection_ = nullptr;
  gl::VertexArray vertex_array_;
  ViewList main_list_, other_list_;
  std::vector<int> visible_objects_;
};

}  // namespace parvis::render
