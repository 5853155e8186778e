// Which slot of the picture of local maps each body uses, and when a map that is there already will do (Meyer
// and Loscos 2003, section 8, ask for maps that serve several frames and several bodies).
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

namespace parvis::local_maps {

/// A local map as a body wants it.
struct LocalMapWish {
  glm::vec3 centre{0.0f};
  float body_radius_m = 0.0f;
  int tile = 0;                  ///< texels a side, border included
  float smallest_texels = 1.0f;  ///< of its mesh's quads
  bool shows_others = false;     ///< bodies that move are to be drawn over it
};

/// How far, in texels of a map of `tile` texels, what lies `nearest_m` or farther away is shifted at most
/// when the map's centre moves by `moved_m`.
float shift_texels(float moved_m, float nearest_m, int tile);

class LocalMapSlots {
 public:
  /// A map whose directions are off by no more than this serves another centre, too: half a texel is what its
  /// filter blurs.
  static constexpr float max_shift_texels = 0.5f;

  /// More slots than before, all empty, or the same ones.
  void begin_frame(int slots, bool are_new);
  void forget();

  /// A slot whose map will do, used from now on in this frame.
  std::optional<int> find(const LocalMapWish& wish);
  /// One that is not used in this frame, the one unused for longest; its map will be this. Nothing: all are
  /// used.
  std::optional<int> take(const LocalMapWish& wish);
  /// What the rays for a slot's new map have met.
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
