// The surface shader in the variants that a scene's materials need: a texture that a material lacks is not
// looked up.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "gl/program.h"
#include "render/gpu_scene.h"

namespace parvis::render {

class SurfacePrograms {
 public:
  /// Links render/surface.vert and `fragment_path` for each combination of features among `materials`.
  static Result<SurfacePrograms> create(const std::string& fragment_path,
                                        const std::vector<GpuMaterial>& materials);

  /// Of a material that was among them.
  const gl::Program& of(const GpuMaterial& material) const { return programs_[material.features]; }

 private:
  std::array<gl::Program, surface_feature_combinations> programs_;
};

}  // namespace parvis::render
