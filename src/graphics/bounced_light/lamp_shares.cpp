#include "graphics/bounced_light/lamp_shares.h"

#include <algorithm>
#include <utility>

#include "base/content_hash.h"
#include "base/parallel.h"

namespace parvis::bounced_light {
namespace {

/// A lamp on a path is another lamp in each frame: points remember this many, then only those that burn.
constexpr std::size_t max_kept_per_point = 4 * std::size_t(shading::max_lamps_per_cell);

/// Keys of all data from which the lamps' contributions follow.
std::vector<std::uint64_t> keys_of(const std::vector<shading::Lamp>& lamps) {
  std::vector<std::uint64_t> keys;
  keys.reserve(lamps.size());
  for (const shading::Lamp& lamp : lamps) {
    ContentHash hash;
    hash.add(lamp.place), hash.add(lamp.axis), hash.add(lamp.body.w);
    keys.push_back(hash.value());
  }
  return keys;
}

/// A cell of the table lists lamps that reach some of its points.
bool reaches(const shading::Lamp& lamp, glm::vec3 point) {
  return glm::distance(glm::vec3(lamp.place), point) < lamp.place.w;
}

}  // namespace

std::vector<LampShares::Asked> LampShares::unknown(const Transfer& transfer, const shading::LampTable& table,
                                                   std::span<const std::uint64_t> keys) const {
  std::vector<Asked> asked;
  for (std::size_t p = 0; p < of_points_.size(); ++p)
    table.for_each_near(transfer.lit_points()[p], [&](std::uint32_t lamp) {
      if (reaches(table.lamps[lamp], transfer.lit_points()[p]) && !find(p, keys[lamp]))
        asked.push_back({std::uint32_t(p), lamp});
    });
  return asked;
}

void LampShares::trace(std::span<const Asked> asked, const Transfer& transfer,
                       const shading::LampTable& table, std::span<const std::uint64_t> keys,
                       const scene::Scene& scene) {
  const reference::RayScene rays(scene);
  std::vector<float> shares(asked.size());
  parallel_for(
      asked.size(),
      [&](std::size_t i) {
        shares[i] = transfer.lamp_share(table.lamps[asked[i].lamp], asked[i].point, scene, rays);
      },
      64);
  for (std::size_t i = 0; i < asked.size(); ++i)
    of_points_[asked[i].point].push_back({keys[asked[i].lamp], shares[i]});
  traced_ += asked.size();
}

void LampShares::forget_lamps_gone(const Transfer& transfer, const shading::LampTable& table,
                                   std::span<const std::uint64_t> keys) {
  for (std::size_t p = 0; p < of_points_.size(); ++p) {
    if (of_points_[p].size() <= max_kept_per_point) continue;
    std::vector<Share> kept;
    table.for_each_near(transfer.lit_points()[p], [&](std::uint32_t lamp) {
      if (const Share* const share = find(p, keys[lamp])) kept.push_back(*share);
    });
    of_points_[p] = std::move(kept);
  }
}

std::size_t LampShares::kept() const {
  std::size_t count = 0;
  for (const std::vector<Share>& of_point : of_points_) count += of_point.size();
  return count;
}

const LampShares::Share* LampShares::find(std::size_t point, std::uint64_t lamp) const {
  const auto share = std::ranges::find(of_points_[point], lamp, &Share::lamp);
  return share == of_points_[point].end() ? nullptr : &*share;
}

void LampShares::add_up(const Transfer& transfer, const shading::LampTable& table,
                        std::span<const std::uint64_t> keys) {
  irradiance_.assign(transfer.patches().size(), glm::vec3(0.0f));
  parallel_for(
      irradiance_.size(),
      [&](std::size_t i) {
        for (std::size_t p = i * lit_points_per_patch; p < (i + 1) * lit_points_per_patch; ++p)
          table.for_each_near(transfer.lit_points()[p], [&](std::uint32_t lamp) {
            if (const Share* const known = find(p, keys[lamp]))
              irradiance_[i] +=
                  known->share / float(lit_points_per_patch) * glm::vec3(table.lamps[lamp].power);
          });
      },
      256);
}

const std::vector<glm::vec3>& LampShares::irradiance(const Transfer& transfer,
                                                     const std::vector<shading::Lamp>& lamps,
                                                     const scene::Scene& scene) {
  ContentHash hash;
  hash.add(lamps);
  if (std::exchange(lit_by_, hash.value()) == hash.value()) return irradiance_;
  irradiance_.clear();
  if (lamps.empty()) return irradiance_;
  const shading::LampTable table = shading::make_lamp_table(lamps);
  const std::vector<std::uint64_t> keys = keys_of(table.lamps);
  of_points_.resize(transfer.lit_points().size());
  if (const std::vector<Asked> asked = unknown(transfer, table, keys); !asked.empty()) {
    trace(asked, transfer, table, keys, scene);
    forget_lamps_gone(transfer, table, keys);
  }
  add_up(transfer, table, keys);
  return irradiance_;
}

}  // namespace parvis::bounced_light
