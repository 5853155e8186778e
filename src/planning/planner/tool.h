// The tool in a planner's hand: what pointer and keys do to a design, in any view. It knows nothing of
// windows: it takes the place of the pointer, and says what is under way.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/camera.h"
#include "planning/design/preview.h"
#include "planning/design/scene_surfaces.h"
#include "planning/planner/snap.h"

namespace parvis::planner {

/// The effect of the next click.
enum class Mode : unsigned char { select, insert, measure, surface };

/// A pointer in a picture.
struct Pointer {
  Camera camera;
  glm::ivec2 size{1};     ///< of the picture, pixels
  glm::dvec2 pixel{0.0};  ///< from its top left
  bool adds = false;      ///< Shift: to the selection; keeps right angles
  bool copies = false;    ///< Alt: a move leaves a copy
  bool is_free = false;   ///< Ctrl: nothing snaps
};

/// The present action of the pointer.
enum class Action : unsigned char { none, move, turn, resize, box, point };

/// A distance that is shown while something moves.
struct Dimension {
  glm::dvec3 from{0.0}, to{0.0};
  /// Length between its ends.
  double length_m() const { return glm::distance(from, to); }
};

/// One tool on one design.
class Tool {
 public:
  /// The arguments outlive the tool.
  Tool(const scene::Scene& scene, const scene::LiveScene& live, design::Session& session,
       design::SceneSurfaces& surfaces);

  /// Lines of the place to which points are drawn: kerbs, walls, drawings.
  void set_plan(std::vector<PlanSegment> lines) { plan_ = std::move(lines); }
  double grid_m = 0.1;  ///< of the grid that holds what nothing else holds; 0: none

  Mode mode() const { return mode_; }                ///< what the next click does
  Action action() const { return action_; }          ///< what is under way
  const std::string& kind() const { return kind_; }  ///< that the next click inserts
  /// Takes up a mode; what was under way is given up.
  void choose(Mode mode);
  /// Takes up insertion of a kind: the next clicks place it, again and again.
  void choose_kind(const std::string& kind);
  /// The material of the next surface.
  std::string surface_material = "paving";

  /// The quantity that the next clicks measure: two points, or the corners of an area.
  design::Quantity quantity() const { return quantity_; }
  /// Takes up measuring; where it is in hand already, the next quantity.
  void choose_measure();

  /// The pointer is there: shows what a click would do.
  void point(const Pointer& pointer);
  /// The pointer has left the picture.
  void leave();
  /// The button is pressed. False: the tool has no use for it, and the view may turn by it.
  bool press(const Pointer& pointer);
  /// It is let go. An error says why nothing was done.
  Status release(const Pointer& pointer);
  /// Is a drag under way that the tool uses?
  bool is_dragging() const { return is_pressed_; }
  /// Gives up what is under way, or the mode. False: there was nothing to give up.
  bool cancel();

  /// Begins to move, turn or resize what is selected by the pointer; a click ends it. Errors: nothing is
  /// selected.
  Status begin(Action action);
  /// Turns what hangs on the pointer, or what is selected, clockwise.
  Status turn(double degrees);
  /// Moves what is selected: keys. `ahead` and `right` in metres, along the axes of the plan that lie nearest
  /// to those of the view.
  Status nudge(const Camera& camera, double right_m, double ahead_m);
  /// A character of a number that is typed during a move; false: it is none.
  bool type(char character);
  /// The text typed so far.
  const std::string& typed() const { return typed_; }
  /// Ends a move at the typed distance, or a surface at its corners. Errors as the command's.
  Status confirm();

  /// Releases the object that was placed or moved last. It stands in the picture as the pointer held it,
  /// until this is called: then the picture may be drawn again, with its shadow.
  void settle();
  /// Is there anything of that kind?
  bool has_unsettled() const { return !unsettled_.empty(); }

