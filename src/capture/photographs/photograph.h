// Calibrated photographs as plain data: what the rooms of capture (facades, trees) and photomontage share.
//
// Poses are Parvis's: world_from_camera is rigid, right-handed, x east, y north, z up; the camera looks
// along -z, y up (base/camera.h). Readers turn other conventions on the way in, writers on the way out:
// COLMAP and OpenCV cameras look along +z with y downward.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "capture/photographs/lens.h"

namespace parvis::photographs {

/// A photograph with its camera.
struct Photograph {
  std::string name;  ///< unique in its set: the file's path below the set's folder, '/' between parts
  std::filesystem::path file;  ///< where the pixels are; empty where only the camera is known
  std::filesystem::path mask;  ///< grey picture of the same size, 0 = do not use; empty: every pixel is used
  Lens lens;                   ///< with the picture's size
  int orientation =
      1;  ///< EXIF's, of pixels as stored (CIPA DC-008): which side was up; 1: the top, or unknown
  glm::dmat4 world_from_camera{1.0};  ///< rigid
  glm::dvec3 gain{1.0, 1.0,
                  1.0};  ///< linear Rec. 709 times this is comparable between the photographs of a set
  double reprojection_error_px = -1.0;  ///< mean over its observations; negative: not known

  glm::dvec3 position_in_world() const { return glm::dvec3(world_from_camera[3]); }
  glm::dvec3 forward_in_world() const { return -glm::dvec3(world_from_camera[2]); }
  glm::dvec3 up_in_world() const { return glm::dvec3(world_from_camera[1]); }
};

/// One sighting of a point: an index into the set's photographs and the pixel where it was seen.
struct Observation {
  int photograph = -1;
  glm::dvec2 pixel{0.0};
};

/// A point of the place that several photographs see.
struct SparsePoint {
  glm::dvec3 position_in_world{0.0};
  glm::u8vec3 colour{128};                ///< sRGB
  double reprojection_error_px = 0.0;     ///< mean; 0 where the file has none
  std::vector<Observation> observations;  ///< ordered by photograph; a photograph may come twice
};

/// Photographs of one place, and the points they have in common (none where a source has none).
struct PhotographSet {
  std::vector<Photograph> photographs;  ///< ordered by name
  std::vector<SparsePoint> points;
  /// The transform from the frame in which the cameras were given, or found, to the world of this set: a
  /// rotation and a scale, kept by `transform` (alignment.h). Data measured in that frame, as a scan, follow
  /// by it.
  glm::dmat4 world_from_given{1.0};
};

/// The photograph of this name, or nothing.
const Photograph* find(const PhotographSet& set, const std::string& name);

/// The pixel where a point of the world appears; nothing where it has no image (see lens.h). May lie outside
/// of the picture.
std::optional<glm::dvec2> pixel_of_world(const Photograph& photograph, glm::dvec3 position_in_world);

/// The unit direction in the world of what appears at a pixel, from the photograph's position.
std::optional<glm::dvec3> direction_in_world(const Photograph& photograph, glm::dvec2 pixel);

/// Distance along the camera's axis, metres; negative behind the camera.
double distance_along_axis(const Photograph& photograph, glm::dvec3 position_in_world);

/// Parvis camera at a photograph's place. Exact where the lens has no distortion, square pixels and a
/// centred principal point; else the nearest such camera, to look through. Draw with clip_from_camera
/// (lens.h) where pixels have to agree.
Camera camera_of(const Photograph& photograph);
/// A photograph by a house camera.
Photograph photograph_of(const Camera& camera, std::string name, int width, int height);

/// The pose in the convention of OpenCV and COLMAP: world to a camera with x right, y downward, z forward.
glm::dmat4 opencv_from_world(const Photograph& photograph);
/// Parvis's pose of a camera from such a one.
glm::dmat4 world_from_camera_of_opencv(const glm::dmat4& opencv_from_world);

}  // namespace parvis::photographs
