#include "reflections/local_maps/local_map_slots.h"

#include <algorithm>
#include <numbers>

#include "reflections/local_maps/local_map_mesh.h"

namespace parvis::local_maps {

float shift_texels(float moved_m, float nearest_m, int tile) {
  const float texels_per_radian = float(tile - 2 * local_map_border) * 2.0f / std::numbers::pi_v<float>;
  return moved_m / std::max(nearest_m, 1e-3f) * texels_per_radian;
}

void LocalMapSlots::begin_frame(int slots, bool are_new) {
  slots_.resize(std::size_t(slots));
  for (Slot& slot : slots_) ++slot.idle_frames;
  if (are_new) forget();
}

void LocalMapSlots::forget() {
  for (Slot& slot : slots_) slot.map.reset();
}

/// Rays leave a body at its surface: nothing that it mirrors is nearer to its centre than that.
std::optional<int> LocalMapSlots::find(const LocalMapWish& wish) {
  if (wish.shows_others) return std::nullopt;
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const std::optional<LocalMapWish>& map = slots_[i].map;
    if (!map || map->shows_others || map->tile != wish.tile || map->smallest_texels != wish.smallest_texels)
      continue;
    const float nearest_m = std::max(slots_[i].nearest_m, std::min(map->body_radius_m, wish.body_radius_m));
    if (shift_texels(glm::distance(map->centre, wish.centre), nearest_m, wish.tile) > max_shift_texels)
      continue;
    slots_[i].idle_frames = 0;
    return int(i);
  }
  return std::nullopt;
}

std::optional<int> LocalMapSlots::take(const LocalMapWish& wish) {
  const auto idlest = std::ranges::max_element(slots_, {}, &Slot::idle_frames);
  if (idlest == slots_.end() || idlest->idle_frames == 0) return std::nullopt;
  *idlest = {wish, 0.0f, 0};
  return int(idlest - slots_.begin());
}

void LocalMapSlots::set_nearest(int slot, float nearest_m) {
  slots_[std::size_t(slot)].nearest_m = nearest_m;
}

}  // namespace parvis::local_maps