  /// Objects that hang on the pointer or move with it, and those that have not settled.
  const design::Preview& preview() const { return preview_; }
  /// Why what hangs on the pointer cannot stand there; empty: it can.
  const std::string& refusal() const { return refusal_; }
  /// Name of the object below the pointer that a click would take; empty: none.
  const std::string& pointed() const { return pointed_; }
  /// The place below the pointer; none: the sky.
  const std::optional<glm::dvec3>& place() const { return place_; }
  /// The thing that held the moving point, and where.
  const Snapped& snapped() const { return snapped_; }
  /// Height at which the snapped point lies.
  double snapped_height_m() const { return snapped_height_m_; }
  /// Distances that are drawn: of a move, to neighbours.
  std::vector<Dimension> dimensions() const;
  /// Measurements of the design as they would be after a click; that which is being drawn is the last,
  /// without a name.
  std::vector<design::Measurement> measurements() const;
  /// Corners of a surface that is being drawn, with the pointer's as the last.
  std::vector<glm::dvec3> corners() const;
  /// The two corners of a box that selects, pixels; none: no box is drawn.
  std::optional<std::array<glm::dvec2, 2>> box() const;
  /// The effect of the next click, an English sentence of words.h.
  const char* hint() const;

  /// The object of the design that made this object or thing of the scene; null: none did.
  const scene::Node* object_at(int object) const;

 private:
  design::DesignView design_view() const { return session_.view(); }
  std::optional<glm::dvec3> on_level(const Pointer& pointer, double height_m) const;
  SnapTargets targets(const design::Names& without) const;
  double snap_within_m(const Pointer& pointer, glm::dvec3 at) const;
  glm::dvec3 snap_point(const Pointer& pointer, glm::dvec3 at, const design::Names& without,
                        const std::optional<glm::dvec2>& origin);
  void show(const std::optional<design::Command>& command);
  std::optional<design::Command> command_now() const;
  glm::dvec3 first_foot() const;
  design::Command move_by(glm::dvec2 by) const;
  void point_for_insertion(const Pointer& pointer);
  void point_for_action(const Pointer& pointer);
  Status run(const design::Command& command);
  Status finish();
  Status finish_points();
  bool draws_outline() const {
    return mode_ == Mode::surface || (mode_ == Mode::measure && quantity_ == design::Quantity::area);
  }
  void point_at_measurement(const Pointer& pointer);
  std::vector<design::Measurement> own_measurements() const;
  void select_in_box(const Pointer& pointer);
  void give_up();

  const scene::Scene& scene_;
  const scene::LiveScene& live_;
  design::Session& session_;
  design::SceneSurfaces& surfaces_;
  design::Preview preview_;
  std::vector<PlanSegment> plan_;

  Mode mode_ = Mode::select;
  Action action_ = Action::none;
  std::string kind_, pointed_, refusal_, typed_;
  double heading_deg_ = 0.0;
  bool is_pressed_ = false, follows_click_ = false;  ///< an action ends by letting go, or by a click
  bool copies_ = false;
  Pointer pointer_, pressed_;
  std::optional<glm::dvec3> place_, pressed_place_;
  glm::dvec3 grabbed_{0.0};  ///< where the action took hold
  glm::dvec3 anchor_{0.0};   ///< foot of the first object that moves, before it does
  glm::dvec2 moved_{0.0};    ///< of an action: the way so far
  double turned_deg_ = 0.0, factor_ = 1.0;
  design::Names unsettled_;
  std::optional<glm::dvec2> placed_at_;  ///< the pixel of the last click that placed something
  Snapped snapped_;
  double snapped_height_m_ = 0.0;
  std::vector<glm::dvec3> points_;  ///< of a surface or a measurement
  design::Quantity quantity_ = design::Quantity::distance;
  int pointed_end_ = -1;  ///< of the measurement that is pointed at; -1: none
  glm::dvec3 end_at_{0.0};
  std::vector<design::Measurement> held_;  ///< measurements that the command under way would change
};

}  // namespace parvis::planner
