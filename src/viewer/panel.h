// The panel beside the picture: how to move, scenarios, light, traffic; the scene's nodes; statistics. It
// closes with a key, and the picture stands beside it, not below it.
#pragma once

#include <algorithm>
#include <functional>
#include <string>

#include "viewer/frame_statistics.h"
#include "viewer/imgui_context.h"
#include "viewer/panel_nodes.h"
#include "viewer/visit.h"
#include "viewer/window_hearing.h"

namespace parvis::viewer {

class Panel {
 public:
  /// `title` names the scene; the context outlives the panel.
  Panel(const ImguiContext& imgui, std::string title, design::Language language = design::Language::english);

  bool is_open = false;
  bool shows_keys = false;
  float text_size = 1.0f;     ///< of all that is written and pressed, over the usual; 1 to 3
  float notices_foot = 0.0f;  ///< how high above the foot of the picture notices stand, in ImGui's units
  bool shows_design_alone = false;  ///< without what a participant of a study must not see or change

  /// Makes the text larger by a quarter of the usual for 1, smaller for -1.
  void step_text_size(int step) { text_size = std::clamp(text_size + 0.25f * float(step), 1.0f, 3.0f); }
  /// Width of the panel in ImGui's units; 0 where the panel is closed.
  float width() const;
  /// Draws the panel if it is open, the keys if they are asked for, and notices to the visitor; called
  /// between ImguiContext's begin_frame and draw. `hearing`: what is heard; null: there is no such row.
  void draw(Visit& visit, const FrameStatistics& statistics, Hearing* hearing = nullptr);

  /// Rows of a page of its own before all others, "Design"; empty: there is none.
  std::function<void(PanelRows&)> design_page = {};
  /// Turns to that page.
  void turn_to_design() { turns_to_ = page_of_design; }
  /// Turns to the page of the scene's nodes, and to this one.
  void choose(const scene::LiveScene& live, const scene::Node& node);
  const scene::Node* chosen() const { return nodes_.chosen(); }

  /// Places of the last frame's rows.
  const Places& places() const { return rows_.places(); }

 private:
  void draw_panel(Visit& visit, const FrameStatistics& statistics, Hearing* hearing);
  void draw_visit(Visit& visit);
  void draw_scenarios(Visit& visit);
  void draw_light(Visit& visit);
  void draw_sun(Visit& visit);
  void draw_hour(Visit& visit, const scene::Node& day_light);
  void draw_processes(Visit& visit);
  void draw_sound(Hearing& hearing);
  void draw_statistics(Visit& visit, const FrameStatistics& statistics);
  void draw_keys() const;
  void draw_notices(const Visit& visit) const;

  static constexpr const char *page_of_nodes = "Scene", *page_of_design = "Design";

  const ImguiContext& imgui_;
  std::string title_, driver_;
  bool draws_on_processor_;
  PanelRows rows_;
  PanelNodes nodes_;
  const char* turns_to_ = nullptr;  ///< in the next frame, a page; null: none
};

}  // namespace parvis::viewer
