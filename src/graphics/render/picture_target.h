// Main render target: 4x MSAA, resolved to linear radiance, then tone-mapped.
#pragma once

#include <algorithm>
#include <glm/vec2.hpp>

#include "base/image.h"
#include "base/result.h"
#include "graphics/gl/program.h"
#include "graphics/render/whole_screen.h"

namespace parvis::render {

inline constexpr int samples_per_pixel = 4;

class PictureTarget {
 public:
  static Result<PictureTarget> create();

  /// Its textures grow with it and never shrink: a size that changes from frame to frame allocates nothing.
  void resize(int width, int height);
  int width() const { return width_; }
  int height() const { return height_; }

  /// To draw into: RGBA16F and depth, multisampled.
  GLuint framebuffer() const { return multisampled_.name(); }
  /// Brings the samples together to linear radiance, one value a pixel, weighed for a picture of this
  /// exposure.
  void resolve(float exposure);
  /// Tone-maps into the first `size` pixels of a framebuffer, enlarged where there are more than were drawn.
  void display(GLuint framebuffer, glm::ivec2 size, float exposure) const;

  // Readbacks wait for the GPU: for stills and tests. Films read through render/picture_reader.h.
  /// Tone-maps and lets the GPU copy the picture, bottom row first, RGBA, into the bound pixel pack buffer.
  void start_reading(float exposure, GLsizeiptr bytes) const;
  Image8 read_picture(float exposure) const;
  ImageF read_radiance() const;

 private:
  PictureTarget(gl::Program resolve, gl::Program display);

  int width_ = 0, height_ = 0;
  glm::ivec2 room_{0};  ///< of the textures
  gl::Program resolve_, display_;
  WholeScreen screen_;
  gl::Texture samples_, sample_depth_, radiance_, picture_;
  gl::Framebuffer multisampled_, resolved_, displayed_;
};

/// Turns what OpenGL reads back (bottom row first) upright.
template <class Image>
void flip_rows(Image& image) {
  const std::ptrdiff_t row = std::ptrdiff_t(image.width) * image.channels;
  for (int y = 0; y < image.height / 2; ++y)
    std::swap_ranges(image.pixels.begin() + y * row, image.pixels.begin() + (y + 1) * row,
                     image.pixels.begin() + (image.height - 1 - y) * row);
}

}  // namespace parvis::render
