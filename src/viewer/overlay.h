// What a planner sees over the picture: outlines of what is pointed at, selected and moved, snaps, distances,
// corners, the scale of a plan.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "viewer/planning.h"
#include "viewer/theme.h"

namespace parvis::viewer {

/// Draws lines and numbers with Dear ImGui, behind its windows.
class Overlay {
 public:
  /// Draws the overlay; called between ImguiContext's begin_frame and draw. The picture fills `size` from the
  /// window's upper left, in ImGui's units, which are `scale` times those of a small screen.
  void draw(Planning& planning, ImVec2 size, float scale);

 private:
  struct Pen;
  /// The corners of a model's hull, nearly: its farthest points along many directions, in its own frame.
  const std::vector<glm::vec3>& extremes(const std::shared_ptr<const scene::Model>& model);
  void draw_outline(const Pen& pen, const scene::Object& object, ImU32 colour, float width);
  void draw_named(Planning& planning, const Pen& pen, const std::string& name, ImU32 colour, float width);
  static void draw_prism(const Pen& pen, const design::PlacedObject& object, ImU32 colour, float width);
  static void draw_differences(const Planning& planning, const Pen& pen);
  static void draw_split(const Planning& planning, const Pen& pen);
  static void draw_measurements(Planning& planning, const Pen& pen);
  void draw_held(Planning& planning, const Pen& pen);

  std::map<std::shared_ptr<const scene::Model>, std::vector<glm::vec3>> extremes_;
};

}  // namespace parvis::viewer
