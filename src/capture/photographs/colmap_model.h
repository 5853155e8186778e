// COLMAP's sparse models as their files hold them (https://colmap.github.io/format.html), text and binary, in
// and out. colmap_set.h turns them into photograph sets and back.
//
// Files are untrusted: every count is checked against the bytes that are left before memory is taken for it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "capture/photographs/lens.h"

namespace parvis::photographs {

/// A place in an image where a point may have been seen.
struct ColmapKeypoint {
  glm::dvec2 pixel{0.0};
  std::int64_t point_id = -1;  ///< -1: no point
};

/// A registered image. Its pose is opencv_from_world: rotation (w, x, y, z), then translation.
struct ColmapImage {
  std::uint32_t id = 0, camera_id = 0;
  glm::dvec4 rotation_wxyz{1.0, 0.0, 0.0, 0.0};
  glm::dvec3 translation{0.0};
  std::string name;
  std::vector<ColmapKeypoint> keypoints;
};

/// A triangulated point; its track names keypoints by image and index.
struct ColmapPoint {
  std::int64_t id = 0;
  glm::dvec3 position{0.0};
  glm::u8vec3 colour{0};
  double error_px = 0.0;
  /// A keypoint of an image.
  struct Sighting {
    std::uint32_t image_id = 0, keypoint = 0;
  };
  std::vector<Sighting> track;
};

/// A whole model, as its files order it.
struct ColmapModel {
  std::map<std::uint32_t, Lens> cameras;  ///< by CAMERA_ID
  std::vector<ColmapImage> images;
  std::vector<ColmapPoint> points;
};

/// The text of the three files of a model, or their bytes.
struct ColmapFiles {
  std::string cameras, images, points;
};

/// Reads cameras.txt, images.txt, points3D.txt. `folder` stands in errors, which carry line numbers. All that
/// is wrong is reported, up to 20 problems.
Result<ColmapModel> parse_colmap_text(const ColmapFiles& files, const std::filesystem::path& folder);
/// Reads cameras.bin, images.bin, points3D.bin (little-endian). Errors name the file and the byte.
Result<ColmapModel> parse_colmap_binary(const ColmapFiles& files, const std::filesystem::path& folder);

/// The text files of a model; numbers read back exactly.
ColmapFiles colmap_text(const ColmapModel& model);
/// The binary files of a model.
ColmapFiles colmap_binary(const ColmapModel& model);

/// Reads the model in `folder`: the binary files where all are there, else the text files, as COLMAP does.
Result<ColmapModel> read_colmap_model(const std::filesystem::path& folder);
enum class ColmapFormat { text, binary };
/// Writes the three files, each whole or not at all. The folder is made.
Status write_colmap_model(const std::filesystem::path& folder, const ColmapModel& model, ColmapFormat format);

}  // namespace parvis::photographs
