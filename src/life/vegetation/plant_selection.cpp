#include "life/vegetation/plant_selection.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "graphics/render/screen_scale.h"

namespace parvis::vegetation {
namespace {

using render::Culling, render::View, render::ViewKind;

constexpr float nowhere_smaller = 1.0f / 256.0f;  // of the resolution, at most, for the budget
constexpr int bisections = 12;
// Where the eye may be inside a plant, its parts are taken to be so far away: the budget can then make them
// coarser.
constexpr float nearest_m = 0.5f;
// What a curved mirror shows has no size of its own: a sample, of which the mirror's few pixels have enough.
constexpr float mirrored_leaves = 3000.0f, mirrored_pixels_per_metre = 50.0f;

/// Views beside the main one show less: faces of maps, mirrors.
int budget_of(const View& view, const PlantDetail& detail) {
  const bool is_whole =
      view.kind == ViewKind::main || view.kind == ViewKind::shadow || view.kind == ViewKind::picking;
  return is_whole ? detail.max_primitives : detail.max_primitives / 4;
}

}  // namespace

PlacedPlant placed(const ScenePlant& plant, int thing) {
  const glm::mat3 turn(plant.world_from_plant);
  PlacedPlant result;
  result.shape = plant.shape.get(), result.world_from_plant = plant.world_from_plant;
  result.scale = std::max({glm::length(turn[0]), glm::length(turn[1]), glm::length(turn[2])});
  result.bounds = plant.is_visible ? transformed(plant.world_from_plant, plant.shape->bounds) : Bounds();
  result.thing = thing, result.is_visible = plant.is_visible;
  return result;
}

void PlantSelection::gather(const View& view, const Culling& culling, const PlantDetail& detail) {
  leaves_.clear(), wood_.clear();
  is_full_ = detail.is_full, is_mirrored_ = view.kind == ViewKind::mirrored;
  const float maximum = render::ScreenScale(view).pixels_per_metre_at(nearest_m);
  const auto resolution = [&](const PlacedPlant& plant, const Bounds& bounds) {
    return plant.scale * std::min(culling.pixels_per_metre(bounds), maximum);
  };
  for (std::size_t i = 0; i < plants_.size(); ++i) {
    const PlacedPlant& plant = plants_[i];
    if (view.kind == ViewKind::shadow && !plant.casts_shadow) continue;
    if (!plant.is_visible || !culling.shows(plant.thing, {false, plant.is_newcomer}) ||
        !culling.may_see(plant.bounds) || culling.is_hidden(plant.bounds))
      continue;
    const float pixels = resolution(plant, plant.bounds);
    wood_.push_back({std::uint32_t(i), is_mirrored_ ? mirrored_pixels_per_metre : pixels, {}});
    if (!is_full_ && !is_mirrored_ && !leaf_shares(*plant.shape, pixels).has_triangles()) {
      leaves_.push_back({std::uint32_t(i), -1, pixels, {}});
      continue;
    }
    for (std::size_t c = 0; c < plant.shape->clusters.size(); ++c) {
      const Bounds bounds = transformed(plant.world_from_plant, plant.shape->clusters[c].bounds);
      if (culling.may_see(bounds))
        leaves_.push_back({std::uint32_t(i), std::int32_t(c), resolution(plant, bounds), {}});
    }
  }
}

void PlantSelection::share_out(float scale) {
  scale_ = scale;
  statistics_ = {};
  for (SelectedLeaves& part : leaves_) {
    const PlantShape& shape = *plants_[part.plant].shape;
    const float all = float(shape.leaves.size());
    if (is_mirrored_)
      part.shares.full = 0.0f,
      part.shares.simple = part.shares.shown = std::min(mirrored_leaves * scale * scale / all, 1.0f);
    else
      part.shares = is_full_ ? LeafShares() : leaf_shares(shape, scale * part.pixels_per_metre);
    const auto count = [&](float share) {
      if (part.cluster < 0) return std::size_t(std::ceil(share * all));
      const LeafCluster& cluster = shape.clusters[std::size_t(part.cluster)];
      return std::size_t(cluster_end(shape, cluster, share) - cluster.first);
    };
    const std::size_t full = count(part.shares.full), simple = count(part.shares.simple),
                      shown = count(part.shares.shown);
    statistics_.triangles += full * full_leaf(shape.kind().leaf).triangle_count() +
                             (simple - full) * simple_leaf(shape.kind().leaf).triangle_count();
    statistics_.points += shown - simple;
  }
  for (SelectedWood& part : wood_) {
    const PlantShape& shape = *plants_[part.plant].shape;
    part.shares =
        wood_shares(shape, is_full_ ? std::numeric_limits<float>::infinity() : scale * part.pixels_per_metre);
    if (is_mirrored_) part.shares.twigs = 0;
    if (part.shares.pieces > 0) statistics_.triangles += shape.pieces[part.shares.pieces - 1].end / 3;
    statistics_.lines += part.shares.twigs;
  }
}

void PlantSelection::choose(std::span<const PlacedPlant> plants, const View& view, const Culling& culling,
                            const PlantDetail& detail) {
  plants_ = plants;
  gather(view, culling, detail);
  // The nearest first: what they hide is not shaded.
  std::ranges::sort(leaves_, std::greater<>(), &SelectedLeaves::pixels_per_metre);
  share_out(1.0f);
  const auto budget = std::size_t(std::max(budget_of(view, detail), 0));
  if (is_full_ || statistics_.all() <= budget) return;
  float enough = nowhere_smaller, much = 1.0f;
  for (int i = 0; i < bisections; ++i) {
    const float middle = std::sqrt(enough * much);
    share_out(middle);
    (statistics_.all() <= budget ? enough : much) = middle;
  }
  share_out(enough);
}

}  // namespace parvis::vegetation
