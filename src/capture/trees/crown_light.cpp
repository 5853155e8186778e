// Shares are computed for the finest cells and averaged upward by opacity, so that a coarser level is as
// bright as what it stands for.
#include "capture/trees/crown_light.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "capture/trees/tree_levels.h"
#include "capture/trees/tree_light.h"

namespace parvis::trees {
namespace {

constexpr float scattered =
    0.15f;  // of the light: leaves pass it on to each other, so that all get the mean of it
constexpr float min_crown_light = 1e-4f;
constexpr float step_deg = 4.0f;  // of the directions: closer ones share a result
constexpr std::size_t max_kept = 512;

std::vector<std::uint32_t> parents_of(const CellGrid& fine, const CellGrid& coarse) {
  std::vector<std::uint32_t> parents;
  for (const glm::u16vec3 place : fine.cells())
    parents.push_back(std::uint32_t(coarse.cell_at(glm::ivec3(place) / fine.branching())));
  return parents;
}

/// The shares of the coarser levels from those of the finest.
CellShares all_levels(const std::vector<BillboardTree>& levels,
                      const std::vector<std::vector<std::uint32_t>>& parents, std::vector<float> finest) {
  std::vector<float> weights;  // of the cells' leaves: they add up, opacities do not
  for (const glm::u8vec4 base : levels.front().base) weights.push_back(float(base.w) + 1e-3f);
  double sum = 0.0, all = 0.0;
  for (std::size_t i = 0; i < finest.size(); ++i)
    sum += double(weights[i] * finest[i]), all += double(weights[i]);
  for (float& share : finest) share = glm::mix(share, float(sum / all), scattered);
  CellShares shares{std::move(finest)};
  for (std::size_t level = 0; level + 1 < levels.size(); ++level) {
    const std::size_t count = levels[level + 1].grid.size();
    std::vector<float> sums(count, 0.0f), parent_weights(count, 0.0f);
    for (std::size_t i = 0; i < parents[level].size(); ++i) {
      const std::uint32_t parent = parents[level][i];
      sums[parent] += weights[i] * shares[level][i], parent_weights[parent] += weights[i];
    }
    for (std::size_t i = 0; i < count; ++i) sums[i] /= parent_weights[i];
    shares.push_back(std::move(sums)), weights = std::move(parent_weights);
  }
  return shares;
}

}  // namespace

CrownLight crown_light(const std::vector<BillboardTree>& levels) {
  CrownLight crown;
  if (levels.empty()) return crown;
  for (std::size_t level = 0; level + 1 < levels.size(); ++level)
    crown.parents.push_back(parents_of(levels[level].grid, levels[level + 1].grid));
  const BillboardTree& finest = levels.front();
  crown.sky = all_levels(levels, crown.parents, sky_visibility(finest));
  crown.albedo_factor = all_levels(levels, crown.parents, sun_visibility(finest, finest.light.to_sun));
  const auto light = [&](float sun, float sky) { return finest.light.sun * sun + finest.light.sky * sky; };
  for (std::size_t level = 0; level < levels.size(); ++level)
    for (std::size_t i = 0; i < crown.albedo_factor[level].size(); ++i) {
      float& factor = crown.albedo_factor[level][i];  // still the share of the photographs' sun
      factor = mean_albedo / std::max(light(factor, crown.sky[level][i]), min_crown_light);
    }
  return crown;
}

CellShares sun_shares(const TreeLevels& tree, glm::vec3 to_sun) {
  return all_levels(tree.levels, tree.crown.parents, sun_visibility(tree.levels.front(), to_sun));
}

const CellShares& SunInCrowns::shares(const TreeLevels& tree, glm::vec3 to_sun) {
  const float azimuth_deg = glm::degrees(std::atan2(to_sun.x, to_sun.y)),
              height_deg = glm::degrees(std::asin(std::clamp(to_sun.z, -1.0f, 1.0f)));
  const std::pair<int, int> step(int(std::lround(azimuth_deg / step_deg)),
                                 int(std::lround(height_deg / step_deg)));
  if (const auto found = kept_.find({&tree, step}); found != kept_.end()) return found->second;
  if (kept_.size() >= max_kept) kept_.clear();
  return kept_.emplace(Key{&tree, step}, sun_shares(tree, to_sun)).first->second;
}

float way_out(const Bounds& box, glm::vec3 point, glm::vec3 direction) {
  float minimum = std::numeric_limits<float>::max();
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(direction[axis]) < 1e-6f) continue;
    const float face = direction[axis] > 0.0f ? box.max[axis] : box.min[axis];
    minimum = std::min(minimum, std::max((face - point[axis]) / direction[axis], 0.0f));
  }
  return minimum < std::numeric_limits<float>::max() ? minimum : 0.0f;
}

}  // namespace parvis::trees
