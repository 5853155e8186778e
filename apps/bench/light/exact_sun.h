// A second ray tracer, in double precision and without Embree, for judging the first; what the pixels of a
// view truly see of the sun by it; views of a city from many places.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "base/camera.h"
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

/// The judged pixels of a picture of `width` x `height`: the first of each square of `step` x `step`, top row
/// first.
struct JudgedPixels {
  int width = 0, height = 0, step = 1;

  int columns() const { return (width + step - 1) / step; }
  int rows() const { return (height + step - 1) / step; }
  std::size_t count() const { return std::size_t(columns()) * std::size_t(rows()); }
};

/// The sun in the middle of each judged pixel: -1 nothing faces it, or nothing is known; 0 shadow, 1
/// light.
using SunPicture = std::vector<signed char>;

/// A middle is in shadow if the line from the very point that it shows to the middle of the sun crosses a
/// triangle whose front the sun sees: shadows as they are drawn. Where a surface of `unknown` (null: there
/// are none) may lie on the line from the eye, or on that to the sun, the pixel is -1.
SunPicture exact_sun(const DoubleTracer& tracer, const Camera& camera, const JudgedPixels& pixels,
                     glm::dvec3 to_sun, const DoubleTracer* unknown = nullptr);

/// The share of the sun in each judged pixel; 1 where nothing faces it.
using SunShares = std::vector<float>;

/// `share_at(x, y)`, y from the top, of each judged pixel of a picture.
template <class ShareAt>
SunShares judged_shares(const JudgedPixels& pixels, const ShareAt& share_at) {
  SunShares shares;
  shares.reserve(pixels.count());
  for (int y = 0; y < pixels.height; y += pixels.step)
    for (int x = 0; x < pixels.width; x += pixels.step)
      shares.push_back(share_at(std::size_t(x), std::size_t(y)));
  return shares;
}

/// The fraction from which on a pixel counts as lit.
inline constexpr float half_lit = 0.5f;

/// Wrong pixels among those of which a truth is known.
struct WrongSun {
  long wrong = 0, pixels = 0;

  /// Counts the pixels of one more picture.
  void add(const SunPicture& truth, const SunShares& shares);
  /// NaN of no pixels, which meets no target.
  double percent() const;
};

/// A unit direction to the sun turned sideways, along the great circle that is level there, by exactly so
/// many degrees: a control's sun. Not of a sun in the zenith.
glm::vec3 turned_sun(glm::vec3 to_sun, float degrees);

/// So many views of a picture's size, each above another point of the lanes where traffic drives: in turn
/// from the height of a person's eyes, of a balcony, of eyes again, and from above the roofs, steeply down;
/// in any heading. None stands inside of a body of `tracer`, which has the city's opaque_twin, or so near to
/// one that nothing else is seen. Fails where the city has no lanes, or too few places that are free.
std::vector<Camera> city_views(const scene::Scene& city, const DoubleTracer& tracer, std::size_t count,
                               int width, int height);

}  // namespace parvis::bench
