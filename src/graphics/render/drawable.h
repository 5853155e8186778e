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

/// Static things that appeared, vanished or were moved in one update.
struct FixedChange {
  std::vector<Bounds> gone;  ///< former bounds
  std::vector<Bounds> come;  ///< new bounds
  bool has_moved = false;    ///< at least one was moved that is no object of the scene

  bool empty() const { return gone.empty() && come.empty(); }
};

/// World bounds of a drawable after its last update; shadow maps and sky visibility are computed from them.
/// Valid until the next update.
struct Extents {
  Bounds fixed;                    ///< union of all static things, hidden ones included
  std::span<const Bounds> moving;  ///< each visible dynamic thing: a shadow caster of every frame
  std::span<const shading::Body>
      bodies;                      ///< shapes of dynamic things that occlude the sky for surfaces near them
  std::span<const Bounds> things;  ///< every thing by its number; empty bounds where hidden
  const FixedChange* fixed_change = nullptr;  ///< of the last update; null: none
};

/// Something that is rendered into every kind of view. Needs a current OpenGL context from creation to
/// destruction.
class Drawable {
 public:
  virtual ~Drawable() = default;
  /// The number of its thing 0 (DrawableKind::make) is another one: there are more objects, or things before
  /// it.
  virtual void renumber(int /*first_thing*/) {}
  /// Called once per frame, before any view: takes over changes of the scene.
  virtual void update(const scene::Scene&) {}
  /// Bounds after the last update; see Extents.
  virtual Extents extents() const = 0;

  /// Its levels of detail for the main view, each with cost and worth. Before `prepare` the renderer writes
  /// the chosen level into `level` (the best if there is no budget); the span must stay valid until then.
  virtual std::span<QualityWish> quality_wishes(const View& /*main_view*/, const Culling&) { return {}; }

  /// Called once per view, before its passes: selects what the view shows (`culling`) and at which detail,
  /// and uploads it. Other views are prepared and drawn between the preparation of the main view and its
  /// drawing, so the main view's list must be kept separately.
  virtual void prepare(const View& view, const Culling& culling) = 0;
  /// Draws one pass of the view prepared last (or of the main view). The target is bound and the uniform
  /// block of frame.glsl is filled; depth is reversed except in shadow views; light is bound in views with
  /// colour. ViewPrograms has a program for every kind of view. Views of mirrors (ViewKind::mirrors) show
  /// reflectors only.
  virtual void draw(const View& view, Pass pass) = 0;
};

}  // namespace parvis::render
