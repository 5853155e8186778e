// Pictures for films, read while the GPU already draws the next ones: nothing waits.
#pragma once

#include <deque>
#include <optional>

#include "graphics/render/renderer.h"

namespace parvis::render {

class PictureReader {
 public:
  /// Starts reading the renderer's picture, and gives the one that was started two calls before, if any.
  std::optional<Image8> next(Renderer& renderer, float exposure);
  /// Gives, one a call, the pictures that are still under way; then nothing.
  std::optional<Image8> rest();

 private:
  struct Pending {
    gl::Buffer pixels;
    int width, height;
  };
  Image8 take();

  std::deque<Pending> pending_;
  std::optional<gl::Buffer> spare_;  ///< of the last picture taken, and its size
  GLsizeiptr spare_bytes_ = 0;
};

}  // namespace parvis::render
