// The lamps of a scene as it stands now, for renderer and ray tracer alike.
#pragma once

#include <vector>

#include "graphics/reference/ray_scene.h"
#include "graphics/shading/lamps.h"
#include "scene/data/scene.h"

namespace parvis::reference {

/// Which lamps are asked for.
enum class LampKind : std::uint8_t {
  all,
  still,  ///< those that stand by themselves or on static objects
  moving  ///< those on dynamic objects
};

/// The lamps that burn, in the world, without depth maps: nodes in their order, each with its objects.
std::vector<shading::Lamp> lit_lamps(const scene::Scene& scene, LampKind kind = LampKind::all);

/// The ray from a surface to the glass of a lamp.
Ray ray_to_lamp(const shading::Lamp& lamp, glm::vec3 position, glm::vec3 geometric_normal);

}  // namespace parvis::reference
