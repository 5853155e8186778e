// Bookkeeping of a drawable's static things: where they are, and which of them appeared, vanished or were
// moved in the last update.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <vector>

#include "graphics/render/drawable.h"

namespace parvis::render {

/// A static thing as a drawable finds it in the scene.
struct StaticThing {
  const void* shape = nullptr;  ///< what is drawn; compared, not read
  glm::mat4 world_from_thing{1.0f};
  bool is_visible = true;
  Bounds bounds;  ///< in the world, whether or not it is visible
  Bounds solid;   ///< what of it may cast shadows, in the world
};

/// The static things of one drawable, by their number in it.
class StaticThings {
 public:
  /// Begins an update: there are `count` things now. `look_alike` false: all are drawn in another way than
  /// before, so that what is kept of their pictures is out of date.
  void begin_update(std::size_t count, bool look_alike = true);
  /// The thing of that number, which has changed if it has another shape or place, or was shown or hidden.
  void update(std::size_t number, const StaticThing& thing);

  /// Bounds in the world; empty while the thing is hidden.
  const Bounds& bounds(std::size_t number) const { return bounds_[number]; }
  /// True if it appeared or was moved in the last update.
  bool is_newcomer(std::size_t number) const { return is_newcomer_[number] != 0; }
  /// Extents of all things after the last update; see Extents.
  Extents extents() const { return {fixed_, {}, {}, bounds_, &change_}; }

 private:
  std::vector<StaticThing> things_;
  std::vector<Bounds> bounds_;
  std::vector<std::uint8_t> is_newcomer_;
  Bounds fixed_;
  FixedChange change_;
  bool look_alike_ = true;
};

}  // namespace parvis::render
