// The sun of each pixel of a view by rays: exact where a surface fills the pixel, of the sun's disc where
// neither the view nor what stands before the pixel or between it and the sun moves.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "base/bounds.h"
#include "base/camera.h"
#include "graphics/gl/objects.h"
#include "graphics/reference/ray_scene.h"
#include "scene/data/sun_shadows.h"

namespace parvis::shadows {

class TracedSun {
 public:
  /// `rays` must be of reference::Precision::fine. The share of the sun that each pixel's middle sees, and
  /// how far away its surface is (0: the sky), as render::TracedSun wants them. While the view, the sun and
  /// the scene (`scene_version`) stay as they were in the last call, directions to the sun's disc are added,
  /// one per call up to `sun_samples`: shadows become soft, and nothing else is traced again but what the
  /// boxes of `moved` (RayScene::moved, since the last call) may hide or shade. A view that has jumped is a
  /// still of its own: it gets all of them at once.
  void trace(const reference::RayScene& rays, std::uint64_t scene_version, std::span<const Bounds> moved,
             const scene::SunLight& sun, const Camera& camera, int width, int height, int sun_samples);

  /// Two floats per pixel, bottom row first.
  const std::vector<glm::vec2>& pixels() const { return pixels_; }
  /// Waits for nothing: the upload is ordered before what is drawn next. Needs an OpenGL context.
  GLuint upload();
  /// Directions that the shares are the mean of, where they are fewest; 0: to the middle of the disc.
  int samples() const;

 private:
  struct View {
    glm::mat4 world_from_camera{0.0f}, clip_from_camera{0.0f};
    glm::ivec2 size{0};
    scene::SunLight sun;
    std::uint64_t scene_version = 0;
    bool operator==(const View&) const = default;
  };
  /// The surface in a pixel's middle.
  struct Surface {
    double distance_m = 0.0;  ///< 0: the sky
    glm::vec3 normal{0.0f};   ///< of the triangle, toward the viewer; of any length
  };
  class Tiles;
  class Touch;
  struct Tile;
  void find_surfaces(const reference::RayScene& rays, const Tile& tile);
  void add_sample(const reference::RayScene& rays, const Tile& tile, int sample);

  View view_;
  int limit_ = 0;  ///< samples of the disc; 0: its middle alone
  std::vector<glm::vec2> pixels_;
  std::vector<Surface> surfaces_;
  std::vector<std::uint16_t> lit_;  ///< how many directions were open
  std::vector<int> samples_;        ///< of each tile
  gl::Texture texture_;
  glm::ivec2 texture_size_{0};
};

}  // namespace parvis::shadows
