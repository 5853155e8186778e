#include "scene/script/scene_loader.h"

#include "base/files.h"
#include "scene/script/script_checker.h"

namespace parvis::scene {
namespace {

Result<Nodes> checked_nodes(const std::filesystem::path& script, const NodeRegistry& registry,
                            std::span<const std::filesystem::path> data_folders) {
  const Roots roots(script.parent_path(), {data_folders.begin(), data_folders.end()});
  return check_script(script, registry, roots);
}

}  // namespace

Result<LoadedScene> load_scene(const std::filesystem::path& script, const NodeRegistry& registry,
                               std::span<const std::filesystem::path> data_folders) {
  Result<Nodes> nodes = checked_nodes(script, registry, data_folders);
  if (!nodes) return nodes.errors();
  SceneBuilder builder(registry);
  builder.build(*nodes);
  Result<LoadedScene> loaded = std::move(builder).finish();
  if (!loaded) return loaded;
  loaded->script.nodes = *std::move(nodes);
  loaded->scene.file = script;
  return loaded;
}

Status check_scene(const std::filesystem::path& script, const NodeRegistry& registry,
                   std::span<const std::filesystem::path> data_folders) {
  const Result<Nodes> nodes = checked_nodes(script, registry, data_folders);
  if (!nodes) return nodes.errors();
  return Ok{};
}

}  // namespace parvis::scene
