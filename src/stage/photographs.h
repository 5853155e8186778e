// A series of photographs of a scene by path tracing, with the files that reconstruction needs: pictures,
// depth, alpha, cameras. No OpenGL.
#pragma once

#include <atomic>
#include <filesystem>
#include <vector>

#include "graphics/reference/photograph.h"
#include "scene/data/scene.h"

namespace parvis::stage {

/// Cameras and outputs of photographs; a path that is empty is not written. Where there are several cameras,
/// "_NAME" goes before the extension of pictures (series_files). No two may be the same file.
struct PhotographJob {
  std::vector<scene::NamedCamera> cameras;  ///< as they stand; their `follows` is not looked at
  int width = 1280, height = 960;
  reference::PhotographOptions options;  ///< checkpoints and progress are set by the job
  std::vector<std::filesystem::path>
      pictures;                        ///< .exr and .hdr: linear radiance; others: tone-mapped, 8-bit
  std::filesystem::path depth, alpha;  ///< .exr in metres along the axis, 0 for the sky; 8-bit picture
  std::filesystem::path colmap_folder, gltf_cameras;
};

/// Cameras evenly on a level circle, looking at its middle raised to `target`; named "circle_01" and so on.
Result<std::vector<scene::NamedCamera>> circle_of_cameras(glm::vec3 target, float radius_m,
                                                          float eye_above_target_m, int count,
                                                          float vertical_fov);

/// Takes all photographs; the first of several processes writes the files. A job that is interrupted (or
/// killed) goes on where it stopped when it is called again: finished tiles lie in files ".checkpoint" beside
/// the first picture until all is written.
Status take_photographs(const scene::Scene& scene, const PhotographJob& job);

}  // namespace parvis::stage
