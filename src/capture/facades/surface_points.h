// Points of a facade's surfaces, evenly over their area, and what its photographs show there.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "base/random.h"
#include "capture/facades/facade_lookup.h"
#include "capture/facades/packed_facade.h"

namespace parvis::facades {

/// Triangles of a surface: the first, and one beyond the last.
using TriangleRun = std::pair<std::size_t, std::size_t>;

/// The runs of all surfaces but the backdrop, in their order.
std::vector<TriangleRun> runs_of_surfaces(const PackedFacade& facade);

/// The mean of the places that the photographs were taken from; the origin without any.
glm::vec3 middle_of_photographs(const PackedFacade& facade);

/// Points of a run of triangles, evenly over their area. The facade must outlive it.
class SurfacePoints {
 public:
  /// A point of one of its triangles.
  struct Point {
    std::size_t triangle;
    glm::vec2 barycentric;
    glm::vec3 position;  ///< in the facade's frame
  };

  SurfacePoints(const PackedFacade& facade, const TriangleRun& run);
  /// Another point; the same sequence of every run.
  Point next();
  /// Twice the area of the run, square units of the facade's frame.
  double area() const { return area_.back(); }

 private:
  const PackedFacade& facade_;
  std::size_t first_;
  std::vector<double> area_;  ///< summed over the triangles
  Random random_{7};
};

/// Exposed radiance that the photographs show of a point to an eye at `eye`; none where an artist's alpha has
/// a hole.
std::optional<glm::vec3> recorded_radiance(FacadeLookup& lookup, const SurfacePoints::Point& point,
                                           glm::vec3 eye);

}  // namespace parvis::facades
