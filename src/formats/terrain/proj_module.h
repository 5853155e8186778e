// The module `proj`: what of this room knows PROJ.
#pragma once

#include "base/module.h"
#include "formats/terrain/map_projection.h"
#include "formats/terrain/map_system.h"

namespace parvis::scene {

/// A projected system of PROJ, east first.
class ProjectedMap {
 public:
  virtual ~ProjectedMap() = default;
  ProjectedMap() = default;
  ProjectedMap(const ProjectedMap&) = delete;
  ProjectedMap& operator=(const ProjectedMap&) = delete;

  /// Converts degrees (east, north) to the map's unit; not finite beyond the map.
  virtual glm::dvec2 forward(glm::dvec2 deg) const = 0;
  /// Back to degrees; not finite beyond the map.
  virtual glm::dvec2 inverse(glm::dvec2 in_unit) const = 0;
  /// Metres per unit.
  virtual double unit_m() const = 0;
};

/// The functions of the module that calls PROJ; map_system.h and map_projection.h say more.
struct ProjFunctions {
  std::optional<MapSystem> (*map_system)(int epsg);
  bool (*lies_in_area)(int epsg, glm::dvec2 on_map);
  std::optional<glm::dvec2> (*place_on_earth)(int epsg, glm::dvec2 on_map);
  std::shared_ptr<const ProjectedMap> (*utm)(int zone, bool is_south);
  std::shared_ptr<const ProjectedMap> (*map)(const std::string& system);  ///< null: none that is projected
};

/// Loaded in the workers' server when the first file is laid on a map.
inline constexpr Module<ProjFunctions> proj("proj");

/// The module's own `utm`.
std::shared_ptr<const ProjectedMap> utm_map(int zone, bool is_south);
/// The module's own `map`.
std::shared_ptr<const ProjectedMap> map_of_system(const std::string& system);

}  // namespace parvis::scene
