// A method of reflection: it draws maps, or pictures, for the reflectors that a frame shows before the frame
// is drawn.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "graphics/render/renderer.h"
#include "graphics/render/surface_shader.h"

namespace parvis::methods {

/// A reflecting object that the main view shows.
struct VisibleReflector {
  int object;        ///< index in the scene
  glm::vec3 centre;  ///< of its bounds, in the world
  float size_px;     ///< diameter on the screen
  /// A flag for each object that its surroundings are to show; null: all.
  const std::vector<std::uint8_t>* shown = nullptr;
  /// A flag for each object that an overlay draws in it; null: none.
  const std::vector<std::uint8_t>* overlaid = nullptr;

  bool is_overlaid(int other) const { return overlaid && (*overlaid)[std::size_t(other)]; }
};

/// The reflectors that the prepared main view shows, the largest first.
void find_reflectors(const render::Renderer& renderer, const scene::Scene& scene, const Camera& camera,
                     std::vector<VisibleReflector>& reflectors);

class CubeMap;

/// Does an object stand wholly so near to a reflector? `within_m` from its box, to each side.
bool stands_near(const Bounds& reflector, const Bounds& object, float within_m);

/// Which objects, of all that are visible, stand so near to the reflector `object`: a flag for each. False:
/// none.
bool find_near(const render::Renderer& renderer, int object, float within_m, std::vector<std::uint8_t>& near);

/// One method of reflection. Made for a renderer and a scene, both of which outlive it.
class Reflections : public render::SurfaceShader {
 public:
  /// Draws what maps the method wants for the reflectors that the prepared main view shows.
  void update(render::Renderer& renderer, const scene::Scene& scene, const Camera& camera);

  /// The same for reflectors that are known: for a method that lies over another.
  void update_for(render::Renderer& renderer, const scene::Scene& scene,
                  const std::vector<VisibleReflector>& reflectors);

  /// The cube map of an object's surroundings that the last update made; null: the method has none. For
  /// glass, whose rays leave elsewhere than mirror rays.
  virtual const CubeMap* surroundings_of(int /*object*/) const { return nullptr; }

  /// Takes the time of the last update, and of the rest of its frame, for methods that hold a budget. Called
  /// in windows alone, so that pictures and films can be repeated.
  virtual void frame_took(double /*update_ms*/, double /*rest_ms*/) {}

  /// Called in windows before each frame: what the method has not drawn yet may be spread over several
  /// frames. Pictures and films are drawn whole, so that they can be repeated.
  virtual void prefer_rate() {}
  /// Another time budget of a frame, milliseconds, than the scene's from the next frame on; 0: none. What a
  /// method does for it is its own affair.
  virtual void hold(double /*budget_ms*/) {}
  /// Called after a frame: draws surroundings that the frame was found to lack, each in a frame of its own
  /// light. True: the frame is to be drawn again.
  virtual bool supply(render::Renderer& /*renderer*/, const scene::Scene& /*scene*/) { return false; }

  /// Faces of surroundings drawn by the last update.
  int faces_drawn() const { return faces_drawn_; }

 protected:
  /// A frame begins: called before update_maps for the first of its eyes.
  virtual void begin_frame() {}
  /// Called for each eye of a frame. `reflectors` are ordered from the largest on the screen to the smallest.
  virtual void update_maps(render::Renderer& renderer, const scene::Scene& scene,
                           const std::vector<VisibleReflector>& reflectors) = 0;
  /// The fixed surroundings are others now.
  virtual void forget_surroundings() {}

  int faces_drawn_ = 0;

 private:
  std::optional<int> frame_;          ///< of the renderer, whose first eye has been updated; none: no frame
  std::optional<int> fixed_changes_;  ///< of the renderer, that the maps know of; none: they are new
  std::vector<VisibleReflector> reflectors_;
};

/// A method that lies over another, whose reflections it shows where it has nothing of its own. Without one
/// below it lies over the sky.
class Overlay : public Reflections {
 public:
  render::SurfaceSource source() const override {
    return below_ ? below_->source() : render::SurfaceSource{};
  }
  void bind(const gl::Program& program, int object) override {
    if (below_) below_->bind(program, object);
  }
  const CubeMap* surroundings_of(int object) const override {
    return below_ ? below_->surroundings_of(object) : nullptr;
  }
  void frame_took(double update_ms, double rest_ms) override {
    if (below_) below_->frame_took(update_ms, rest_ms);
  }
  void prefer_rate() override {
    if (below_) below_->prefer_rate();
  }
  void hold(double budget_ms) override {
    if (below_) below_->hold(budget_ms);
  }
  bool supply(render::Renderer& renderer, const scene::Scene& scene) override {
    return below_ && below_->supply(renderer, scene);
  }

 protected:
  explicit Overlay(std::unique_ptr<Reflections> below) : below_(std::move(below)) {}
  /// Updates the method below; called first in update_maps: an overlay may show less, or more, of each
  /// reflector.
  void update_below(render::Renderer& renderer, const scene::Scene& scene,
                    const std::vector<VisibleReflector>& reflectors) {
    if (!below_) return;
    below_->update_for(renderer, scene, reflectors);
    faces_drawn_ = below_->faces_drawn();
  }

 private:
  std::unique_ptr<Reflections> below_;
};

}  // namespace parvis::methods
