#include "life/vegetation/scene_plant.h"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "base/memory_budget.h"

namespace parvis::vegetation {
namespace {

constexpr std::size_t max_kept = 64;  // beyond it, plants that nobody shows are dropped from the cache

Status check(const PlantRecipe& recipe) {
  const PlantKind& kind = *recipe.kind;
  if (!(recipe.height_m >= kind.min_height_m && recipe.height_m <= kind.max_height_m))
    return error("a plant of kind \"{}\" is between {} and {} m high, not {} m", kind.name, kind.min_height_m,
                 kind.max_height_m, recipe.height_m);
  if (kind.habit == Habit::tree) return Ok{};
  if (!(recipe.length_m > 0.0f && std::isfinite(recipe.length_m)))
    return error("a plant of kind \"{}\" has a length above 0 m, not {} m", kind.name, recipe.length_m);
  if (leaf_count(recipe) > max_leaves)
    return error(
        "{} m of \"{}\" have {} leaves; {} is the most for one plant. Set several shorter ones side by side",
        recipe.length_m, kind.name, leaf_count(recipe), max_leaves);
  return Ok{};
}

}  // namespace

PlantTriangles plant_triangles(const scene::Scene& scene) {
  PlantTriangles triangles;
  std::set<const PlantShape*> shapes;
  for (const ScenePlant& plant : scene_plants(scene)) {
    triangles.placed += plant.shape->triangle_count();
    if (shapes.insert(plant.shape.get()).second) triangles.stored += plant.shape->triangle_count();
  }
  return triangles;
}

Result<std::shared_ptr<const PlantShape>> shared_plant(PlantCache& cache, const PlantRecipe& recipe) {
  if (const Status status = check(recipe); !status) return status.errors();
  PlantRecipe grown = recipe;
  if (recipe.kind->habit == Habit::tree) grown.length_m = 0.0f;  // that trees have none of
  const std::string key =
      fmt::format("{} {} {} {}", grown.kind->name, grown.height_m, grown.length_m, grown.seed);
  if (const auto found = cache.shapes.find(key); found != cache.shapes.end()) return found->second;
  const std::string what = fmt::format(
      "another plant of kind \"{}\" (plants of the same kind, height and seed share their memory)",
      recipe.kind->name);
  if (cache.shapes.size() >= max_kept)
    std::erase_if(cache.shapes, [](const auto& kept) { return kept.second.use_count() == 1; });
  std::uint64_t bytes = estimated_bytes(grown);  // to be drawn and traced: later, and all together
  for (const auto& [name, kept] : cache.shapes)
    if (kept.use_count() > 1) bytes += estimated_bytes(kept->recipe);
  if (const Status enough = check_memory(bytes, what); !enough) return enough.errors();
  auto shape = std::make_shared<const PlantShape>(grow_plant(grown));
  cache.shapes.emplace(key, shape);
  return std::shared_ptr<const PlantShape>(std::move(shape));
}

}  // namespace parvis::vegetation
