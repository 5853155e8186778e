// Walls of buildings whose file says when they were built, what for, or of what: windows, finishes and
// measures by epoch and use.
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "base/random.h"
#include "scene/data/building_kind.h"
#include "synthesis/surface_canvas.h"

namespace parvis::dressing {

/// The content of a sheet of a kind of wall.
enum class KindSheet : std::uint8_t {
  plain,    ///< no openings
  storeys,  ///< a window in each bay
  street,   ///< a band of houses with a door, above it one of shops
  gates,    ///< a gate in each second bay, no windows
  nave      ///< tall windows with round tops, as high as the sheet
};

/// Bays and rows on a sheet, and the size of one as painted.
struct KindLayout {
  glm::vec2 count, cell_m;
};
/// The layout of a sheet.
KindLayout layout_of(KindSheet sheet);

/// The walls that one look has in common.
struct WallLook {
  scene::BuildingEpoch epoch = scene::BuildingEpoch::unknown;
  scene::WallFinish finish = scene::WallFinish::brick;
  bool is_office = false;

  auto operator<=>(const WallLook&) const = default;
};

/// Measures of houses of a look: the smallest and the largest.
struct WallMeasures {
  glm::vec2 storey_m, bay_m;
};
/// The measures of a look; an office's are those of offices of any time.
WallMeasures measures_of(const WallLook& look);

/// Mean colours that walls of a finish come in, linear.
std::vector<glm::vec3> wall_colours(scene::WallFinish finish);

/// The look of a building, and the number of its colour among those of its finish.
struct ChosenWall {
  WallLook look;
  int colour;
};
/// The wall of a building. What `kind` does not say is chosen at random: an office without a year is none of
/// the oldest, walls are of what their time built with.
ChosenWall chosen_wall(const scene::BuildingKind& kind, Random& random);

/// A painted sheet; in_colour (brick_texture.h) gives its picture a colour divided by `painted`.
struct KindPictures {
  synthesis::SurfacePictures pictures;
  glm::vec3 painted;  ///< linear
};
/// Paints a sheet of a look, the same one each time.
KindPictures wall_pictures(KindSheet sheet, const WallLook& look);

}  // namespace parvis::dressing
