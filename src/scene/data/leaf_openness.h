// How much of the sky the foliage of models leaves open to its own leaves: between leaf and leaf is what a
// grid of the place's heights cannot show. Renderer and ray tracer read it; photographs of the scene
// (reference/path_tracer.h) do not.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/content_hash.h"
#include "scene/data/room_data.h"
#include "scene/data/scene.h"

namespace parvis::scene {

/// True for leaves: cut out and translucent.
bool is_foliage(const Material& material);

/// The models of a scene that have foliage.
struct LeafOpenness {
  static constexpr std::string_view name = "data.leaf_openness";
  static constexpr DataRole role = DataRole::static_content;

  /// That of one model.
  struct OfModel {
    std::shared_ptr<const Model> model;        ///< which it is of
    std::vector<std::vector<float>> parts;     ///< by part and vertex: CrownOpenness::at; empty: no foliage
    std::vector<std::vector<float>> max_seen;  ///< the same of CrownOpenness::max_seen
  };
  std::unordered_map<const Model*, std::shared_ptr<const OfModel>> models;  ///< copies of a scene share them

  /// Openness of each vertex of a part of a model, 0 to 1; empty: it hides nothing of the sky from itself.
  std::span<const float> of(const Model& model, std::size_t part) const;
  /// The fraction of each vertex that is seen from outside the crown at most; empty: it is hidden nowhere.
  std::span<const float> max_seen(const Model& model, std::size_t part) const;
  /// Which it is follows from the models.
  void hash(ContentHash& hash) const { hash.add(models.size()); }
};

/// Finds it for all models of a scene of which it is not known.
void find_leaf_openness(Scene& scene);

}  // namespace parvis::scene
