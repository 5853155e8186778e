// The plan of a scene: what is cut 1 m above the ground, edges of roads, low things, trees, and the objects
// of its designs.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "planning/design/measurement.h"
#include "planning/design/placed_object.h"
#include "planning/design/words.h"
#include "scene/data/scene.h"

namespace parvis::plan_drawing {

/// The subject of a line of a plan; each is a layer of the DXF.
enum class PlanLayer : unsigned char { wall, road, thing, plant, drawing };

/// A polyline in the scene's frame; a closed one has its first point again at the end.
struct PlanLine {
  PlanLayer layer = PlanLayer::wall;
  std::vector<glm::dvec3> points;
  glm::vec3 colour{0.0f};  ///< of a drawing's line, linear
  double width_m = 0.0;    ///< of a drawing's line; 0: as thin as others

  /// Whether it returns to its first point.
  bool is_closed() const { return points.size() > 3 && points.front() == points.back(); }
};

/// A text of a drawing.
struct PlanText {
  std::string text;  ///< UTF-8; lines separated by \n
  glm::dvec2 position{0.0};
  double height_m = 0.5, angle_deg = 0.0;
  glm::dvec2 anchor{0.0};  ///< as DrawingText::anchor
};

/// A tree at its foot.
struct PlanTree {
  std::string name;
  glm::dvec3 position{0.0};
  double crown_radius_m = 1.0, height_m = 1.0;
};

/// A measurement of a design, and what a drawing shows of it.
struct PlanMeasure {
  design::Measurement measured;
  std::vector<glm::dvec3> line;  ///< design::Measurement::line
  glm::dvec3 middle{0.0};        ///< where the text stands
  std::string text;              ///< its value with a unit, UTF-8

  /// The measure with all members from the measurement.
  static PlanMeasure of(const design::Measurement& measured) {
    return {measured, measured.line(), measured.middle(), measured.text()};
  }
};

/// All that a plan shows, in the scene's frame.
struct ScenePlan {
  glm::dvec3 origin{0.0};  ///< map coordinates of the frame's origin; zero: the scene is not on a map
  std::string map;         ///< as Scene::map: "EPSG:2154"; empty: unknown
  std::vector<PlanLine> lines;
  std::vector<PlanTree> trees;
  std::vector<PlanText> texts;
  std::vector<design::PlacedObject> placed;  ///< of designs, and what blocks of drawings stand for
  std::vector<PlanMeasure> measured;         ///< of designs
  std::vector<std::string> left_out;         ///< what a plan cannot hold, for its reader

  /// The middle of what is placed, or of everything.
  glm::dvec2 middle() const;
};

/// How high above the ground walls are cut, metres: below sills, above seats.
inline constexpr float section_height_m = 1.0f;

/// The plan of all static, visible things. `placed`: the objects of designs, which are left out of the rest
/// where they are the scene's objects of the same name. `words`: of what it says to be left out.
ScenePlan plan_of(const scene::Scene& scene, std::vector<design::PlacedObject> placed,
                  const std::vector<design::Measurement>& measured = {}, const design::Words& words = {});

}  // namespace parvis::plan_drawing
