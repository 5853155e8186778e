// How a camera's lens maps directions to pixels: the eleven camera models of COLMAP 3.8
// (src/colmap/base/camera_models.h; https://colmap.github.io/cameras.html), forward and inverse.
//
// Frames: the camera's is Parvis's (x right, y up, it looks along -z; base/camera.h). Pixels count from
// the top left corner of the picture, x to the right, y downward, pixel centres at +0.5, as COLMAP has them.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string_view>

#include "base/camera.h"

namespace parvis::photographs {

/// COLMAP's camera models; the values are COLMAP's MODEL_ID.
enum class LensModel {
  simple_pinhole = 0,
  pinhole = 1,
  simple_radial = 2,
  radial = 3,
  opencv = 4,
  opencv_fisheye = 5,
  full_opencv = 6,
  fov = 7,
  simple_radial_fisheye = 8,
  radial_fisheye = 9,
  thin_prism_fisheye = 10,
};
inline constexpr int lens_model_count = 11;
inline constexpr int max_lens_parameters = 12;

/// COLMAP's name of a model ("SIMPLE_RADIAL") and the names of its parameters in order ("f, cx, cy, k").
struct LensModelInfo {
  LensModel model;
  std::string_view name;
  std::string_view parameter_names;
  int parameter_count;
  int focal_count;  ///< 1: f; 2: fx, fy. The principal point follows, then the distortion.
};
/// All models, ordered by MODEL_ID.
std::span<const LensModelInfo> lens_models();
/// The entry of one model.
const LensModelInfo& info(LensModel model);
/// Nothing for a name that is none of COLMAP 3.8's.
std::optional<LensModel> lens_model_of_name(std::string_view name);

/// Size of a picture and how its lens projects.
struct Lens {
  LensModel model = LensModel::pinhole;
  int width = 0, height = 0;  ///< pixels
  std::array<double, max_lens_parameters>
      parameters{};  ///< in the order of the model, in pixels and COLMAP's units

  bool operator==(const Lens&) const = default;
};

/// A lens without distortion.
Lens pinhole_lens(int width, int height, double fx, double fy, double cx, double cy);
/// The lens of a house camera with this vertical field of view (radians): square pixels, centred.
Lens centred_lens(int width, int height, double vertical_fov);

glm::dvec2 focal_px(const Lens& lens);            ///< (fx, fy)
glm::dvec2 principal_point_px(const Lens& lens);  ///< (cx, cy)
bool is_pinhole(const Lens& lens);  ///< no distortion: the model has none, or all its terms are 0

/// The pixel where a point or direction of the camera's frame appears. Nothing where the model has no image
/// of it: behind the camera (pinhole family), or beyond the angle where the distortion folds back on itself.
/// The pixel may lie outside of the picture.
std::optional<glm::dvec2> pixel_of(const Lens& lens, glm::dvec3 position_in_camera);

/// The unit direction in the camera's frame that appears at a pixel: the inverse of `pixel_of`, by Newton's
/// method to 1e-9 of the focal length. Nothing where no direction appears there.
std::optional<glm::dvec3> direction_of(const Lens& lens, glm::dvec2 pixel);

bool is_inside(const Lens& lens, glm::dvec2 pixel);  ///< of the picture

/// The same lens for the picture resampled to another size: pixels' corners are kept, distortion is not
/// touched.
Lens resized(const Lens& lens, int width, int height);

/// The lens without distortion for a picture undistorted from one of `lens`: the same size, focal length and
/// principal point.
Lens undistorted(const Lens& lens);

/// The vertical field of view, radians, along the column of the principal point. Of the undistorted lens.
double vertical_fov(const Lens& lens);

/// OpenGL's projection for an undistorted lens, with its off-centre principal point: clip x of -1 is the
/// picture's left edge, clip y of 1 its top edge. Distances in metres.
glm::dmat4 clip_from_camera(const Lens& undistorted_lens, double near_m, double far_m);

}  // namespace parvis::photographs
