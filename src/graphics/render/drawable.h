// Interface of everything that is rendered. The renderer calls every drawable in every kind of view; its
// counterpart in the ray tracer is a scene::TracedKind of the same name (drawables.h), and the two are tested
// against each other.
#pragma once

#include <span>
#include <vector>

#include "base/bounds.h"
#include "graphics/render/culling.h"
#include "graphics/render/quality_budget.h"
#include "graphics/render/view.h"
#include "graphics/shading/body_shade.h"
#include "scene/data/scene.h"

namespace parvis::render {

/// Static things that appeared, vanished or were put elsewhere in one update.
struct FixedChange {
  std::vector<Bounds> gone;  ///< where one stood
  std::vector<Bounds> come;  ///< where one stands now
  bool has_moved = false;    ///< one stood elsewhere before

  bool empty() const { return gone.empty() && come.empty(); }
};

/// World bounds of a drawable after its last update; shadow maps and sky visibility are computed from them.
/// Valid until the next update.
struct Extents {
  Bounds fixed;                           ///< of all static things, hidden ones included
  std::span<const Bounds> moving;         ///< of each visible dynamic thing: it casts a shadow every frame
  std::span<const shading::Body> bodies;  ///< of those, what hides the sky from what is near it
  std::span<const Bounds> things;         ///< of all, in the order of their numbers; empty where hidden
  const FixedChange* fixed_change = nullptr;  ///< of the last update; null: none
};

/// Something that is rendered into every kind of view. Needs a current OpenGL context from creation to
/// destruction.
class Drawable {
 public:
  virtual ~Drawable() = default;
  /// Once a frame, before any view: takes over what changed in the scene.
  virtual void update(const scene::Scene&) {}
  /// Bounds after the last update; see Extents.
  virtual Extents extents() const = 0;

  /// What it wants of the frame's time for the main view: levels of detail, each with its cost and its worth.
  /// The renderer writes into `level` what each gets (the best where it has no budget), before
  /// `prepare`. The span stays valid until then.
  virtual std::span<QualityWish> quality_wishes(const View& /*main_view*/, const Culling&) { return {}; }

  /// Once for each view, before its passes: choose what it shows (`culling`) and how finely, and upload that.
  /// Other views are prepared and drawn between the main view's preparation and its drawing, so the main
  /// view's list must be kept apart.
  virtual void prepare(const View& view, const Culling& culling) = 0;
  /// Draws one pass of the view prepared last (or of the main view): the target is bound, the uniform block
  /// of frame.glsl is filled, depth is reversed but in shadow views. Light is bound in views that have
  /// colour. ViewPrograms has a program for every kind of view. Views of mirrors (ViewKind::mirrors) show
  /// reflectors alone.
  virtual void draw(const View& view, Pass pass) = 0;
};

}  // namespace parvis::render
