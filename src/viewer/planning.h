// A visit as a planner: the designs of the scene, the tool on one of them, and the views in which it works.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "planning/design/difference.h"
#include "planning/design/words.h"
#include "planning/planner/tool.h"
#include "planning/study/session.h"
#include "viewer/comparison.h"
#include "viewer/visit.h"

namespace parvis::viewer {

/// Which of the planner's views one looks from.
enum class PlanningView : unsigned char { plan, street, balcony };

/// State and operations of planning in a visit. Failures become notices.
class Planning {
 public:
  /// The visit outlives it.
  Planning(Visit& visit, design::Language language);

  /// Is the tool in hand? Its bars are shown then.
  bool is_on() const { return is_on_; }
  /// Takes it up or puts it away. Taking it up opens the scene's first design, with its journal.
  void turn_on(bool on);
  bool shows_catalogue = false;      ///< along the lower edge
  bool shows_commands = false;       ///< the line in which commands are written
  bool awaits_command_keys = false;  ///< it was opened, and is not drawn yet: keys are meant for it
  /// The session that a participant works in, which logs what is done: no files are written then. Null: there
  /// is none.
  study::Session* study = nullptr;
  /// Whether journal and designs are written: of several processes that show one scene, the first does.
  bool keeps_files = true;

  planner::Tool* tool() { return desk_ ? &desk_->tool : nullptr; }          ///< null: no design is open
  design::Session* session() { return desk_ ? &desk_->session : nullptr; }  ///< null: no design is open
  /// The open design's name; empty: none is open.
  std::string open_name() const { return desk_ ? desk_->session.name() : std::string(); }
  Visit& visit() { return visit_; }  ///< as given
  /// Names of the scene's designs.
  std::vector<std::string> designs() const;
  /// Opens another design, shows it and hides the others.
  void open_design(const std::string& name);
  /// Begins another design, under the next free name, and hides the others.
  void begin_design();

  /// Compares the open design with the next one of the scene, and with the one behind it the next time, and
  /// at last with none.
  void compare_with_next();
  /// Differences of the open design from the one that it is compared with; empty: it is compared with none.
  std::vector<design::Difference> differences() const;
  /// The design that it is compared with; empty: none.
  const std::string& compared() const { return compared_; }

  /// Changes to the next way of comparison: in colours, with a slider, side by side, and so on; chooses the
  /// next design where none is compared.
  void next_compared_view();
  /// Are two pictures shown?
  bool compares_pictures() const;
  ComparedView compared_view() const { return compared_view_; }  ///< how the two designs are shown
  /// Where the pictures of the two designs meet, a share of the window's part: the other design lies left of
  /// it.
  float split() const { return compared_view_ == ComparedView::slider ? split_ : 0.5f; }
  /// Moves the place where they meet.
  void set_split(float share) { split_ = std::clamp(share, 0.0f, 1.0f); }
  /// Draws and displays both pictures.
  void draw_compared(int width, int height, GLuint framebuffer);
  /// Displays the other design's picture, as it was drawn last, over the frame that is displayed.
  void display_other(GLuint framebuffer) const { comparison_.display(framebuffer, split_, true); }

  /// Runs a command of the session; an error becomes a notice.
  bool run(const std::string& command);
  /// Makes a group of what is selected, under the next free name.
  bool group_selected();
  /// Makes a kind of a model file and takes it in hand.
  void take_file(const std::filesystem::path& file);
  /// Makes an error a notice; false: there was one.
  bool tell(const Status& status);
  /// Takes the last step back.
  void undo();
  /// Does the step again that was taken back last.
  void redo();
  /// Writes the design into its file, or beside the scene where it has none.
  void save();
  /// When it was saved last, "12:03:07"; empty: never.
  const std::string& saved_at() const { return saved_at_; }

  /// Takes a view; the flight there keeps the horizon.
  void look(PlanningView view);
  /// The next click on a wall takes the eye there.
  bool waits_for_balcony() const { return waits_for_balcony_; }
  /// Stands at a wall that the pointer shows, looking away from it. False: it shows none.
  bool stand_at(const planner::Pointer& pointer);
  /// Keeps the present view under a number 1 to 9, in the design.
  void keep_view(int number);
  /// Flies to the view that was kept under a number.
  void go_to_view(int number);
  /// Numbers of the views that are kept, ascending.
  std::vector<int> kept_views() const;
  /// Frames what is selected.
  void frame_selection();

  design::Language language() const { return language_; }  ///< as given
  /// A word of the tool in the planner's language.
  std::string word(std::string_view english) const { return design::in_language(english, language_); }
  /// Does anything hang on the pointer or move? The scene stands still meanwhile.
  bool holds_things() { return is_on_ && tool() && !tool()->preview().is_empty(); }
  /// Time passes in which the eye moves, the pointer moves, or neither: what was placed settles then.
  void step(float seconds, bool pointer_moves);
  /// Draws the frame with what is held.
  void draw_held(int width, int height);

 private:
  /// One design on the table.
  struct Desk {
    design::Session session;
    planner::Tool tool;
    std::filesystem::path file;  ///< in which it was saved last; empty: it was not
    Desk(stage::Simulation& simulation, design::Session opened, design::SceneSurfaces& surfaces)
        : session(std::move(opened)), tool(simulation.scene, simulation.live(), session, surfaces) {}
  };
  bool open(const std::string& design, bool begins = false);
  bool stands_at_wall() const { return stood_at_wall_ && visit_.navigation().mode() == Mode::fly; }
  void keep_steps_beside(const std::filesystem::path& file);
  std::string name_of_view(int number) const;
  const std::vector<planner::PlanSegment>& plan_lines();

  Visit& visit_;
  design::Language language_;
  std::shared_ptr<design::SceneSurfaces> surfaces_;
  bool is_on_ = false, waits_for_balcony_ = false, stood_at_wall_ = false;
  std::map<std::string, std::unique_ptr<Desk>> desks_;  ///< of the designs that were opened, by their names
  Desk* desk_ = nullptr;                                ///< that of the open one
  std::map<std::filesystem::path, std::string>
      known_;                          ///< scripts of designs, as they were loaded or saved last
  std::optional<Camera> street_view_;  ///< to which one comes back
  std::vector<planner::PlanSegment> plan_lines_;
  std::string saved_at_, compared_;
  ComparedView compared_view_ = ComparedView::colours;
  float split_ = 0.5f;
  Comparison comparison_;
  float quiet_s_ = 0.0f;  ///< for how long the pointer has rested
  glm::mat4 eye_{1.0f};   ///< in the last step
};

}  // namespace parvis::viewer
