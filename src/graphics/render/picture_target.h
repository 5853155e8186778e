// Main render target: 4x MSAA, or one sample per pixel with smoothed edges; resolved to linear radiance, then
// tone-mapped.
#pragma once

#include <algorithm>
#include <glm/vec2.hpp>

#include "base/image.h"
#include "base/result.h"
#include "graphics/gl/program.h"
#include "graphics/render/whole_screen.h"

namespace parvis::render {

/// MSAA samples of the main view.
inline constexpr int samples_per_pixel = 4;

/// The main view's multisampled render target, its resolved radiance and its tone-mapped image. Call `resize`
/// before drawing.
class PictureTarget {
 public:
  /// Compiles the resolve and tone-mapping shaders; fails only if one does not compile.
  static Result<PictureTarget> create();

  /// Sets the size in pixels, and whether a pixel has one sample or `samples_per_pixel`. Textures grow and
  /// never shrink, so a size that changes from frame to frame allocates nothing.
  void resize(int width, int height, bool has_one_sample = false);
  int width() const { return width_; }    ///< pixels in use; the textures may be larger
  int height() const { return height_; }  ///< pixels in use

  bool has_one_sample() const { return has_one_sample_; }  ///< per pixel

  /// Framebuffer to draw into: RGBA16F and depth.
  GLuint framebuffer() const { return samples().framebuffer.name(); }
  /// Where a picture stands between a sketch and a photograph (scene::Realism), from the next `resolve` on.
  void set_realism(float level);
  /// Keeps the samples as they are, for `restore`; of multisampled pictures alone.
  void keep();
  /// Makes the samples what they were when they were kept, in this size.
  void restore();
  /// Resolves the samples to one linear radiance per pixel, each sample weighted by shading::sample_weight at
  /// this exposure. Where a pixel has one sample, edges are smoothed along themselves (Lottes 2009, FXAA).
  void resolve(float exposure);
  /// Tone-maps into the first `size` pixels of a framebuffer, enlarging where `size` exceeds the render
  /// target.
  void display(GLuint framebuffer, glm::ivec2 size, float exposure) const;

  // Readbacks wait for the GPU: for stills and tests. Films read through render/picture_reader.h.
  /// Tone-maps and starts an asynchronous copy of the image (RGBA, bottom row first) into the bound pixel
  /// pack buffer.
  void start_reading(float exposure, GLsizeiptr bytes) const;
  Image8 read_picture(float exposure) const;  ///< tone-mapped sRGB, RGBA, top row first
  ImageF read_radiance() const;               ///< resolved linear RGBA, before exposure, top row first

 private:
  struct Samples {
    glm::ivec2 room{0};  ///< of the textures
    gl::Texture colour, depth;
    gl::Framebuffer framebuffer;
  };

  PictureTarget(gl::Program resolve, gl::Program smooth, gl::Program display);
  const Samples& samples() const { return has_one_sample_ ? single_ : multiple_; }
  void copy(const gl::Texture& from, const gl::Texture& to) const;

  int width_ = 0, height_ = 0;
  bool has_one_sample_ = false;
  glm::ivec2 room_{0};  ///< of the textures
  gl::Program resolve_, smooth_, display_;
  WholeScreen screen_;
  Samples multiple_, single_, kept_;  ///< allocated when they are first needed
  gl::Texture radiance_, picture_;
  gl::Framebuffer resolved_, displayed_;
};

/// Reverses the rows of an image: OpenGL reads back the bottom row first.
template <class Image>
void flip_rows(Image& image) {
  const std::ptrdiff_t row = std::ptrdiff_t(image.width) * image.channels;
  for (int y = 0; y < image.height / 2; ++y)
    std::swap_ranges(image.pixels.begin() + y * row, image.pixels.begin() + (y + 1) * row,
                     image.pixels.begin() + (image.height - 1 - y) * row);
}

}  // namespace parvis::render
