// A second ray tracer, in double precision and without Embree, for judging the first: opaque triangles in a
// tree of boxes that are halved at their medians.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "scene/data/scene.h"

namespace parvis::bench {

/// A copy of a scene's static and visible objects with their opaque parts alone, without textures: what both
/// tracers can tell exactly.
scene::Scene opaque_twin(const scene::Scene& scene);

/// The visible parts that `opaque_twin` leaves out, as if they were solid: where one of them lies on a line,
/// the tracers need not agree.
scene::Scene rest_of_twin(const scene::Scene& scene);

/// Which side of a triangle stops a ray. Rays that see are stopped by fronts; rays to the sun by backs, as
/// the sun sees their fronts.
enum class StoppedBy : unsigned char { front, back, both };

/// Rays against the triangles of an opaque_twin.
class DoubleTracer {
 public:
  explicit DoubleTracer(const scene::Scene& twin);

  /// A triangle along a ray.
  struct Hit {
    double distance_m;
    glm::dvec3 normal;  ///< unit, of the triangle's front
  };
  /// The nearest triangle farther than `min_m` along unit `direction`.
  std::optional<Hit> nearest(glm::dvec3 origin, glm::dvec3 direction, double min_m, StoppedBy side) const;
  /// True if there is one.
  bool is_blocked(glm::dvec3 origin, glm::dvec3 direction, double min_m, StoppedBy side) const {
    return nearest(origin, direction, min_m, side).has_value();
  }

 private:
  struct Triangle {
    std::array<glm::dvec3, 3> corners;
    glm::dvec3 centre() const { return (corners[0] + corners[1] + corners[2]) / 3.0; }
  };
  struct Box {
    glm::dvec3 min{1e300}, max{-1e300};
    int first = 0, count = 0;  ///< triangles of a leaf
    int second_child = 0;      ///< of an inner box, whose first child is the next one
  };
  void divide(int first, int count);

  std::vector<Triangle> triangles_;
  std::vector<Box> boxes_;
};

}  // namespace parvis::bench
