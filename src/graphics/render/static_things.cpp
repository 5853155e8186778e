#include "graphics/render/static_things.h"

namespace parvis::render {

void StaticThings::begin_update(std::size_t count, bool look_alike) {
  change_ = {}, fixed_ = {};
  look_alike_ = look_alike;
  for (std::size_t i = count; i < bounds_.size(); ++i)
    if (!bounds_[i].empty()) change_.gone.push_back(bounds_[i]);
  things_.resize(count, {nullptr, glm::mat4(1.0f), false, {}, {}});
  bounds_.resize(count);
  is_newcomer_.assign(count, 0);
}

void StaticThings::update(std::size_t number, const StaticThing& thing) {
  StaticThing& kept = things_[number];
  fixed_.add(thing.solid);
  const bool is_same = look_alike_ && kept.shape == thing.shape && kept.is_visible == thing.is_visible &&
                       kept.world_from_thing == thing.world_from_thing;
  kept = thing;
  if (is_same) return;
  Bounds& bounds = bounds_[number];
  if (!bounds.empty()) change_.gone.push_back(bounds), change_.has_moved = true;
  bounds = thing.is_visible ? thing.bounds : Bounds();
  if (thing.is_visible) change_.come.push_back(bounds), is_newcomer_[number] = 1;
}

}  // namespace parvis::render
