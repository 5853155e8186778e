// Edits of a design: each command is a struct of typed arguments with a text form, and a function from the
// design as it is to what changes. Mouse, keys, panels, messages of scripts and parvis plan --do use the
// same.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "planning/design/design_nodes.h"

namespace parvis::design {

/// Names of objects of the design.
using Names = std::vector<std::string>;

/// A height that is not given: the object rests on what is below it. Of a way: what rested rests again, and
/// what stood higher by hand keeps its height.
inline constexpr double rests = -1e30;

/// The heights that a command left open, in the order in which it asks for them, so that it does the same
/// again in a place that has changed; empty: they are not known yet. Its text ends with "heights Z,Z,...".
using OpenHeights = std::vector<double>;

/// insert KIND X,Y[,Z] [heading DEG] [width M] [depth M] [height M] [colour #RRGGBB] [material NAME] [name
/// NAME]
struct Insert {
  std::string kind;
  glm::dvec3 position{0.0, 0.0, rests};
  double heading_deg = 0.0;
  std::optional<double> width = {}, depth = {}, height = {};
  std::string colour = {}, material = {}, name = {};  ///< empty: as usual for the kind; the next free name
};
/// move NAMES by DX,DY[,DZ], or to X,Y[,Z]: the first object stands there, the others keep their distance to
/// it.
struct Move {
  Names names;
  glm::dvec3 by = glm::dvec3(0.0);
  bool is_absolute = false;  ///< `by` is where the first goes
  OpenHeights heights = {};
};
/// turn NAMES by DEG [about X,Y], or to DEG
struct Turn {
  Names names;
  double degrees = 0.0;
  bool is_absolute = false;
  std::optional<glm::dvec2> about = {};  ///< none: each about its own foot
  OpenHeights heights = {};
};
/// resize NAMES [by FACTOR] [width M] [depth M] [height M]; resize NAMES width M changes the width alone
struct Resize {
  Names names;
  double factor = 1.0;
  std::optional<double> width = {}, depth = {}, height = {};
};
/// delete NAMES
struct Delete {
  Names names;
};
/// duplicate NAMES by DX,DY[,DZ]
struct Duplicate {
  Names names;
  glm::dvec3 by{0.0};
  OpenHeights heights = {};
};
/// row KIND from X,Y to X,Y count N, or spacing M; [heading DEG]: without one, the fronts look across the row
struct Row {
  std::string kind;
  glm::dvec2 from{0.0}, to{0.0};
  int count = 0;           ///< 0: by the spacing
  double spacing_m = 0.0;  ///< 0: by the count
  std::optional<double> heading_deg = {};
  OpenHeights heights = {};
};
/// space NAMES: evenly, between the first and the last
struct Space {
  Names names;
  OpenHeights heights = {};
};
/// align NAMES x|y|z|heading: with the first
struct Align {
  Names names;
  std::string what;
  OpenHeights heights = {};
};
/// group NAMES as NAME; ungroup NAMES
struct Group {
  Names names;
  std::string group;  ///< empty: none
};
/// lock NAMES; unlock NAMES
struct Lock {
  Names names;
  bool locks = true;
};
/// colour NAMES #RRGGBB; material NAMES MATERIAL
struct Paint {
  Names names;
  std::string colour, material;  ///< empty: as it is
};
/// swap NAMES for KIND: in place, with the usual size of that kind
struct Swap {
  Names names;
  std::string kind;
};
/// apply NAME to NAMES: its size, colour and material
struct Apply {
  std::string from;
  Names names;
};
/// surface MATERIAL X,Y[,Z] X,Y[,Z] X,Y[,Z] ... [colour #RRGGBB] [name NAME]
struct Surface {
  std::string material;
  std::vector<glm::dvec3> outline;
  std::string colour = {}, name = {};
};
/// measure distance|area|height|slope X,Y[,Z] X,Y[,Z] ... [name NAME]
struct Measure {
  std::string quantity;  ///< of quantity_names
  std::vector<glm::dvec3> points;
  std::string name = {};
};
/// point NAME N to X,Y[,Z]: the Nth point of a measurement, or corner of a surface, from 1 on, goes there
struct MovePoint {
  std::string name;
  int number = 1;
  glm::dvec3 to{0.0, 0.0, rests};
};
/// kind NAME FILE WIDTH,DEPTH,HEIGHT: the model in a file below the scene's folder becomes a kind
struct TakeKind {
  std::string name, file;
  glm::dvec3 size_m{1.0};
};
/// view NAME X,Y,Z heading DEG pitch DEG [fov DEG | parallel M]: a camera of the design; one of that name is
/// replaced. `fov_deg` is horizontal at 16:9, `parallel_m` the height of what a parallel projection shows.
struct KeepView {
  std::string name;
  glm::dvec3 position{0.0};
  double heading_deg = 0.0, pitch_deg = 0.0, fov_deg = 65.0;
  std::optional<double> parallel_m = {};
};
/// rename NAME as NAME
struct Rename {
  std::string from, to;
};

using Command = std::variant<Insert, Move, Turn, Resize, Delete, Duplicate, Row, Space, Align, Group, Lock,
                             Paint, Swap, Apply, Surface, Measure, MovePoint, TakeKind, KeepView, Rename>;

/// The command that keeps a camera as a view.
KeepView view_of(const Camera& camera, const std::string& name);

/// A command's change of one object.
struct Change {
  std::optional<scene::Node> before, after;  ///< none: it is not there
  std::string behind =
      {};  ///< of one that comes or goes: the name of the one that stands behind it; empty: none
};
using Changes = std::vector<Change>;

/// A design as commands see it.
struct DesignView {
  const scene::Scene& scene;
  const scene::LiveScene& live;
  const scene::Node* design;  ///< null: there is none yet
  /// Height of what objects rest on, without the objects that are named; empty: 0.
  std::function<double(glm::dvec2 at, const Names& without)> resting_height = {};
};

/// The changes of a command; none are made. Errors: names and kinds that do not exist, what is locked, sizes
/// out of bounds, no names at all, a place that is taken or too far away. Where `refusals` is given, a place
/// that is taken is reported there and is no error: for those who show what would be.
Result<Changes> changes_of(const DesignView& view, const Command& command, Errors* refusals = nullptr);

/// The command with all that it leaves open filled in, so that it does the same again: names and heights.
Result<Command> resolved(const DesignView& view, Command command);

/// Reads the text form. The error says what the command expects.
Result<Command> parse_command(std::string_view text);
/// The text form, which `parse_command` reads as the same command.
std::string text_of(const Command& command);
/// A sentence for people: "inserted bench_wood_7", "moved 12 objects by 0.40 m".
std::string sentence_of(const Command& command);

/// One line for each command, for help.
const std::vector<std::string>& command_forms();

}  // namespace parvis::design
