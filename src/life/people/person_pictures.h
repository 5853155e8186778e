// Pictures of somebody far away: the person's mesh seen from a few directions in a few postures, as colours,
// normals and coverage side by side in one image. A renderer shows them in any light.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/image.h"
#include "life/people/person_model.h"

namespace parvis::people {

/// Directions from which somebody is pictured: rings about the person at a height of the viewer, beginning
/// in front of the person and going counter-clockwise seen from above.
struct PictureRing {
  float elevation_deg;  ///< of the viewer above the horizon
  int azimuths;
  float lowest;  ///< height of the lower edge above the foot in the picture's plane, in statures
};
inline constexpr std::array<PictureRing, 2> picture_rings{{{0.0f, 16, -0.05f}, {40.0f, 8, -0.25f}}};
inline constexpr int picture_directions = picture_rings[0].azimuths + picture_rings[1].azimuths;

/// Postures: phases of the left foot's cycle in equal steps, then `rest_pictures`.
inline constexpr int walking_pictures = 8;
inline constexpr std::array<Activity, 3> rest_pictures{Activity::stand, Activity::wait, Activity::phone};
inline constexpr int picture_postures = walking_pictures + int(rest_pictures.size());

/// Pixels of one picture; a pixel is 1 / `picture_px_per_stature` of the person's height wide and high.
inline constexpr int picture_width_px = 44, picture_height_px = 76;
inline constexpr float picture_px_per_stature = 64.7f;
/// Pictures lie in columns by direction and rows by posture, from the top left. Each halves twice without
/// its neighbours: mipmaps have `picture_levels` levels. Colours are half as fine, so they have one level
/// less.
inline constexpr int picture_levels = 3, pixels_per_colour = 2;

/// The direction from a person to a viewer, in the person's frame, from which the picture `direction` shows
/// them; unit.
glm::vec3 picture_view(int direction);
/// The direction of picture_view nearest to `to_viewer`, which is in the person's frame and of any length.
int nearest_picture(glm::vec3 to_viewer);

/// The posture of a picture, below `picture_postures`: straight on at an ordinary speed, or on the spot.
Posture pictured_posture(const BodyField& body, int posture);
/// The picture of somebody who walks at a phase of the left foot's cycle, or who rests.
int picture_of(std::optional<float> phase, Activity at_rest);

/// All pictures of one person.
struct PersonPictures {
  float stature_m = 1.75f;
  /// The normal in the person's frame (0..1 for -1..1), and in alpha the coverage.
  Image8 shapes;
  /// The person in each of the colours that were asked for, in images half as wide and high: sRGB; alpha is
  /// 255.
  std::vector<Image8> colours;
  /// The covered pixels of each picture, within it: x, y of the first and beyond the last.
  std::vector<glm::ivec4> covered;

  /// Index of a picture in `covered`.
  static std::size_t index(int direction, int posture) {
    return std::size_t(posture * picture_directions + direction);
  }
};

/// Pictures a person's mesh of the level `far`, once in each of these colours.
PersonPictures make_pictures(const PersonLevels& levels, const Someone& who,
                             std::span<const Colours> colours);

}  // namespace parvis::people
