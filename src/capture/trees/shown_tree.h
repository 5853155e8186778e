// A captured tree as Parvis draws it, for figures and comparisons: the node's drawable, its light and its
// levels of detail, with what the tree lets through told apart from what it shows.
#pragma once

#include <memory>

#include "base/result.h"
#include "capture/trees/scene_tree.h"
#include "capture/trees/tree_view.h"
#include "graphics/render/frame_views.h"

namespace parvis::trees {

/// Sun and sky in which a tree looks as in its photographs.
scene::Scene scene_in_light_of(const CapturedLight& light);

/// One tree alone in a scene. Needs a current OpenGL context for as long as it lives.
class ShownTree {
 public:
  /// `light`: whose sun, sky and haze it stands in; other things of that scene are not drawn.
  static Result<ShownTree> create(std::shared_ptr<const TreeLevels> tree, const scene::Scene& light);
  /// Shows the objects of a scene in its own light in place of a captured tree: the mesh that was
  /// photographed.
  static Result<ShownTree> of_scene(scene::Scene scene);

  /// The tree's picture by a camera: RGBA, premultiplied, linear light before any tone curve. Fails only if a
  /// shader does.
  Result<ImageF> picture(const Pinhole& camera);

 private:
  class Backdrop;
  ShownTree() = default;
  static Result<ShownTree> shown(std::unique_ptr<scene::Scene> scene, const render::Drawables& drawables);
  Result<ImageF> before(float backdrop, const render::EyeView& eye);

  std::unique_ptr<scene::Scene> scene_;  // the renderer's
  std::unique_ptr<Backdrop> backdrop_;
  std::unique_ptr<render::Renderer> renderer_;

 public:
  ShownTree(ShownTree&&) noexcept;
  ShownTree& operator=(ShownTree&&) noexcept;
  ~ShownTree();
};

}  // namespace parvis::trees
