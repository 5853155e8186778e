// What draws things that a person holds over the picture: a small scene of their own.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "graphics/render/drawables.h"
#include "graphics/render/scene_drawable.h"

namespace parvis::render {

/// The drawables of a small scene, made when they are first needed.
class HeldDrawables {
 public:
  /// Takes over the scene as it is now: the objects of the last call, and new ones behind them. Fails only if
  /// a shader does.
  Status follow(const scene::Scene& held, const Drawables& kinds);
  /// The drawables of the scene.
  std::span<Drawable* const> all() const { return all_; }

 private:
  std::optional<SceneDrawable> objects_;
  std::vector<Drawables::Made> others_;
  std::vector<Drawable*> all_;
};

}  // namespace parvis::render
