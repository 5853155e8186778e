// What stands for a picture that is missing: seen at once, and loaded by no mistake.
#pragma once

#include "base/image.h"

namespace parvis::scene {

/// Magenta and grey squares, 64 x 64.
inline Image8 placeholder_picture() {
  Image8 picture(64, 64, 4, 255);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const bool is_magenta = ((x / 8) + (y / 8)) % 2 == 0;
      picture.at(x, y)[0] = is_magenta ? 220 : 96;
      picture.at(x, y)[1] = is_magenta ? 0 : 96;
      picture.at(x, y)[2] = is_magenta ? 200 : 96;
    }
  return picture;
}

}  // namespace parvis::scene
