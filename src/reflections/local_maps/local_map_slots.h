// Assignment of slots to bodies, and reuse of maps that are still valid (Meyer and Loscos 2003, section 8,
// propose maps that serve several frames and several bodies).
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

namespace parvis::local_maps {

/// A local map as a body requests it.
struct LocalMapWish {
  glm::vec3 centre{0.0f};
  float body_radius_m = 0.0f;
  int tile = 0;                  ///< texels per side, border included
  float smallest_texels = 1.0f;  ///< of its mesh's quads
  bool shows_others = false;     ///< dynamic objects are drawn over it
};

/// Largest shift, in texels of a map of `tile` texels, of geometry at least `nearest_m` away when the map's
/// centre moves by `moved_m`.
float shift_texels(float moved_m, float nearest_m, int tile);

/// The slots and the maps in them.
class LocalMapSlots {
 public:
  /// A map serves another centre if its directions are off by no more than this: half a texel, as much as its
  /// filter blurs.
  static constexpr float max_shift_texels = 0.5f;

  /// Begins a frame. `are_new`: the texture was reallocated, so that all slots are empty.
  void begin_frame(int slots, bool are_new);
  /// Empties all slots: the surroundings have changed.
  void forget();

  /// A slot whose map satisfies the request, now used in this frame; empty if there is none.
  std::optional<int> find(const LocalMapWish& wish);
  /// The least recently used slot, for a new map; empty if all are used in this frame.
  std::optional<int> take(const LocalMapWish& wish);
  /// Stores the distance of the nearest geometry that the rays for a slot's new map have hit.
  void set_nearest(int slot, float nearest_m);

 private:
  struct Slot {
    std::optional<LocalMapWish> map;
    float nearest_m = 0.0f;
    int idle_frames = 1;  ///< 0: used in this frame
  };
  std::vector<Slot> slots_;
};

}  // namespace parvis::local_maps
