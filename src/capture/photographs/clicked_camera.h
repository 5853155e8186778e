// A photograph's camera from points of the place that a person clicked in it.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "capture/photographs/photograph.h"

namespace parvis::photographs {

/// A point of the place, and where a photograph shows it.
struct ClickedPoint {
  glm::dvec2 pixel{0.0};              ///< from the top left, pixel centres at +0.5 (lens.h)
  glm::dvec3 position_in_world{0.0};  ///< metres
};

/// Fewest points that give a camera.
inline constexpr std::size_t min_clicked_points = 6;

/// Lines of "x y X Y Z": pixels, then metres in the world; # begins a comment. `name` stands in errors: a
/// line that is none, numbers out of range.
Result<std::vector<ClickedPoint>> parse_clicked_points(std::string_view text, const std::string& name);

/// A camera, and how far from each click it shows the click's point, pixels.
struct ClickedCamera {
  Photograph photograph;  ///< pose and lens (SIMPLE_RADIAL); no name, no file
  std::vector<double> errors_px;
};

/// The most probable camera of a picture of this size, for clicks that are off by a pixel (standard
/// deviation), a principal point that is off the picture's centre by a hundredth of its width, and little
/// distortion; `focal_px`, where it is known (EXIF), is off by some hundredths. First estimates are the
/// direct linear transformation and the homography of the points' plane (Hartley and Zisserman 2004,
/// sections 7.1 and 8.1.1), for points may lie on the ground alone; Levenberg and Marquardt's method refines
/// each. Errors: fewer than six points, points on a
/// line, points that no camera explains (of seven or more, the one that does not fit the others is named).
Result<ClickedCamera> camera_of_points(std::span<const ClickedPoint> points, int width, int height,
                                       std::optional<double> focal_px = std::nullopt);

}  // namespace parvis::photographs
