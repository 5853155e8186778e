// Reference maps (Meyer and Loscos 2003, section 4): what the fixed scene looks like all round a few places,
// with the distance of what is seen. Each map is one octahedral layer; the paper's six faces of 128 hold as
// much.
#pragma once

#include <vector>

#include "gl/objects.h"
#include "render/renderer.h"

namespace parvis::environment_maps {

class ReferenceMaps {
 public:
  /// Texels that repeat what lies across a layer's sides, in its finest level.
  static constexpr int border = 4;

  /// Draws the fixed scene from each place, six faces of `face_resolution` each; takes some tenths of a
  /// second a map, so it shows progress. Fails only if a shader does.
  static Result<ReferenceMaps> bake(render::Renderer& renderer, std::vector<glm::vec3> places,
                                    int face_resolution);

  const std::vector<glm::vec3>& places() const { return places_; }
  int resolution() const { return resolution_; }      ///< texels a side of a layer
  GLuint colours() const { return colours_.name(); }  ///< linear radiance, with mipmaps
  GLuint glosses() const { return glosses_.name(); }  ///< blurred for roughness, map_levels.glsl
  GLuint distances() const {
    return distances_.name();
  }  ///< metres from the place; as far as can be for the sky
  GLuint place_texture() const { return place_texture_.name(); }  ///< one row: each map's place in the world
  std::size_t bytes() const;                                      ///< of graphics memory

 private:
  ReferenceMaps(std::vector<glm::vec3> places, int resolution);

  std::vector<glm::vec3> places_;
  int resolution_;
  gl::Texture colours_, glosses_, distances_, place_texture_;
};

}  // namespace parvis::environment_maps
