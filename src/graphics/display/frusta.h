// Frusta of the walls of a display, from eyes that move (R. Kooima, Generalized Perspective Projection,
// 2008).
#pragma once

#include <span>

#include "base/camera.h"
#include "graphics/display/display.h"

namespace parvis::display {

/// The head of who looks, in the room.
struct Head {
  glm::dvec3 position{0.0};         ///< midway between the eyes, metres
  glm::dvec3 right{1.0, 0.0, 0.0};  ///< unit vector from the left eye to the right one
};

/// Whether an eye in the room sees the wall from before, and of a curved one all within an angle that one
/// picture can show.
bool is_before(const Wall& wall, glm::dvec3 eye);

/// Where the room stands in the scene: its eye (Display::eye) where the view's eye is, its y axis along the
/// view; level where the display is upright. Rigid but for Display::scale.
glm::dmat4 world_from_room(const Display& display, const Camera& view);

/// The camera whose picture a wall shows to an eye of the room; near and far plane as those of `view`. An eye
/// nearer to the wall's plane than a centimetre, or behind it, counts as a centimetre before it.
Camera wall_camera(const Wall& wall, glm::dvec3 eye, const glm::dmat4& world_from_room, const Camera& view);

/// One picture that is drawn for a display.
struct WallPicture {
  std::size_t wall;  ///< its index
  Eye eye;           ///< both: no stereo
  Camera camera;
  glm::ivec2 size;           ///< pixels
  glm::mat4 clip_from_room;  ///< of the camera
};

/// The pictures of a moment, wall by wall, the left eye before the right one. `only`: the indices of the
/// walls that are wanted; empty: all.
std::vector<WallPicture> pictures_of(const Display& display, const Head& head, const Camera& view,
                                     std::span<const std::size_t> only = {});

}  // namespace parvis::display
