// The planner's bars about the picture: tools at the left edge, views and designs above, the catalogue and
// what the next click does below; and the inspector, a page of the panel.
#pragma once

#include <filesystem>
#include <string>

#include "viewer/command_line.h"
#include "viewer/imgui_context.h"
#include "viewer/kind_pictures.h"
#include "viewer/overlay.h"
#include "viewer/panel_rows.h"
#include "viewer/planning.h"

namespace parvis::viewer {

class PlanningBars {
 public:
  /// Both outlive it. `pictures`: where pictures of the catalogue are kept; empty: nowhere.
  PlanningBars(const ImguiContext& imgui, Planning& planning, std::filesystem::path pictures);

  /// Draws all bars and the overlay about a picture of this width, in ImGui's units; called between
  /// ImguiContext's begin_frame and draw. Draws nothing where the tool is put away.
  void draw(float picture_width);
  /// Rows of what is selected, within a window of the panel.
  void draw_inspector(PanelRows& rows);
  /// Height of what stood along the lower edge in the last frame, in ImGui's units.
  float height_below() const { return height_below_; }
  /// Rectangles of the widgets of the last frame.
  const Places& places() const { return places_; }

 private:
  bool button(const std::string& name, const char* key, bool is_lit, float width);
  void draw_icon(int icon, ImVec2 low, float side, ImU32 colour) const;
  void draw_tools(float height);
  void stay_on_line(float next_width, float gap, float width) const;
  void draw_views(float width);
  float draw_hint(float width);
  float draw_catalogue(float width, float foot);
  void draw_arrangement(PanelRows& rows, const std::vector<design::PlacedObject>& chosen);
  void draw_colours(PanelRows& rows, const design::PlacedObject& first, const std::string& names);
  void draw_lengths(PanelRows& rows, const design::PlacedObject& first);

  const ImguiContext& imgui_;
  Planning& planning_;
  Overlay overlay_;
  KindPictures pictures_;
  CommandLine commands_;
  std::string search_, tab_ = "all";
  float height_below_ = 0.0f;
  int resting_frames_ = 0;  ///< since a hand was at work
  Places places_;
};

}  // namespace parvis::viewer
