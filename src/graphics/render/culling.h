// What a view may show, for drawables to choose by: the same answers for all of them.
#pragma once

#include "graphics/render/frustum.h"
#include "graphics/render/occlusion.h"
#include "graphics/render/screen_scale.h"
#include "graphics/render/view.h"

namespace parvis::render {

/// How a thing stands in the scene.
struct Standing {
  bool is_dynamic = false;
  bool is_newcomer = false;  ///< static, and appeared or was put where it is in this frame
};

/// Valid while the view is prepared.
class Culling {
 public:
  /// `occluders` as they were drawn for this view; null: nothing is hidden by others.
  Culling(const View& view, const OcclusionCuller* occluders)
      : view_(view),
        frustum_(view.clip_of_part() * view.clip_from_world),
        scale_(view),
        occluders_(occluders) {}

  /// Is the view to show object or thing `number` at all? Its subjects, and what it lists and leaves out.
  bool shows(int number, Standing standing) const;
  /// May anything within these bounds fall into the view? (What a mirror shows may stand anywhere.)
  bool may_see(const Bounds& bounds) const;
  /// Is all of it behind occluders? Ask last: it is the most expensive.
  bool is_hidden(const Bounds& bounds) const { return occluders_ && occluders_->hides(bounds); }
  /// At the nearest point of the bounds' sphere; infinity where the eye may be within.
  float pixels_per_metre(const Bounds& bounds) const { return scale_.pixels_per_metre(bounds); }
  const Frustum& frustum() const { return frustum_; }

 private:
  const View& view_;
  Frustum frustum_;
  ScreenScale scale_;
  const OcclusionCuller* occluders_;
};

}  // namespace parvis::render
