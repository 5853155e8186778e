// World files: where on the map a picture lies.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>

#include "base/result.h"

namespace parvis::plan_drawing {

/// The map from pixels to the plane, in the map's unit.
struct WorldFile {
  glm::dvec2 across{1.0, 0.0}, down{0.0, -1.0};  ///< one pixel to the right, one pixel down
  glm::dvec2 first_centre{0.0};                  ///< of the upper left pixel

  /// The place of a point of the picture; (0, 0) is its upper left corner.
  glm::dvec2 at(glm::dvec2 pixel) const {
    return first_centre + (pixel.x - 0.5) * across + (pixel.y - 0.5) * down;
  }
};

/// The world file beside a picture: plan.pgw, plan.pngw or plan.wld beside plan.png. Errors: there is none,
/// with the names that were looked for; no six numbers; pixels without an area.
Result<WorldFile> read_world_file(const std::filesystem::path& picture);

}  // namespace parvis::plan_drawing
