// Two designs of a scene in one window: each on its side of a line that can be moved, or side by side.
#pragma once

#include <cstdint>
#include <string>

#include "graphics/gl/objects.h"
#include "stage/stage.h"

namespace parvis::viewer {

/// How two designs are compared.
enum class ComparedView : unsigned char { colours, slider, side_by_side };

/// The pictures of two designs from one view. Needs a current OpenGL context.
class Comparison {
 public:
  /// Draws both where the scene, the view or the size has changed since, and once more in full resolution
  /// when they have come to rest. The scene shows `after` afterwards. `width`, `height`: of the window's
  /// part, pixels; side by side each has half of it.
  void draw(stage::Stage& stage, const Camera& camera, const std::string& before, const std::string& after,
            ComparedView view, glm::ivec2 size);
  /// Copies them into a framebuffer: `before` left of `split`, a share of the width, and `after` right of it;
  /// side by side both as a whole. `only_before`: leaves what is right as it is.
  void display(GLuint framebuffer, float split, bool only_before = false) const;

 private:
  /// A picture as it is displayed.
  struct Shown {
    gl::Texture texture;
    gl::Framebuffer framebuffer;
  };
  static void draw_one(stage::Stage& stage, const Camera& camera, const std::string& shown,
                       const std::string& hidden, glm::ivec2 size, bool is_whole, const Shown& into);

  Shown before_, after_;
  glm::ivec2 size_{0}, room_{0};  ///< of each picture; of its texture
  ComparedView view_ = ComparedView::colours;
  std::uint64_t state_ = 0;
  bool is_whole_ = false;
};

}  // namespace parvis::viewer
