#include "graphics/bounced_light/transfer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <optional>
#include <unordered_map>
#include <utility>

#include "base/colour.h"
#include "base/parallel.h"
#include "graphics/reference/scene_lamps.h"
#include "graphics/reference/shading_point.h"

namespace parvis::bounced_light {
namespace {

using glm::ivec3, glm::vec3, glm::vec4;

constexpr float max_cells = 150'000.0f;
/// Cells along each axis: drivers take 3D textures of 2,048 texels, and light has three for each cell upward.
const vec3 max_side(2048.0f, 2048.0f, 682.0f);
const vec3 margin_cells(2.0f, 2.0f, 1.0f);  // around the fixed things, on both sides together
constexpr float cell_height_share = 0.75f;  // of the spacing from side to side: light changes most upward
constexpr float patch_share = 0.75f;        // of the spacing: side of a patch
constexpr float inside_share = 0.25f;       // of rays that hit backs: the place is inside of something
constexpr std::size_t places_at_once = 4096;
constexpr std::size_t points_per_patch = 16;  // where rays to the sky begin
constexpr float housing_m = 1.0f;  // so near to a lamp is what carries it: no share of a wall's light
constexpr int ray_sets = 8;        // neighbouring places look in other directions
constexpr float golden_turn = 2.39996323f;

/// Evenly over the sphere, turned about the zenith.
vec3 ray_direction(int ray, int rays, int set) {
  const float z = 1.0f - 2.0f * (float(ray) + (float(set) + 0.5f) / float(ray_sets)) / float(rays);
  const float across = std::sqrt(std::max(0.0f, 1.0f - z * z));
  const float turn = golden_turn * float(ray) + 0.7853982f * float(set);
  return {across * std::cos(turn), across * std::sin(turn), z};
}

int ray_set(std::uint32_t cell) { return int((cell * 2654435761u) >> 29); }

struct Seen {
  vec3 position, normal, albedo;
  bool is_back = false;
};

/// Where a ray goes on behind a hit.
float past(float distance_m) { return distance_m * (1.0f + 1e-5f) + 1e-4f; }

bool is_dynamic(const scene::Scene& scene, int object) {
  return object < int(scene.objects.size()) && scene.objects[std::size_t(object)].is_dynamic;
}

bool is_single_sided(const reference::PlacedPart& part) {
  return part.surface ? !part.surface->is_double_sided() : !part.material->is_double_sided;
}

/// The nearest static surface, its back, too; `width_m` of it is seen at once.
std::optional<Seen> seen_along(const scene::Scene& scene, const reference::RayScene& rays, reference::Ray ray,
                               float width_m, std::uint64_t chance) {
  reference::Passage passage{.random = Random(chance), .passes_backdrops = true};
  while (const std::optional<reference::Hit> hit = rays.nearest_hit(ray, passage)) {
    if (!is_dynamic(scene, hit->place->object)) {
      const reference::ShadingPoint point = reference::shading_point(*hit, ray.direction, width_m);
      return Seen{ray.origin + hit->distance_m * ray.direction, point.geometric_normal,
                  (1.0f - point.surface.metallic) * point.surface.base_colour,
                  point.is_back && is_single_sided(*hit->place)};
    }
    ray.min_m = past(hit->distance_m);
  }
  return std::nullopt;
}

/// Nothing static lies along the ray.
bool is_open(const scene::Scene& scene, const reference::RayScene& rays, reference::Ray ray,
             std::uint64_t chance) {
  reference::Passage passage{.random = Random(chance), .passes_backdrops = true};
  if (!rays.is_blocked(ray, passage)) return true;
  while (const std::optional<reference::Hit> hit = rays.nearest_hit(ray, passage)) {
    if (!is_dynamic(scene, hit->place->object)) return false;
    ray.min_m = past(hit->distance_m);
  }
  return true;
}

/// Key of the patch of a point: its cell, and the axis that its normal is nearest to.
std::uint64_t patch_key(vec3 position, vec3 normal, vec3 origin, float side_m) {
  const ivec3 cell(glm::floor((position + 0.1f * normal - origin) / side_m));
  const vec3 size = glm::abs(normal);
  const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
  const std::uint64_t facing = 2 * std::uint64_t(axis) + (normal[axis] > 0.0f ? 1 : 0);
  const auto part = [](int value) { return std::uint64_t(std::uint32_t(value + (1 << 19)) & 0xfffffu); };
  return (part(cell.x) << 43) | (part(cell.y) << 23) | (part(cell.z) << 3) | facing;
}

/// Patches while what is seen of them is added up.
struct PatchSums {
  std::unordered_map<std::uint64_t, std::int32_t> numbers;
  std::vector<Patch> patches;
  std::vector<float> counts;
  std::vector<std::vector<vec3>> points;  ///< of each patch, where rays to the sky begin

