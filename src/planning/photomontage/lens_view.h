// A picture of the renderer's that holds all that a photograph's lens sees.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "base/camera.h"
#include "base/result.h"
#include "capture/photographs/photograph.h"

namespace parvis::photomontage {

/// A pinhole camera at the photograph's place, and the size of its picture: each pixel of the photograph lies
/// in it, `oversampling` pixels for one in the photograph's middle. Where the lens has no distortion, the
/// picture is the photograph's, in finer pixels.
struct LensView {
  Camera camera;
  int width = 0, height = 0;  ///< pixels

  /// Where the drawn picture shows what the photograph's pixel does; nothing where the lens sees nothing.
  std::optional<glm::dvec2> drawn_pixel(const photographs::Lens& lens, glm::dvec2 pixel) const;
};

/// Errors: a lens that sees further than 75 degrees from its axis, a picture of more than 64 million pixels.
Result<LensView> view_of(const photographs::Photograph& photograph, int oversampling);

}  // namespace parvis::photomontage
