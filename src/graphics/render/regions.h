// Regions of a place in which something has changed, so that only they are rebuilt.
#pragma once

#include <vector>

#include "base/bounds.h"

namespace parvis::render {

/// Do two boxes share ground?
inline bool overlap_from_above(const Bounds& a, const Bounds& b) {
  return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y;
}

/// The boxes, those as one that share ground when each is `margin_m` wider on all sides.
inline std::vector<Bounds> united(std::vector<Bounds> boxes, float margin_m) {
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Bounds wider{boxes[i].min - 2.0f * margin_m, boxes[i].max + 2.0f * margin_m};
      if (!overlap_from_above(wider, boxes[j])) continue;
      boxes[j].add(boxes[i]);
      boxes.erase(boxes.begin() + std::ptrdiff_t(i));
      i = 0;  // the larger one may touch others; none is before the first
      break;
    }
  return boxes;
}

}  // namespace parvis::render
