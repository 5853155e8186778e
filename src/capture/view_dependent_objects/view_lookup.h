// C++ face of view_lookup.glsl: the colour of a view-dependent object's points, for rays.
#pragma once

#include <memory>
#include <vector>

#include "capture/view_dependent_objects/blended_model.h"
#include "graphics/reference/mip_texture.h"
#include "graphics/shading/view_blend.h"

namespace parvis::view_dependent_objects {

/// A point of a triangle, as a ray finds it.
struct PointOnTriangle {
  std::size_t triangle;   ///< of the whole model
  glm::vec2 barycentric;  ///< weights of the second and third corner
  glm::vec3 to_eye;       ///< unit, in the models' frame
  float width_m;          ///< of the surface that the ray stands for, in the models' frame
};

/// The shader's own function over a blended model, which is kept.
class ViewLookup {
 public:
  explicit ViewLookup(std::shared_ptr<const BlendedModel> model);

  /// Linear colour and alpha of a point of a piece, from `passes` viewpoints.
  glm::vec4 colour(const Piece& piece, const PointOnTriangle& at, int passes) const;

 private:
  // What the text below asks for, and its functions. NOLINTBEGIN
  using vec2 = glm::vec2;
  using vec3 = glm::vec3;
  using vec4 = glm::vec4;
  struct Text {
    const ViewLookup& lookup;
    vec4 view_entry(int index) const { return lookup.model_->table[std::size_t(index)]; }
    vec4 view_picture(int layer, vec2 uv, vec2 along_x, vec2 along_y) const {
      const reference::MipTexture& picture = lookup.pictures_[std::size_t(layer)];
      return picture.sample(
          uv, glm::max(glm::length(along_x * picture.size()), glm::length(along_y * picture.size())));
    }
    static float view_penalty(vec3 to_eye, vec3 to_photograph, float ratio, float weight) {
      return shading::view_penalty(to_eye, to_photograph, ratio, weight);
    }
    static float blend_weight(float penalty, float max_penalty) {
      return shading::blend_weight(penalty, max_penalty);
    }
    static float max(float a, float b) { return glm::max(a, b); }
    static float length(vec3 v) { return glm::length(v); }
#include "capture/view_dependent_objects/view_lookup.glsl"
  };
  // NOLINTEND

  std::shared_ptr<const BlendedModel> model_;
  std::vector<reference::MipTexture> pictures_;
};

}  // namespace parvis::view_dependent_objects
