// A scene as sound meets it: its ground, roofs and upright walls.
#pragma once

#include <memory>

#include "land/heights/height_raster.h"
#include "land/heights/place_heights.h"
#include "life/propagation/site.h"
#include "scene/data/scene.h"

namespace parvis::propagation {

/// Ground and roofs of a scene's static objects, seen from above by rays.
class SceneTerrain final : public Terrain {
 public:
  /// The scene counts without leaves, dynamic objects and land beyond the place.
  explicit SceneTerrain(const scene::Scene& scene);

  double ground_z(glm::dvec2 place) const override { return double(heights_.at(glm::vec2(place))); }
  double ground_factor(glm::dvec2 place) const override;
  std::optional<double> roof_z(glm::dvec2 place) const override;
  std::optional<double> ceiling_z(glm::dvec2 place) const override;
  void add_breaks(glm::dvec2 from, glm::dvec2 to, std::vector<double>& distances_m) const override;

  /// The plan that is covered: x and y of its lower left and upper right corners, metres.
  glm::dvec4 area() const;

 private:
  scene::PlaceHeights heights_;
  scene::HeightRaster roofs_m_;         // NaN where no building stands
  scene::HeightRaster ceilings_m_;      // NaN where nobody stands below a roof
  scene::GroundRaster<float> factors_;  // G
};

/// Upright surfaces of static objects: triangles that lie in one plane joined to walls that are longer than a
/// metre and rise 1.5 m or more over the ground. Walls with open ground on a side reflect with
/// `facade_absorption`. Those that begin over somebody's head, with open ground on both sides, are open
/// below: the fronts of arcades, balconies and bridges.
std::vector<Wall> walls_of(const scene::Scene& scene, const SceneTerrain& terrain);

/// Absorption of facades, which CNOSSOS-EU's users take where nothing is measured: 1 dB is lost.
inline constexpr double facade_absorption = 0.2;

/// The site of a scene; the terrain is the site's.
struct SceneSite {
  std::unique_ptr<SceneTerrain> terrain;
  std::unique_ptr<Site> site;
};
/// Terrain and walls of a scene.
SceneSite site_of(const scene::Scene& scene);

}  // namespace parvis::propagation
