// Visibility of things in a view: every drawable asks the same questions and gets the same answers.
#pragma once

#include "graphics/render/frustum.h"
#include "graphics/render/occlusion.h"
#include "graphics/render/screen_scale.h"
#include "graphics/render/view.h"

namespace parvis::render {

/// State of a thing in the scene.
struct Standing {
  bool is_dynamic = false;
  bool is_newcomer = false;  ///< static, and appeared or was put where it is in this frame
};

/// Frustum, occlusion and selection tests of one view; valid while that view is prepared.
class Culling {
 public:
  /// `occluders` as rendered for this view; null: no occlusion culling.
  Culling(const View& view, const OcclusionCuller* occluders)
      : view_(view),
        frustum_(view.clip_of_part() * view.clip_from_world),
        scale_(view),
        occluders_(occluders) {}

  /// True if the view selects object or thing `number`: by its subjects and by its lists of shown and
  /// excluded objects.
  bool shows(int number, Standing standing) const;
  /// False if nothing within the bounds can be visible in the view. (A mirrored view may show things at any
  /// place.)
  bool may_see(const Bounds& bounds) const;
  /// True if the bounds lie behind occluders. The most expensive test: call it last.
  bool is_hidden(const Bounds& bounds) const { return occluders_ && occluders_->hides(bounds); }
  /// Image resolution at the nearest point of the bounds' sphere, pixels per metre; infinity where the eye
  /// may be within.
  float pixels_per_metre(const Bounds& bounds) const { return scale_.pixels_per_metre(bounds); }
  /// Planes of the part of the view that is drawn, in the world.
  const Frustum& frustum() const { return frustum_; }

 private:
  const View& view_;
  Frustum frustum_;
  ScreenScale scale_;
  const OcclusionCuller* occluders_;
};

}  // namespace parvis::render
