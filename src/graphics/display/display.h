// A display: the walls on which a room shows a scene, in a frame of its own. A wall is what one projector or
// screen shows: a rectangle, or a curved surface.
//
// The frame of the room: metres, x right, y ahead, z up, wherever its builder put the origin.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"

namespace parvis::display {

/// How the pictures of two eyes come to a wall.
enum class Stereo : unsigned char {
  none,
  quad_buffer,   ///< left and right buffer of the window, for shutter glasses
  side_by_side,  ///< left eye in the left half
  top_bottom,    ///< left eye in the upper half
  interlaced,    ///< left eye in rows 0, 2, 4 from the top
  checkerboard,  ///< left eye where row and column from the top left add up to an even number
  anaglyph       ///< red and cyan
};
/// Names of the kinds of stereo, as files write them.
inline constexpr std::array stereo_names{"none",       "quad_buffer",  "side_by_side", "top_bottom",
                                         "interlaced", "checkerboard", "anaglyph"};
/// The kind of that name; nothing: there is none.
std::optional<Stereo> stereo_named(const std::string& name);

/// The eye whose picture is shown; a wall may show one eye alone (two projectors with polarising filters).
enum class Eye : unsigned char { both, left, right };

/// A corner of the triangles that show a wall.
struct SurfaceVertex {
  glm::vec3 point;  ///< on the wall, in the room, metres
  /// Where the projector's picture has it: x right and y up, 0 to 1, both multiplied by z (homogeneous).
  glm::vec3 pixel;
  glm::vec2 share;  ///< across the wall, from its lower left: 0 to 1; overlaps are measured in it
};

/// The window that shows a wall.
struct WallWindow {
  std::optional<glm::ivec2> at;  ///< of its upper left corner on the screen, pixels
  bool is_full_screen = false, has_border = true;
  std::string x_display;  ///< of X11, ":0.1"; empty: the one of the environment
};

/// The part of a display that one projector or screen shows.
struct Wall {
  std::string name;
  /// Corners of a rectangle, in the room, metres. Of a curved wall: unused.
  glm::dvec3 lower_left{0.0}, lower_right{0.0}, upper_left{0.0};
  bool is_curved = false;
  int columns = 2;                     ///< of `surface`
  std::vector<SurfaceVertex> surface;  ///< rows of `columns` vertices from below; a rectangle has four
  glm::ivec2 pixels{1280, 720};        ///< of the projector or screen
  /// Which shares of the wall a neighbour shows, too: left, right, below, above. Their light is blended.
  std::array<double, 4> overlap{};
  Eye eye = Eye::both;
  WallWindow window;
};

/// All walls of a room and who looks at them.
struct Display {
  std::string name;
  std::vector<Wall> walls;
  Stereo stereo = Stereo::none;
  glm::dvec3 eye{0.0, 0.0, 1.7};  ///< midway between the eyes where nothing tracks them, in the room, metres
  double eye_separation_m = 0.064;
  double scale = 1.0;      ///< metres of the scene in a metre of the room
  bool is_upright = true;  ///< the room stays level where the scene's camera looks up or down
  double gamma = 0.0;      ///< of the projectors; 0: sRGB
  std::string head, wand;  ///< the trackers of head and wand, by name; empty: none
};

/// Most walls and most pixels along one side of a wall that a file may have.
inline constexpr std::size_t max_walls = 64;
inline constexpr int max_wall_pixels = 16'384;

/// Finds what neighbours in one plane both show, and writes it into their overlaps, where a wall has none
/// yet. Two projectors that show the same rectangle are no neighbours.
void find_overlaps(Display& display);

/// Checks a display that was read, makes the surfaces of its rectangles and returns it. Errors: no wall, too
/// many, two of one name, corners in a line, no right angle, a wall that shows its back to the eye.
Result<Display> checked(Display display, const std::string& file);

/// Makes the surface of a rectangle: where its four corners lie in the projector's picture (lower left, lower
/// right, upper right, upper left; x right, y up, 0 to 1), by the projective map of the square to them.
/// Errors: the corners are no convex shape.
Status set_keystone(Wall& wall, const std::array<glm::dvec2, 4>& corners);

}  // namespace parvis::display