  /// The number of the patch that was seen.
  std::int32_t add(const Seen& seen, vec3 origin, float side_m) {
    const std::uint64_t key = patch_key(seen.position, seen.normal, origin, side_m);
    const auto [entry, is_new] = numbers.try_emplace(key, std::int32_t(patches.size()));
    if (is_new) {
      patches.push_back({.normal = vec3(0.0f)});
      counts.push_back(0.0f), points.emplace_back();
    }
    const auto i = std::size_t(entry->second);
    patches[i].position += seen.position, patches[i].normal += seen.normal;
    patches[i].albedo += seen.albedo, counts[i] += 1.0f;
    if (points[i].size() < points_per_patch) points[i].push_back(seen.position + 0.01f * seen.normal);
    return entry->second;
  }

  std::vector<Patch> means() const {
    std::vector<Patch> result = patches;
    for (std::size_t i = 0; i < result.size(); ++i) {
      result[i].position /= counts[i], result[i].albedo /= counts[i];
      const float length = glm::length(result[i].normal);
      result[i].normal = length > 1e-6f ? result[i].normal / length : vec3(0.0f, 0.0f, 1.0f);
    }
    return result;
  }
};

}  // namespace

const std::array<vec3, sky_directions>& directions_of_sky() {
  static const std::array<vec3, sky_directions> even = [] {
    std::array<vec3, sky_directions> result;
    for (int i = 0; i < sky_directions; ++i) {
      const float z = (float(i) + 0.5f) / float(sky_directions), across = std::sqrt(1.0f - z * z),
                  turn = golden_turn * float(i);
      result[std::size_t(i)] = {across * std::cos(turn), across * std::sin(turn), z};
    }
    return result;
  }();
  return even;
}

void Transfer::lay_out(const Bounds& fixed, float spacing_m) {
  vec3 cell_m(spacing_m, spacing_m, cell_height_share * spacing_m);
  const auto size_m = [&] { return fixed.size() + margin_cells * cell_m; };
  const vec3 wanted = size_m() / cell_m;
  const float cells = wanted.x * wanted.y * wanted.z;
  if (cells > max_cells) cell_m *= std::cbrt(cells / max_cells);
  cell_m = glm::max(cell_m, fixed.size() / (max_side - margin_cells - 1.0f));
  cells_ = glm::max(ivec3(glm::ceil(size_m() / cell_m)), ivec3(1));
  const vec3 origin = fixed.min - vec3(cell_m.x, cell_m.y, 0.25f * cell_m.z);
  grid_ = {origin, cell_m * vec3(cells_), 0.4f * std::min(cell_m.x, cell_m.y), float(cells_.z)};
}

std::size_t Transfer::index(ivec3 cell) const {
  return (std::size_t(cell.z) * std::size_t(cells_.y) + std::size_t(cell.y)) * std::size_t(cells_.x) +
         std::size_t(cell.x);
}

ivec3 Transfer::place_of(std::size_t cell) const {
  return {int(cell) % cells_.x, int(cell) / cells_.x % cells_.y, int(cell) / cells_.x / cells_.y};
}

vec3 Transfer::middle(std::size_t cell) const {
  return grid_.origin + (vec3(place_of(cell)) + 0.5f) * grid_.size_m / vec3(cells_);
}

Transfer::Transfer(const scene::Scene& scene, const reference::RayScene& rays,
                   const scene::BouncedSettings& settings)
    : rays_(settings.rays) {
  const Bounds fixed = rays.fixed_bounds(scene);
  if (fixed.empty()) return;
  lay_out(fixed, settings.spacing_m);
  const std::size_t count = std::size_t(cells_.x) * std::size_t(cells_.y) * std::size_t(cells_.z);
  const float side_m = patch_share * grid_.size_m.x / float(cells_.x);
  is_air_.assign(count, 0);

  // What each place sees, some places at a time: lists of all hits would take hundreds of megabytes.
  PatchSums sums;
  std::vector<std::vector<std::optional<Seen>>> seen(places_at_once);
  for (std::size_t first = 0; first < count; first += places_at_once) {
    const std::size_t size = std::min(places_at_once, count - first);
    parallel_for(
        size,
        [&](std::size_t i) {
          const std::size_t cell = first + i;
          int backs = 0;
          seen[i].clear();
          for (int r = 0; r < rays_; ++r) {
            const vec3 direction = ray_direction(r, rays_, ray_set(std::uint32_t(cell)));
            seen[i].push_back(seen_along(scene, rays, {middle(cell), direction}, side_m,
                                         cell * std::size_t(rays_) + std::size_t(r)));
            backs += seen[i].back() && seen[i].back()->is_back;
          }
          is_air_[cell] = float(backs) <= inside_share * float(rays_);
        },
        64);
    for (std::size_t i = 0; i < size; ++i) {
      if (!is_air_[first + i]) continue;
      air_.push_back(std::uint32_t(first + i));
      for (const std::optional<Seen>& hit : seen[i])
        seen_.push_back(hit && !hit->is_back ? sums.add(*hit, grid_.origin, side_m) : -1);
    }
  }
  find_walls();
  patches_ = sums.means();
  see_sky(scene, rays, sums.points);
  choose_lit_points(sums.points);
}

/// Spread over those that were found, which are in the order of the places that saw them.
void Transfer::choose_lit_points(const std::vector<std::vector<vec3>>& points) {
  lit_points_.reserve(points.size() * lit_points_per_patch);
  for (const std::vector<vec3>& of_patch : points)
    for (std::size_t k = 0; k < lit_points_per_patch; ++k)
      lit_points_.push_back(of_patch[k * of_patch.size() / lit_points_per_patch]);
}

/// Each direction from another point of the patch, so that a patch half in shadow sees half of the sun.
void Transfer::see_sky(const scene::Scene& scene, const reference::RayScene& rays,
                       const std::vector<std::vector<vec3>>& points) {
  parallel_for(
      patches_.size(),
      [&](std::size_t i) {
        for (std::size_t d = 0; d < std::size_t(sky_directions); ++d) {
          const vec3 direction = directions_of_sky()[d];
          if (glm::dot(direction, patches_[i].normal) <= 0.0f) continue;
          const vec3 from = points[i][(7 * d + i) % points[i].size()];
          if (is_open(scene, rays, {from, direction}, std::uint64_t(sky_directions) * i + d))
            patches_[i].sees_sky[d / 64] |= std::uint64_t(1) << (d % 64);
        }
      },
      64);
}

float Transfer::lamp_share(const shading::Lamp& lamp, std::size_t point, const scene::Scene& scene,
                           const reference::RayScene& rays) const {
  const vec3 from = lit_points_[point], normal = patches_[point / lit_points_per_patch].normal;
  const vec3 away = vec3(lamp.place) - from;
  const float distance_m = glm::length(away);
  const float facing = glm::dot(normal, away);
  if (facing <= 0.0f || distance_m < housing_m) return 0.0f;
  shading::Lamp of_one_watt = lamp;
  of_one_watt.power = vec4(1.0f);
  const float share =
      facing / distance_m * shading::lamp_irradiance(of_one_watt, away / distance_m, distance_m).x;
  if (!(share > 0.0f) || !is_open(scene, rays, reference::ray_to_lamp(lamp, from, normal), point))
    return 0.0f;
  return share;
}

/// Irradiance of each patch by sun and sky.
std::vector<vec3> Transfer::direct_irradiance(const scene::Sun& sun, const shading::SkyLight& sky) const {
  const auto& directions = directions_of_sky();
  constexpr float solid_angle = 2.0f * glm::pi<float>() / float(sky_directions);
  const float level = shading::sky_level(0.35f, float(sky.levels.size()));  // as wide as a direction
  std::array<vec3, sky_directions> sky_light;
  for (std::size_t d = 0; d < directions.size(); ++d)
    sky_light[d] = solid_angle * shading::sky_radiance(sky, directions[d], level);
  // The sun between the directions nearest to it.
  const vec3 to_sun = glm::normalize(sun.direction_to_sun);
  std::array<float, sky_directions> sun_share{};
  float sum = 0.0f;
  for (std::size_t d = 0; d < directions.size(); ++d) {
    const float near = glm::dot(directions[d], to_sun);
    constexpr float edge = 0.965f;  // 15 degrees
    sun_share[d] = std::max(near - edge, 0.0f) * std::max(near - edge, 0.0f), sum += sun_share[d];
  }
  std::vector<std::pair<std::size_t, float>> suns;
  for (std::size_t d = 0; d < directions.size(); ++d)
    if (sun_share[d] > 0.0f) suns.emplace_back(d, sun_share[d] / sum);

  std::vector<vec3> irradiance(patches_.size());
  parallel_for(
      patches_.size(),
      [&](std::size_t i) {
        const Patch& patch = patches_[i];
        vec3 from_sky(0.0f);
        float sees_sun = 0.0f;
        for (std::size_t word = 0; word < patch.sees_sky.size(); ++word)
          for (std::uint64_t open = patch.sees_sky[word]; open != 0; open &= open - 1) {
            const std::size_t d = 64 * word + std::size_t(std::countr_zero(open));
            from_sky += std::max(glm::dot(directions[d], patch.normal), 0.0f) * sky_light[d];
          }
        for (const auto& [d, share] : suns) sees_sun += share * float(patch.sees_sky[d / 64] >> (d % 64) & 1);
        irradiance[i] = from_sky + sees_sun * std::max(glm::dot(to_sun, patch.normal), 0.0f) * sun.irradiance;
      },
      256);
  return irradiance;
}

/// Sums of what places see, as two bands of spherical harmonics of irradiance. `radiance` has luminances
/// beside colours, of each patch after a first one for the sky, which is dark.
void Transfer::gather(const std::vector<vec4>& radiance, shading::BouncedLight& light) const {
  std::vector<vec4> directions(std::size_t(ray_sets) * std::size_t(rays_));
  for (int set = 0; set < ray_sets; ++set)
    for (int r = 0; r < rays_; ++r)
      directions[std::size_t(set) * std::size_t(rays_) + std::size_t(r)] =
          vec4(ray_direction(r, rays_, set), 1.0f);
  parallel_for(
      air_.size(),
      [&](std::size_t i) {
        const std::int32_t* seen = seen_.data() + i * std::size_t(rays_);
        const vec4* ray_directions = directions.data() + ray_set(air_[i]) * rays_;
        vec4 sum(0.0f), along(0.0f);
        for (int r = 0; r < rays_; ++r) {
          const vec4 from = radiance[std::size_t(std::int64_t(seen[r]) + 1)];
          sum += from, along += from.w * ray_directions[r];
        }
        light.lobes[air_[i]] = glm::pi<float>() / float(rays_) * vec4(2.0f, 2.0f, 2.0f, 1.0f) * along;
        light.colours[air_[i]] = sum.w > 0.0f ? vec3(sum) / sum.w : vec3(1.0f);
      },
      256);
  fill_walls(light);
}

/// How bright that part of the sky is which each place sees, over the whole of it. A share of the sky alone
/// does not tell: in a street at evening walls hide the glow about the sun.
void Transfer::look_at_sky(const shading::SkyLight& sky, shading::BouncedLight& light) const {
  const auto weight_of = [](vec3 direction) { return 0.5f + direction.z; };  // of ground and walls together
  const float level = shading::sky_level(0.35f, float(sky.levels.size()));   // as wide as a ray stands for
  std::vector<vec4> of_rays(std::size_t(ray_sets) * std::size_t(rays_), vec4(0.0f));  // weighted; w: weight
  vec4 whole(0.0f);
  for (int set = 0; set < ray_sets; ++set)
    for (int r = 0; r < rays_; ++r) {
      const vec3 direction = ray_direction(r, rays_, set);
      if (direction.z <= 0.0f) continue;
      vec4& ray = of_rays[std::size_t(set) * std::size_t(rays_) + std::size_t(r)];
      ray = weight_of(direction) * vec4(shading::sky_radiance(sky, direction, level), 1.0f);
      whole += ray;
    }
  const vec3 mean = glm::max(vec3(whole) / whole.w, vec3(1e-9f));
  light.skies.assign(is_air_.size(), vec3(1.0f));
  parallel_for(
      air_.size(),
      [&](std::size_t i) {
        const std::int32_t* seen = seen_.data() + i * std::size_t(rays_);
        const vec4* rays = of_rays.data() + ray_set(air_[i]) * rays_;
        vec4 sum(0.0f);
        for (int r = 0; r < rays_; ++r)
          if (seen[r] < 0) sum += rays[r];
        if (sum.w > 0.0f) light.skies[air_[i]] = vec3(sum) / sum.w / mean;
      },
      256);
}

/// Cells inside of things, and the air beside each.
void Transfer::find_walls() {
  for (std::size_t cell = 0; cell < is_air_.size(); ++cell) {
    if (is_air_[cell]) continue;
    const std::size_t before = beside_walls_.size();
    const ivec3 at = place_of(cell);
    for (int dz = -1; dz <= 1; ++dz)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const std::size_t beside = index(glm::clamp(at + ivec3(dx, dy, dz), ivec3(0), cells_ - 1));
          if (is_air_[beside]) beside_walls_.push_back(std::uint32_t(beside));
        }
    if (beside_walls_.size() > before)
      walls_.push_back({std::uint32_t(cell), before, beside_walls_.size() - before});
  }
}

