// Lines of ink on the edges of the scene's objects, for pictures below three quarters of scene::Realism.
#pragma once

#include <limits>
#include <unordered_map>
#include <vector>

#include "graphics/gl/program.h"
#include "graphics/render/drawable.h"
#include "graphics/render/gpu_scene.h"

namespace parvis::realism {

/// The drawable of these lines; it draws in the main view alone, after all others. Ink lies in the picture's
/// alpha: its share of a sample that is left bare (display.frag).
class EdgeLines final : public render::Drawable {
 public:
  /// `gpu` must outlive it. Fails only if a shader does not compile.
  static Result<std::unique_ptr<EdgeLines>> create(const render::GpuScene& gpu);

  /// Finds the edges of models that have none yet, where the scene asks for lines.
  void update(const scene::Scene& scene) override;
  render::Extents extents() const override { return {}; }
  void prepare(const render::View& view, const render::Culling& culling) override;
  void draw(const render::View& view, render::Pass pass) override;

 private:
  /// An edge as the vertex shader takes it.
  struct Record {
    glm::vec3 from, to;
    std::uint32_t normal, other_normal;  ///< packed; the sign bits of the first: it is always drawn
  };
  /// The edges of a part, in `records_`.
  struct Range {
    std::uint32_t first = 0, count = 0;
    float spacing_m = std::numeric_limits<float>::infinity();
  };
  struct Draw {
    std::size_t item;
    Range range;
    float crease_share, outline_share;  ///< of ink
  };

  EdgeLines(const render::GpuScene& gpu, gl::Program program);
  std::size_t add(const scene::Model& model);

  const render::GpuScene& gpu_;
  gl::Program program_;
  gl::VertexArray vertex_array_;
  gl::Buffer buffer_;
  float ink_ = 0.0f;  ///< of the present frame; 0: none
  std::vector<Record> records_;
  std::vector<Range> ranges_;
  std::unordered_map<const scene::Model*, std::size_t> first_range_of_model_;
  std::vector<std::size_t> first_range_;  ///< of each object
  std::vector<Draw> draws_;               ///< of the main view
};

}  // namespace parvis::realism
