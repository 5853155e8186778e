// Occlusion culling on the CPU, without readback: large triangles of the static scene, and those of
// dynamic objects near the eye (a queue of cars hides most of itself), are rasterised at a low resolution;
// a box is hidden where all its pixels lie behind them (after Greene 1993, Hierarchical Z-Buffer Visibility,
// and Collin 2011, Culling the Battlefield). It never hides what can be seen through a gap of a pixel or more
// of its own resolution: depth is the farthest of a pixel and its eight neighbours.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "base/bounds.h"
#include "base/mesh.h"

namespace parvis::render {

class OcclusionCuller {
 public:
  /// Adds the triangles of an opaque, fixed mesh that are large enough to hide something. Unless `has_backs`,
  /// they are not there when seen from behind: the camera may stand within a house.
  void add_occluder(const Mesh& mesh, const glm::mat4& world_from_mesh, bool has_backs);

  void clear() { corners_.clear(); }

  /// Keeps an opaque mesh that moves; returns the number by which `draw` knows it, or -1 where it has too
  /// many triangles to be rasterised on the CPU.
  int add_shape(const Mesh& mesh, bool has_backs);

  /// A shape as it stands now.
  struct PlacedShape {
    int shape;
    glm::mat4 world_from_mesh;
  };
  /// Draws the occluders for a view.
  void draw(const glm::mat4& clip_from_world, std::span<const PlacedShape> placed = {});
  /// Is the whole box behind occluders of the view drawn last? False where it reaches behind the eye.
  bool hides(const Bounds& box) const;

  std::size_t occluder_count() const { return corners_.size() / 3; }

 private:
  /// A triangle on the screen: edge functions and 1/w, all linear in the pixel's position, as (x, y,
  /// constant).
  struct ScreenTriangle {
    glm::vec3 edges[3];
    glm::vec3 inverse_w;
    float farthest_inverse_w;
    int min_x, max_x, min_y, max_y;
  };

  static void project(const glm::mat4& clip_from_corners, const glm::vec3* corners,
                      std::vector<ScreenTriangle>& out);
  void rasterise(const ScreenTriangle& triangle, int first_row, int end_row);
  void take_farthest_of_neighbours();

  std::vector<glm::vec3> corners_;              ///< three for each occluder, in the world
  std::vector<std::vector<glm::vec3>> shapes_;  ///< the same, in each shape's frame
  glm::mat4 clip_from_world_{1.0f};
  std::vector<std::vector<ScreenTriangle>> projected_;  ///< one list for each task
  std::vector<float> inverse_w_;                        ///< nearest occluder; 0: none
  std::vector<float> row_minima_, farthest_;
};

}  // namespace parvis::render
