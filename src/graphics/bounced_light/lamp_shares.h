// What still lamps do to the patches of a transfer: kept by lamp, so that a lamp which is switched, dimmed or
// added costs the rays of that lamp alone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "graphics/bounced_light/transfer.h"
#include "graphics/reference/ray_scene.h"
#include "graphics/shading/lamps.h"

namespace parvis::bounced_light {

/// Contributions of lamps by one transfer and the scene that it was made of.
class LampShares {
 public:
  /// Irradiance of each patch by these lamps, of those near a point the strongest (shading::LampTable);
  /// empty: none burns. Traces rays from points to lamps that have not been seen from there: in that place,
  /// with that reach, axis, cone and glass.
  const std::vector<glm::vec3>& irradiance(const Transfer& transfer, const std::vector<shading::Lamp>& lamps,
                                           const scene::Scene& scene);

  /// Pairs of a point and a lamp that reaches it, as far as they have been looked at.
  std::size_t traced() const { return traced_; }
  /// How many of them are remembered.
  std::size_t kept() const;

 private:
  struct Share {
    std::uint64_t lamp;  ///< hash of all but its power
    float share;         ///< Transfer::lamp_share
  };
  /// A point's share of a lamp that is not known yet.
  struct Asked {
    std::uint32_t point, lamp;
  };
  std::vector<Asked> unknown(const Transfer& transfer, const shading::LampTable& table,
                             std::span<const std::uint64_t> keys) const;
  void trace(std::span<const Asked> asked, const Transfer& transfer, const shading::LampTable& table,
             std::span<const std::uint64_t> keys, const scene::Scene& scene);
  void forget_lamps_gone(const Transfer& transfer, const shading::LampTable& table,
                         std::span<const std::uint64_t> keys);
  const Share* find(std::size_t point, std::uint64_t lamp) const;
  void add_up(const Transfer& transfer, const shading::LampTable& table, std::span<const std::uint64_t> keys);

  std::vector<std::vector<Share>> of_points_;  ///< by Transfer::lit_points
  std::size_t traced_ = 0;
  std::uint64_t lit_by_ = 0;  ///< hash of the lamps of `irradiance_`
  std::vector<glm::vec3> irradiance_;
};

}  // namespace parvis::bounced_light
