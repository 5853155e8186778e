// The objects of a design as plain data: what plan drawings, tables and other programs are given.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "planning/design/words.h"

namespace parvis::design {

/// An object that a design places, or a ground surface of it.
struct PlacedObject {
  std::string name;             ///< unique in the scene
  std::string design;           ///< that it belongs to
  std::string kind;             ///< of the catalogue: "bench_wood"; of a ground surface "ground"
  std::string label, label_fr;  ///< what people call the kind, in English and French
  std::string group;            ///< objects of one name are selected together; empty: none
  /// Where its foot stands, in the scene's frame; with Scene::origin added, in map coordinates.
  glm::dvec3 position{0.0};
  double heading_deg = 0.0;  ///< clockwise from north: of its front, away from which a bench's back stands
  glm::dvec3 size_m{0.0};    ///< width along its front, depth, height
  /// Its plan in the scene's frame, counter-clockwise, at least three corners.
  std::vector<glm::dvec2> outline;
  glm::vec3 colour{0.5f};  ///< linear Rec. 709
  std::string material;    ///< empty: the kind's own
  bool is_round = false;   ///< the outline is a circle or an ellipse in short steps
  bool is_locked = false;
  bool is_visible = true;
};

/// The same objects, labelled for people who read this language.
std::vector<PlacedObject> labelled_in(Language language, std::vector<PlacedObject> objects);

/// The corners of a rectangle about `centre`, `size_m` wide and deep, whose front looks to `heading_deg`.
/// Counter-clockwise, from its left front corner on.
std::vector<glm::dvec2> rectangle_outline(glm::dvec2 centre, glm::dvec2 size_m, double heading_deg);

/// The ellipse in that rectangle, with `corners` (3 or more) at even angles.
std::vector<glm::dvec2> ellipse_outline(glm::dvec2 centre, glm::dvec2 size_m, double heading_deg,
                                        int corners = 32);

/// Area of a plan in square metres, positive where it runs counter-clockwise.
double signed_area_m2(const std::vector<glm::dvec2>& outline);

}  // namespace parvis::design
