// The land around a place: drawn and traced, but no part of what is fitted to the place.
#pragma once

#include <algorithm>
#include <memory>

#include "base/content_hash.h"
#include "scene/data/scene.h"

namespace parvis::scene {

/// A model whose objects surround the place as far as the horizon. Shadow maps, heights and views of the
/// whole place leave them out: they would be spread over kilometres of empty land.
struct Surroundings {
  static constexpr std::string_view name = "data.surroundings";
  static constexpr DataRole role = DataRole::settings;  // the objects themselves are in the scene
  std::shared_ptr<const Model> model;

  /// Adds nothing: the objects are hashed with the scene; see SceneData.
  void hash(ContentHash&) const {}
};

/// True if the object shows one of the scene's surroundings.
inline bool surrounds_place(const Scene& scene, const Object& object) {
  return std::ranges::any_of(scene.items<Surroundings>(),
                             [&](const Surroundings& each) { return each.model == object.model; });
}

}  // namespace parvis::scene
