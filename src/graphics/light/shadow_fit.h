// Where shadow maps of the sun lie for a view: the methods of the thesis (perspective shadow maps) and those
// that came after, as projections of the world. Maps of one method share a memory of `resolution` x
// `resolution` texels.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "base/bounds.h"
#include "base/camera.h"

namespace parvis::light {

enum class ShadowMethod : unsigned char {
  uniform,   ///< one map over all that the view shows
  cascades,  ///< four maps over ranges of depth that the view really has (Lauritzen, Salvi and Lefohn 2011)
  perspective,  ///< one map of the space after the view's projection (Stamminger and Drettakis 2002)
  light_space_perspective  ///< one map warped along the view, seen from the light (Wimmer, Scherzer and
                           ///< Purgathofer 2004)
};
inline constexpr std::array shadow_method_names{"uniform", "cascades", "perspective",
                                                "light_space_perspective"};

/// A map: the world to its square (x and y from -1 to 1) and depth. Lines toward the sun are lines of equal x
/// and y.
struct ShadowMap {
  glm::dmat4 map_from_world{1.0};
  double max_depth_m = 1e30;  ///< of the view, up to which it serves; maps are ordered by it
  double share = 1.0;         ///< of the memory's side: a map has (share * resolution)^2 texels
};

/// The visible surfaces of a view: sampled positions of its surfaces and their depths along its axis, in
/// metres. From these the methods know how near and far the view really reaches: what the thesis calls
/// updateNear.
struct SeenSurfaces {
  std::vector<glm::vec3> positions;
  std::vector<float> depths_m;
};

/// The maps of a method. `casters` bounds everything that casts a shadow; `to_sun` is a unit vector above the
/// horizon. Nothing is seen: one map of the casters. Where the sun stands so that the perspective method has
/// no finite map - it is in the picture, or casters stand behind the viewer - its viewpoint moves back, as
/// its authors do, until there is one.
std::vector<ShadowMap> fit_shadow_maps(ShadowMethod method, const Camera& camera, glm::vec3 to_sun,
                                       const SeenSurfaces& seen, const Bounds& casters);

/// The point that a map of `resolution` texels per side compares for a point of the world: on the middle of
/// its texel, at its depth; and how large that texel is there, in metres.
struct TexelPoint {
  glm::dvec3 position;
  double size_m;
};
/// The texel of the map that `point` falls into.
TexelPoint texel_point(const ShadowMap& map, int resolution, glm::dvec3 point);

/// The map that serves a depth of the view.
const ShadowMap& map_for_depth(std::span<const ShadowMap> maps, double depth_m);

}  // namespace parvis::light
