// The points that vehicles will mirror, sampled by random rays from where they are likely to drive; and how
// well reference maps show it. The measure by which maps are placed, and by which any placement is judged.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "reflections/reference_maps/height_pyramid.h"
#include "scene/data/scene.h"

namespace parvis::reference_maps {

/// A point of the fixed scene that bodywork mirrors.
struct MirroredPoint {
  glm::vec3 position;
  glm::vec3 normal;         ///< of the height cell's side or top
  float vehicle_footprint;  ///< `footprint` of a map that was taken at the vehicle
};

/// Points met by rays from vehicles on the scene's lanes; where there are none, from `places` on the ground.
/// Rays start `bodywork_height_m` up and leave in all directions alike (as the mirror image of a round body
/// holds them) but steeply down, where bodywork shows its own shadow. Rays into the sky give no point, so
/// there are at most `count`. The same seed gives the same points.
std::vector<MirroredPoint> mirrored_points(const scene::Scene& scene, const HeightPyramid& heights,
                                           std::size_t count, std::uint64_t seed);

/// Metres of the surface at `point` that a radian of the picture of a map at `place` shows: the side of the
/// square whose area a texel covers there, by the texel's angle.
float footprint(glm::vec3 place, const MirroredPoint& point);

/// How many times wider a map's texel may be on a surface than that of a map at the vehicle.
/// This: a map need not be sharp to show a point.
inline constexpr float any_sharpness = std::numeric_limits<float>::infinity();

/// Whether a map at `place` sees the point (validity.glsl) with texels whose footprint is at most
/// `sharpness` times that of a map at the vehicle.
bool shows(const HeightPyramid& heights, glm::vec3 place, const MirroredPoint& point, float sharpness);

/// The share of the points, 0 to 1, that the first n of `places` show between them, for n = 1, 2, ...
std::vector<float> coverage(const HeightPyramid& heights, const std::vector<glm::vec3>& places,
                            const std::vector<MirroredPoint>& points, float sharpness = any_sharpness);

}  // namespace parvis::reference_maps
