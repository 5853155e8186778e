// What methods of reflection have in common: they make maps for the reflectors that a frame shows, before it
// is drawn.
#pragma once

#include <optional>
#include <vector>

#include "graphics/render/renderer.h"

namespace parvis::render {

/// What a method knows of a reflecting object.
struct Reflector {
  int object;        ///< index in the scene
  glm::vec3 centre;  ///< of its bounds, in the world
  float size_px;     ///< diameter on the screen
  /// A flag for each object that its surroundings are to show; null: all.
  const std::vector<std::uint8_t>* shown = nullptr;
};

/// Reflectors that the prepared main view shows, the largest first.
void find_reflectors(const Renderer& renderer, const scene::Scene& scene, const Camera& camera,
                     std::vector<Reflector>& reflectors);

class CubeMap;

/// Does an object stand wholly so near to a reflector? `within_m` from its box, to each side.
bool stands_near(const Bounds& reflector, const Bounds& object, float within_m);

/// Which objects, of all that are visible, stand so near to the reflector `object`: a flag for each. False:
/// none.
bool find_near(const Renderer& renderer, int object, float within_m, std::vector<std::uint8_t>& near);

/// One method of reflection. Made for a renderer and a scene, both of which outlive it.
class Reflections : public ReflectionSource {
 public:
  /// Draws what maps the method wants for the reflectors that the prepared main view shows.
  void update(Renderer& renderer, const scene::Scene& scene, const Camera& camera);

  /// The same for reflectors that are known: for a method that lies over another.
  void update_for(Renderer& renderer, const scene::Scene& scene, const std::vector<Reflector>& reflectors);

  /// The cube map of an object's surroundings that the last update made; null: the method has none. For
  /// glass, whose rays leave elsewhere than mirror rays.
  virtual const CubeMap* surroundings_of(int /*object*/) const { return nullptr; }

  /// What the last update took by the clock, and all the rest of its frame: for methods that hold a budget.
  /// Told in windows alone, so that pictures and films can be repeated.
  virtual void frame_took(double /*update_ms*/, double /*rest_ms*/) {}

  /// Faces of surroundings drawn by the last update.
  int faces_drawn() const { return faces_drawn_; }

 protected:
  /// `reflectors` are ordered from the largest on the screen to the smallest.
  virtual void update_maps(Renderer& renderer, const scene::Scene& scene,
                           const std::vector<Reflector>& reflectors) = 0;
  /// The fixed surroundings are others now.
  virtual void forget_surroundings() {}

  int faces_drawn_ = 0;

 private:
  std::optional<int> fixed_changes_;  ///< of the renderer, that the maps know of; none: they are new
  std::vector<Reflector> reflectors_;
};

}  // namespace parvis::render
