// Registry of the kinds of things that rooms draw themselves: each with its drawable and its counterpart in
// the ray tracer.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "graphics/render/drawable.h"

namespace parvis::render {

/// One registered kind of drawable.
struct DrawableKind {
  /// Name, number of things in a scene, and what rays see of them. Needs no OpenGL.
  scene::TracedKind traced;
  /// Makes the drawable for all things of this kind in a scene that has some. `first_thing` is the number of
  /// thing 0: Culling::shows takes it, picking views write that number plus 1. Needs a current OpenGL 4.5
  /// context for its lifetime.
  std::function<Result<std::unique_ptr<Drawable>>(const scene::Scene& scene, int first_thing)> make;
};

/// The kinds of drawables that the program has; their names are unique.
class Drawables {
 public:
  /// Registers a kind. Asserts that its name is new and that `make`, `count` and `trace` are set: no drawable
  /// without ground truth.
  void add(DrawableKind kind);
  const DrawableKind* find(std::string_view name) const;  ///< null if no kind has that name
  /// The kinds in the order in which they were added.
  const std::vector<DrawableKind>& kinds() const { return kinds_; }

  /// Makes renderers and ray tracers show these kinds; called for each scene that is loaded.
  void attach(scene::Scene& scene) const;
  /// A kind's drawable in a scene.
  struct Made {
    std::string kind;
    int first_thing = 0;  ///< the number of its thing 0
    std::unique_ptr<Drawable> drawable;
  };
  /// Makes the drawables of all kinds of which the scene has things and which are not among `made`, and gives
  /// those that are there the numbers of their things. A scene's kind that is not registered here is an
  /// error: it would be traced, but not drawn.
  Status follow(const scene::Scene& scene, std::vector<Made>& made) const;

 private:
  std::vector<DrawableKind> kinds_;
};

}  // namespace parvis::render
