// Plan drawings that stand in a scene.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "formats/drawings/drawing.h"
#include "scene/data/room_data.h"

namespace parvis::plan_drawing {

/// One of them; nodes make any number. Pictures show its objects; this is the drawing behind them, whose
/// lines others snap to.
struct PlacedDrawing {
  static constexpr std::string_view name = "plan_drawing.drawing";
  static constexpr scene::DataRole role = scene::DataRole::settings;  // its layers are objects

  std::string called;  ///< the node's name
  std::shared_ptr<const formats::Drawing> drawing;
  glm::dvec3 origin{0.0};           ///< of the plan's frame, in the drawing's coordinates
  glm::mat4 world_from_plan{1.0f};  ///< of points minus `origin`, their heights left out
  std::vector<bool> shows_layer;    ///< each of the drawing's layers
  /// Patterns of names of blocks, and the kinds of objects that they stand for (placed_blocks.h).
  std::vector<std::pair<std::string, std::string>> block_kinds;
  bool is_visible = true;

  /// A point of the drawing in the world.
  glm::vec3 in_world(const glm::dvec3& point) const {
    return glm::vec3(world_from_plan * glm::vec4(glm::vec2(point - origin), 0.0f, 1.0f));
  }

  /// Adds the drawing's extent and its place.
  void hash(ContentHash& hash) const {
    hash.add_text(called), hash.add(world_from_plan), hash.add(is_visible);
    if (drawing) hash.add(drawing->min), hash.add(drawing->max), hash.add(drawing->lines.size());
  }
};

}  // namespace parvis::plan_drawing
