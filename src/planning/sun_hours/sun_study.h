// A sun study of a scene: hours of direct sun on its ground and its facades, as a plan, a table and a
// coloured model, and the rule of BRE 209 for open space.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/image.h"
#include "base/mesh.h"
#include "machines/processes.h"
#include "planning/sun_hours/sun_ground.h"
#include "planning/sun_hours/sun_hours.h"
#include "scene/data/scene.h"

namespace parvis::sun_hours {

struct SunStudyOptions {
  SunPeriod period;
  double cell_m = 2.0;  ///< of the plan, and the longest edge of the coloured model's triangles
  /// x and y of two corners of what is studied; absent: all that stands still, without land to the horizon.
  std::optional<glm::dvec4> area;
  bool has_facades = true;
  JudgedGround judged = {};            ///< what the rule of open space is asked of
  machines::Processes processes = {};  ///< that divide the points among them; all call and all get the study
};

/// A cell of the plan.
struct GroundCell {
  enum class Kind : unsigned char { nothing, ground, built };
  Kind kind = Kind::nothing;
  bool is_judged = false;    ///< by the rule of open space
  glm::vec3 position{0.0f};  ///< of the ground, or of the roof of what is built there
  float hours = 0.0f;
};

/// BRE 209 (Littlefair 2022, Site layout planning for daylight and sunlight), section 3.3: of an open space
/// at least half should have two hours of sun on 21 March.
struct OpenSpaceRule {
  static constexpr double min_hours = 2.0, min_share = 0.5;
  double share = 0.0;    ///< of the judged ground
  double area_m2 = 0.0;  ///< of the judged ground
  /// True if enough of the open space has the hours.
  bool is_kept() const { return share >= min_share; }
};

/// Hours of direct sun on the ground, as a grid, and on all surfaces, as a mesh.
struct SunStudy {
  int columns = 0, rows = 0;
  glm::dvec2 corner{0.0};                ///< least x and y
  double cell_m = 0.0, max_hours = 0.0;  ///< what an open plain has
  std::vector<GroundCell> cells;         ///< row 0 is the southernmost
  Mesh surfaces;                         ///< uv.x is the hours' share of `max_hours`
  std::vector<float> surface_hours;      ///< of each of their vertices
  /// Ground under surfaces that face down alone (a building inside out), which counts as built.
  double covered_m2 = 0.0;
  bool is_chosen = false;  ///< SunStudyOptions::judged says which ground is judged
};

/// Ground is the surface hit from above, below leaves and less than 2.5 m above the lowest surface within
/// 20 m; the rest is built. What `judged` names is ground wherever it lies. Refused where the area would have
/// more than 16 million cells or 12 million vertices, where a name is none of the scene's, and where nothing
/// of the judged ground is seen from above in the area.
Result<SunStudy> study_sun(const scene::Scene& scene, const SunStudyOptions& options);

/// The point of a surface from which a study looks for the sun: 2 cm off it.
SunPoint lifted(glm::vec3 position, glm::vec3 normal);

/// The rule's result for the judged ground of a study of 21 March; its area is 0 where there is none.
OpenSpaceRule open_space_rule(const SunStudy& study);

/// The area and the share that has the hours, as "1234 m2, 61.5 % with 2 h or more".
std::string to_string(const OpenSpaceRule& rule);

/// PREFIX.png (sun_plan.h), PREFIX.csv (x, y, z, kind, hours of each cell, and 1 where it is judged) and, of
/// a study that has surfaces, PREFIX_facades.csv (position, normal and hours of each vertex of what stands
/// upright) and PREFIX.glb (ground and facades in the same colours, which PREFIX_sun_hours.jpg beside it
/// holds).
Status write_sun_study(const std::filesystem::path& prefix, const SunStudy& study);

}  // namespace parvis::sun_hours
