// How large the main view is drawn: smaller where a frame would not hold its budget, and enlarged when it is
// shown.
#pragma once

#include <glm/vec2.hpp>

namespace parvis::render {

class PictureScale {
 public:
  /// Takes the time of the last frame; those that follow are drawn with fewer pixels or with more, as
  /// `budget_ms` has it (0: none, all pixels). Frames within a few percent of it leave the size alone.
  void frame_took(double frame_ms, double budget_ms);

  /// The size at which a picture of this size is drawn: at least one pixel.
  glm::ivec2 drawn_size(int width, int height) const;
  /// Are pictures drawn as small as they become?
  bool is_smallest() const;

 private:
  double pixels_ = 1.0;  ///< the share of them that is drawn
};

}  // namespace parvis::render
