// Occlusion culling on the processor, without readback: large triangles of the fixed scene are rasterised at
// a low resolution, and a box is hidden where all its pixels lie behind them (after Greene 1993, Hierarchical
// Z-Buffer Visibility, and Collin 2011, Culling the Battlefield). It never hides what can be seen through a
// gap of a pixel or more of its own resolution: depth is the farthest of a pixel and its eight neighbours.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
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

  /// Draws the occluders for a view.
  void draw(const glm::mat4& clip_from_world);
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

  void project(const glm::mat4& clip_from_world, std::size_t triangle,
               std::vector<ScreenTriangle>& out) const;
  void rasterise(const ScreenTriangle& triangle, int first_row, int end_row);
  void take_farthest_of_neighbours();

  std::vector<glm::vec3> corners_;  ///< three for each occluder, in the world
  glm::mat4 clip_from_world_{1.0f};
  std::vector<std::vector<ScreenTriangle>> projected_;  ///< one list for each task
  std::vector<float> inverse_w_;                        ///< nearest occluder; 0: none
  std::vector<float> row_minima_, farthest_;
};

}  // namespace parvis::render
