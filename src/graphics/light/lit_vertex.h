// A vertex that sky and sun light, and what surfaces about it do.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace parvis::light {

struct LitVertex {
  glm::vec3 position, normal;  ///< in the world; unit normal
};

/// The contribution of a ray that does not reach the sky.
enum class Blocked : std::uint8_t {
  dark,    ///< nothing: the sum of the thesis's appendix A.2, visibility alone
  bounces  ///< light that the surface it hits gives back of the sun, which a ray finds, and of half the sky
};

}  // namespace parvis::light