/// Cells inside of things take the mean of the air beside them: what is mixed between cells is then not
/// darkened at walls.
void Transfer::fill_walls(shading::BouncedLight& light) const {
  parallel_for(
      walls_.size(),
      [&](std::size_t i) {
        const Wall& wall = walls_[i];
        vec4 lobe(0.0f);
        vec3 colour(0.0f), sky(0.0f);
        for (std::size_t k = wall.first; k < wall.first + wall.count; ++k)
          lobe += light.lobes[beside_walls_[k]], colour += light.colours[beside_walls_[k]],
              sky += light.skies[beside_walls_[k]];
        light.lobes[wall.cell] = lobe / float(wall.count);
        light.colours[wall.cell] = colour / float(wall.count);
        light.skies[wall.cell] = sky / float(wall.count);
      },
      256);
}

shading::BouncedLight Transfer::light(const scene::Sun& sun, const shading::SkyLight& sky,
                                      std::span<const vec3> by_lamps, int bounces) const {
  shading::BouncedLight light;
  if (patches_.empty()) return light;
  light.grid = grid_, light.cells = cells_;
  light.lobes.assign(is_air_.size(), vec4(0.0f));
  light.colours.assign(is_air_.size(), vec3(1.0f));
  look_at_sky(sky, light);
  std::vector<vec3> direct = direct_irradiance(sun, sky);
  for (std::size_t i = 0; i < by_lamps.size(); ++i) direct[i] += by_lamps[i];
  std::vector<vec4> radiance(1 + patches_.size(), vec4(0.0f));  // the first is the sky's: see gather
  for (int bounce = 0; bounce < bounces; ++bounce) {
    parallel_for(
        patches_.size(),
        [&](std::size_t i) {
          const Patch& patch = patches_[i];
          const vec3 again = bounce == 0
                                 ? vec3(0.0f)
                                 : bounced_irradiance(light.cell(patch.position, patch.normal), patch.normal);
          const vec3 out = patch.albedo / glm::pi<float>() * (direct[i] + again);
          radiance[1 + i] = vec4(out, luminance(out));
        },
        256);
    gather(radiance, light);
  }
  return light;
}

}  // namespace parvis::bounced_light
