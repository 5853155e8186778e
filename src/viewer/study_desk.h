// A study in the window: what participants read and answer, and what is logged of what they do.
#pragma once

#include <chrono>

#include "planning/study/session.h"
#include "viewer/imgui_context.h"
#include "viewer/panel_rows.h"
#include "viewer/planning.h"

namespace parvis::viewer {

class StudyDesk {
 public:
  /// All arguments outlive it. Puts the tool into the participant's hand and shows the present part.
  StudyDesk(study::Session& session, Planning& planning, const ImguiContext& imgui);

  /// Lets time go on and shows the part that has begun. Before anything else of a frame: a replay does these
  /// things in the order in which they are logged.
  void begin_frame();
  /// Logs the frame that took `frame_s`, when the scene has advanced.
  void add_frame(double frame_s);
  /// Draws the instruction, or the questions, over a picture of this width, in ImGui's units; called between
  /// ImguiContext's begin_frame and draw.
  void draw(float picture_width);
  /// Whether this window has nothing more to show: the next part is in another scene, or thanks were read.
  bool has_ended() const { return has_ended_; }

  /// Rectangles of the widgets of the last frame.
  const Places& places() const { return places_; }

 private:
  void show_part();
  void draw_instruction(float width);
  void draw_questions(float width);
  void draw_question(const study::Questionnaire& questionnaire, const study::Question& question);
  void draw_thanks(float width);
  bool button(const char* name);
  std::string word(const char* english) const { return planning_.word(english); }

  study::Session& session_;
  Planning& planning_;
  const ImguiContext& imgui_;
  std::chrono::steady_clock::time_point began_;
  std::int64_t last_us_ = 0;                  ///< time of the last frame
  std::size_t shown_;                         ///< index of the part that is shown
  std::map<std::string, std::string> texts_;  ///< that are being typed
  std::string told_trouble_;
  bool has_ended_ = false;
  Places places_;
};

}  // namespace parvis::viewer
