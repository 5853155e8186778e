// A place seen from above: the highest point of what stands on each cell of the ground, as an orthographic
// top view shows it. Cities are nearly that: what stands on the ground reaches up from it without a gap.
#pragma once

#include <vector>

#include "base/bounds.h"
#include "base/image.h"
#include "base/mesh.h"

namespace parvis::shading {

class Heightfield {
 public:
  /// A field over the horizontal extent of `bounds`: square cells of `cell_m`, larger where more than
  /// `max_cells_per_side` of them would be needed.
  explicit Heightfield(const Bounds& bounds, float cell_m = 1.0f, int max_cells_per_side = 2048);
  /// Raises the cells whose middle a mesh covers. Leave out what light passes: leaves, railings. `region`:
  /// only cells that this box touches.
  void add(const Mesh& mesh, const glm::mat4& world_from_mesh, const Bounds* region = nullptr);
  /// Lowers the cells that a box touches to the place's lowest height.
  void clear(const Bounds& region);

  /// Metres at a point of the ground; the place's lowest height outside of it.
  float height_m(glm::vec2 position) const;
  const Bounds& bounds() const { return bounds_; }
  float cell_m() const { return cell_m_; }
  /// One channel, metres; row 0 is south.
  const ImageF& heights() const { return heights_; }

 private:
  struct Cells {
    glm::ivec2 first, last;
  };
  Cells cells_of(const Bounds& box) const;
  void add_triangle(const glm::vec3 (&corners)[3], const Cells& allowed);

  Bounds bounds_;
  float cell_m_ = 1.0f;
  ImageF heights_;
};

}  // namespace parvis::shading
