// Pictures of brick walls, with and without windows, for buildings that come without any.
#pragma once

#include <array>

#include "scene/model.h"

namespace parvis::scene {

// What one repetition of a picture shows.
inline constexpr int picture_bays = 4, picture_storeys = 4;
inline constexpr float bay_m = 2.9f, storey_m = 3.1f;

/// sRGB of the bricks.
inline constexpr std::array<glm::vec3, 5> brick_colours{glm::vec3(146, 92, 70), glm::vec3(168, 121, 92),
                                                        glm::vec3(118, 74, 60), glm::vec3(186, 152, 118),
                                                        glm::vec3(204, 192, 170)};

/// picture_bays x picture_storeys bays; every window differs a little. Without windows: plain bricks.
Texture brick_wall_picture(glm::vec3 brick_srgb, bool has_windows, std::uint64_t seed);

/// Where brick_wall_picture's panes mirror: a surface picture as scene::Material has it.
Texture brick_wall_surface();

}  // namespace parvis::scene
