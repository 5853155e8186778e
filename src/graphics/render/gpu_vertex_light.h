// Light at the vertices of objects (scene/data/vertex_irradiance.h) as a texture that vertex shaders read.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <unordered_map>
#include <vector>

#include "graphics/gl/objects.h"
#include "scene/data/vertex_irradiance.h"

namespace parvis::scene {
struct Scene;
}

namespace parvis::render {

/// One texel per vertex and side of each lit object, at most scene::max_lit_texels.
class GpuVertexLight {
 public:
  /// Lays out the texture for the objects that are lit now, those of the last call as they were;
  /// `first_texels` answers from then on.
  void reserve(const scene::Scene& scene);
  /// Uploads the light of objects that have another one than at the last call.
  void update(const scene::Scene& scene);

  /// Texel of the first vertex of a part, on the side of its normals and on the other one; the two are the
  /// same where the part has light on one side. Zero for objects that are not lit.
  glm::ivec2 first_texels(std::size_t object, std::size_t part) const;
  /// Binds the light at `vertex_light_unit`; does nothing where no object is lit.
  void bind() const;

 private:
  struct Place {
    std::vector<glm::ivec2> parts;                 ///< first texels of each part
    std::shared_ptr<const scene::LitVertices> up;  ///< what has been uploaded
  };
  void write(const std::vector<glm::vec3>& light, int first);

  std::unordered_map<std::size_t, Place> places_;  ///< by object
  std::size_t texels_ = 0;                         ///< that are laid out
  std::vector<glm::vec4> row_;
  gl::Texture texture_;
};

}  // namespace parvis::render
