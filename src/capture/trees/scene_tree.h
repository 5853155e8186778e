// Captured trees that stand in a scene.
#pragma once

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>

#include "capture/trees/tree_levels.h"
#include "scene/data/room_data.h"
#include "scene/data/scene.h"

namespace parvis::trees {

/// One of them; nodes make any number.
struct SceneTree {
  static constexpr std::string_view name = "trees.scene_trees";
  static constexpr scene::DataRole role = scene::DataRole::static_content;

  std::shared_ptr<const TreeLevels> tree;  ///< shared by all that are read from one file
  std::uint64_t content = 0;               ///< hash of the file
  glm::mat4 world_from_tree{1.0f};         ///< from the frame of the photographs' cameras
  bool is_visible = true;
  float sway_m = 0.0f;  ///< how far the top moves in the wind at most, in the world; 0: the tree stands still
  glm::vec2 lean_m{0.0f};  ///< where its top is now beside its place at rest, in the tree's frame

  /// A tree that sways is a dynamic thing.
  bool sways() const { return sway_m > 0.0f; }
  /// The tree's transform as it leans now.
  glm::mat4 world_from_leaning_tree() const { return world_from_tree * leaning(); }
  /// The tree's frame leaning, from the tree's frame at rest: a shear about the foot.
  glm::mat4 leaning() const;
  /// Its trunk as an object, where the tree has one as geometry.
  std::optional<scene::Object> trunk_object() const;
  /// Adds all but how it leans now.
  void hash(ContentHash& hash) const {
    hash.add(content), hash.add(world_from_tree), hash.add(is_visible), hash.add(sway_m);
  }
};

inline glm::mat4 SceneTree::leaning() const {
  glm::mat4 shear(1.0f);
  if (lean_m == glm::vec2(0.0f)) return shear;
  const glm::vec2 lean = lean_m / std::max(tree->box.max.z - tree->foot.z, 1e-3f);
  shear[2] = {lean, 1.0f, 0.0f}, shear[3] = {-tree->foot.z * lean, 0.0f, 1.0f};
  return shear;
}

inline std::optional<scene::Object> SceneTree::trunk_object() const {
  if (!tree->trunk) return std::nullopt;
  scene::Object trunk;
  trunk.name = "trunk", trunk.model = tree->trunk, trunk.world_from_model = world_from_tree;
  trunk.is_dynamic = sways(), trunk.is_visible = is_visible;
  return trunk;
}

using SceneTrees = scene::ItemsOf<SceneTree>;

/// The scene's captured trees, in the order of their things.
inline const std::vector<SceneTree>& scene_trees(const scene::Scene& scene) {
  return scene.data<SceneTrees>().items;
}

/// How finely trees are drawn.
struct TreeDetail {
  static constexpr std::string_view name = "trees.detail";
  static constexpr scene::DataRole role = scene::DataRole::settings;

  DetailLimits limits = {};  ///< beyond them a finer level of detail is shown
  /// Billboards of which the crowns before them leave less visible are not drawn; 0: all are drawn.
  float min_visible = 0.01f;

  /// Limits of a tree's difference from reality where a view affords it: half a pixel.
  DetailLimits finer_limits = {0.5f, 0.5f, 0.5f};
  /// Billboards of a view up to which trees are shown within `finer_limits`: a tree or two, as large as the
  /// picture. 0: never.
  std::size_t affordable_billboards = 60'000;
  /// Billboards that the main view blends into its own samples; more of them are blended by themselves
  /// (tree_layer.h), unless `min_visible` is 0.
  std::size_t direct_billboards = 10'000;

  /// Adds the limits.
  void hash(ContentHash& hash) const {
    limits.hash(hash), finer_limits.hash(hash), hash.add(min_visible);
    hash.add(affordable_billboards), hash.add(direct_billboards);
  }
};

/// Trees that have been read, by file: a node that changes does not read them again.
struct TreeCache {
  static constexpr std::string_view name = "trees.cache";
  static constexpr scene::DataRole role = scene::DataRole::settings;

  /// A tree that has been read, and the hash of its file.
  struct Read {
    std::shared_ptr<const TreeLevels> tree;
    std::uint64_t content = 0;
  };
  std::map<std::filesystem::path, Read> trees;

  /// Adds the contents of all files.
  void hash(ContentHash& hash) const {
    for (const auto& [path, read] : trees) hash.add(read.content);
  }
};

}  // namespace parvis::trees
