// What stands near to the reflectors of a frame, a list for each.
#pragma once

#include "reflections/methods/reflections.h"

namespace parvis::reflector_maps {

class NearObjects {
 public:
  void begin_frame() { count_ = 0; }
  /// The number of a reflector's list; below 0 where nothing stands near.
  int find(const render::Renderer& renderer, int object, float within_m) {
    if (lists_.size() == count_) lists_.emplace_back();
    return methods::find_near(renderer, object, within_m, lists_[count_]) ? int(count_++) : -1;
  }
  /// A flag for each of the scene's objects; null, all of them, for numbers below 0.
  const std::vector<std::uint8_t>* list(int number) const {
    return number < 0 ? nullptr : &lists_[std::size_t(number)];
  }

 private:
  std::vector<std::vector<std::uint8_t>> lists_;  ///< as many as a frame ever needed
  std::size_t count_ = 0;                         ///< of this frame
};

}  // namespace parvis::reflector_maps
