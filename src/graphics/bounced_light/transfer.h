// Precomputed transfer of light from sun, sky and still lamps by way of surfaces to a grid of places: rays
// are traced once; then another sun or sky costs two products of sparse matrices with vectors. After Sloan,
// Kautz and Snyder 2002 (precomputed radiance transfer), with patches of surface between light and places as
// in Silvennoinen and Timonen 2015 (multi-scale global illumination in Quantum Break).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "graphics/reference/ray_scene.h"
#include "graphics/shading/bounced_light.h"
#include "graphics/shading/lamps.h"
#include "graphics/shading/sky.h"
#include "scene/data/bounced_settings.h"
#include "scene/data/scene.h"

namespace parvis::bounced_light {

/// Directions over the upper hemisphere in which patches see the sky.
inline constexpr int sky_directions = 128;
/// Evenly spread; each stands for 2 pi / sky_directions steradians.
const std::array<glm::vec3, sky_directions>& directions_of_sky();

/// Limits of the rays from each place that a scene may ask for.
inline constexpr int min_rays = 16, max_rays = 1024;

/// Some square metres of surface that face one way.
struct Patch {
  glm::vec3 position{0.0f}, normal{0.0f, 0.0f, 1.0f};  ///< means over the patch; unit normal
  glm::vec3 albedo{0.0f};
  std::array<std::uint64_t, sky_directions / 64> sees_sky{};  ///< a bit for each direction
};

/// Points of each patch at which lamps are looked for: their light changes within metres.
inline constexpr std::size_t lit_points_per_patch = 4;

/// The transfer of a scene's static geometry.
class Transfer {
 public:
  /// Empty: no light arrives.
  Transfer() = default;
  /// Traces `settings.rays` rays from every place between the scene's static things, and those from the
  /// patches to the sky.
  Transfer(const scene::Scene& scene, const reference::RayScene& rays,
           const scene::BouncedSettings& settings);

  /// The whole transfer as bytes for a file.
  std::string to_bytes() const;
  /// The transfer that `to_bytes` wrote; nothing where bytes are missing, or counts and indices do not fit
  /// each other.
  static std::optional<Transfer> from_bytes(std::string_view bytes);

  /// A lamp's contribution to one of `lit_points`, past static geometry of the scene that this was made of:
  /// irradiance per square metre over the lamp's power in W/sr. Traces a ray.
  float lamp_share(const shading::Lamp& lamp, std::size_t point, const scene::Scene& scene,
                   const reference::RayScene& rays) const;

  /// The light that arrives at every place after `bounces` surfaces or fewer. `by_lamps`: irradiance of each
  /// patch beside that by sun and sky; empty: there is none.
  shading::BouncedLight light(const scene::Sun& sun, const shading::SkyLight& sky,
                              std::span<const glm::vec3> by_lamps = {}, int bounces = 3) const;

  /// How many places have light.
  std::size_t place_count() const { return air_.size(); }
  const std::vector<Patch>& patches() const { return patches_; }  ///< all surfaces that places see
  /// `lit_points_per_patch` for each patch, a little above it.
  const std::vector<glm::vec3>& lit_points() const { return lit_points_; }

 private:
  void lay_out(const Bounds& fixed, float spacing_m);
  bool is_consistent() const;
  glm::vec3 middle(std::size_t cell) const;
  std::size_t index(glm::ivec3 cell) const;
  glm::ivec3 place_of(std::size_t cell) const;
  void find_walls();
  void see_sky(const scene::Scene& scene, const reference::RayScene& rays,
               const std::vector<std::vector<glm::vec3>>& points);
  void choose_lit_points(const std::vector<std::vector<glm::vec3>>& points);
  std::vector<glm::vec3> direct_irradiance(const scene::Sun& sun, const shading::SkyLight& sky) const;
  void gather(const std::vector<glm::vec4>& radiance, shading::BouncedLight& light) const;
  void look_at_sky(const shading::SkyLight& sky, shading::BouncedLight& light) const;
  void fill_walls(shading::BouncedLight& light) const;

  shading::BouncedGrid grid_{glm::vec3(0.0f), glm::vec3(1.0f), 0.0f, 0.0f};
  glm::ivec3 cells_{0};
  int rays_ = 0;
  std::vector<std::uint32_t> air_;    ///< cells that are not inside of things, ascending
  std::vector<std::int32_t> seen_;    ///< `rays_` for each of them: a patch, or -1: the sky
  std::vector<std::uint8_t> is_air_;  ///< by cell
  std::vector<Patch> patches_;
  std::vector<glm::vec3> lit_points_;

  /// A cell inside of something, beside air.
  struct Wall {
    std::uint32_t cell;
    std::size_t first, count;  ///< in `beside_walls_`
  };
  std::vector<Wall> walls_;                  ///< of is_air_; not in files
  std::vector<std::uint32_t> beside_walls_;  ///< cells of air
};

}  // namespace parvis::bounced_light
