// The surface of a moving body in a box of cells, for rays that hit it (body_field.glsl): how far away it is
// and what colour it has there.
#pragma once

#include <vector>

#include "base/bounds.h"
#include "graphics/shading/glsl.h"
#include "scene/data/model.h"

namespace parvis::environment_rays {

struct BodyField {
  /// Bytes. rgb: square root of the linear base colour of what is nearest; a: distance from the surface, from
  /// -field_reach_m (0) over 0 (127.5) to field_reach_m (255).
  using Cell = glm::u8vec4;

  Bounds box;               ///< in the model's frame; empty: there is nothing to meet
  std::vector<Cell> cells;  ///< x, then y, then z

  static glm::ivec3 size();  ///< in cells
  float reach_m() const;     ///< so far from the surface distances are known
};

/// The field of a model's solid parts at rest, in `materials`, the model's or those of an object; blended
/// parts are left out. An open part has its inside where its triangles turn their backs.
BodyField body_field(const scene::Model& model, const std::vector<scene::Material>& materials);

/// The distance at which a ray hits the body, `reach_m` where it does not: as distance_to_body in
/// body_field.glsl, in the model's frame.
float distance_to_body(const BodyField& field, glm::vec3 origin, glm::vec3 direction, float reach_m,
                       bool is_own = false);

/// How much of what a body mirrors of itself at this distance is shown, 0 to 1: own_share of body_field.glsl.
float own_share(const BodyField& field, float distance_m);

}  // namespace parvis::environment_rays
