// Methods that look cube maps up.
#pragma once

#include <optional>

#include "reflections/methods/cube_map.h"
#include "reflections/methods/reflections.h"

namespace parvis::probes {

class CubeMapReflections : public methods::Reflections {
 public:
  render::SurfaceSource source() const override { return {.fragment = "reflections/probes/cube_map.frag"}; }

 protected:
  explicit CubeMapReflections(std::optional<methods::LobeFilter> filter = {}) : filter_(std::move(filter)) {}
  /// Renders all faces of a map about a reflector.
  void draw_whole(methods::CubeMap& map, render::Renderer& renderer,
                  const methods::VisibleReflector& reflector);
  /// Computes a map's levels when its faces have changed.
  void update_levels(methods::CubeMap& map) const;
  /// Binds the map to a program of cube_map.frag.
  static void bind_map(const gl::Program& program, const methods::CubeMap& map);

 private:
  std::optional<methods::LobeFilter> filter_;  ///< none: maps have plain mipmaps
};

}  // namespace parvis::probes
