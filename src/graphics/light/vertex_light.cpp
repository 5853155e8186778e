#include "graphics/light/vertex_light.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "base/parallel.h"
#include "graphics/light/air.h"
#include "graphics/light/disc_patterns.h"
#include "graphics/light/ray_packet.h"
#include "graphics/reference/traced_hit.h"
#include "graphics/shading/shadow.h"
#include "graphics/shading/spherical_harmonics.h"

namespace parvis::light {
namespace {

constexpr float pi = 3.14159265f;
constexpr std::size_t bits = 64;
/// Of surfaces that rooms draw by themselves: photographs of walls.
constexpr float wall_albedo = 0.35f;
/// Share of the sky before a surface that is open, where what the surface gives back is wanted.
constexpr float open_share = 0.5f;
/// Fewer rays than these look spotted: interpolated visibility is better.
constexpr int min_rays = 16, max_rays = 256;
/// To the sun's disc from a vertex whose sky is interpolated: what lies in the edge of a shadow.
constexpr int max_quick_sun_rays = 4;

glm::vec3 lifted(const LitVertex& vertex) { return vertex.position + lift_m * vertex.normal; }

/// Mean of a texture, or white where the surface has none.
glm::vec3 mean_of(const reference::PlacedPart& place, int texture) {
  if (texture == scene::no_index) return glm::vec3(1.0f);
  return glm::vec3((*place.textures)[std::size_t(texture)].mean());
}

/// Mean colour that a surface which a ray hit gives back matt. A surface texture has metallic in blue
/// (glTF 2.0, section 3.9.2), by which the factor, 1 unless it is given, is multiplied.
glm::vec3 albedo_of(const reference::PlacedPart& place) {
  if (place.surface) return glm::vec3(wall_albedo);
  const scene::Material& material = *place.material;
  const float metallic = material.metallic * mean_of(place, material.surface_texture).z;
  return (1.0f - metallic) * material.base_colour * mean_of(place, material.base_colour_texture);
}

/// Weighted by the cosine with the frame's normal.
glm::vec3 on_hemisphere(const reference::Frame& frame, glm::vec2 p) {
  return frame.in_world({p.x, p.y, std::sqrt(std::max(0.0f, 1.0f - glm::dot(p, p)))});
}

/// Of a lamp in the sun's place: as bright at any distance, within its cone.
glm::vec3 spot_light(const reference::RayScene& scene, const SkyTable& sky, const scene::Spot& spot,
                     const LitVertex& vertex, glm::vec3 from, std::size_t v) {
  const glm::vec3 away = spot.position - from;
  const float distance = glm::length(away);
  if (distance < lift_m) return glm::vec3(0.0f);
  const glm::vec3 direction = away / distance;
  const float facing = glm::dot(direction, vertex.normal) *
                       shading::spot_share(glm::dot(direction, sky.to_sun()), std::cos(spot.half_angle));
  reference::Passage passage{Random(v)};
  if (facing <= 0.0f || scene.is_blocked({from, direction, 1e-4f, distance}, passage)) return glm::vec3(0.0f);
  return facing * sky.sun_irradiance();
}

/// Calls `take(vertex, ray, irradiance)` for each ray to the sun's disc, or to the lamp in its place, that
/// arrives at the vertices from `first` up to `end`.
template <class Take>
void each_sun_ray(const reference::RayScene& scene, const SkyTable& sky,
                  const std::vector<LitVertex>& vertices, std::size_t first, std::size_t end,
                  const DiscPatterns& disc, const Take& take) {
  Packet packet(scene);
  const auto answer = [&] {
    const std::uint32_t blocked = packet.blocked();
    for (std::size_t i = 0; i < packet.count(); ++i) {
      const auto [v, ray] = packet.tag(i);
      if ((blocked >> i & 1u) == 0)
        take(v, ray, glm::dot(packet.direction(i), vertices[v].normal) * sky.sun_irradiance());
    }
    packet.clear();
  };
  for (std::size_t v = first; v < end; ++v) {
    const LitVertex& vertex = vertices[v];
    const glm::vec3 from = lifted(vertex);
    if (const auto& spot = sky.spot()) {
      const glm::vec3 light = spot_light(scene, sky, *spot, vertex, from, v);
      for (const DiscPoint& point : disc.of(v)) take(v, std::size_t(point.ray), light);
      continue;
    }
    const reference::Frame frame = turned_frame(sky.to_sun(), v);
    for (const DiscPoint& point : disc.of(v)) {
      const glm::vec3 direction =
          glm::normalize(frame.in_world(glm::vec3(float(sun_radius_rad) * point.at, 1.0f)));
      if (!(glm::dot(direction, vertex.normal) > 0.0f)) continue;
      packet.add(from, direction, {v, std::size_t(point.ray)});
      if (packet.is_full()) answer();
    }
  }
  answer();
}

bool has_sun(const SkyTable& sky) { return sky.sun_irradiance() != glm::vec3(0.0f); }

/// Of the irradiance of surfaces by the sun, as if they saw it wherever they face it; none of a lamp in its
/// place, of which rays bring no bounces either.
std::array<glm::vec3, 9> harmonics_of_sun(const SkyTable& sky) {
  std::array<glm::vec3, 9> harmonics{};
  if (sky.spot()) return harmonics;
  const std::array<float, 9> basis = shading::sh_basis(sky.to_sun());
  for (std::size_t k = 0; k < harmonics.size(); ++k)
    harmonics[k] = shading::cosine_lobe[k] * basis[k] * sky.sun_irradiance();
  return harmonics;
}

/// Of what numbers 0, 1, 2 and so on add up to: the means of the even ones and of the odd ones.
glm::vec2 means_of_halves(float sum, float sum_of_odd, int count, int odd_count) {
  return {(sum - sum_of_odd) / float(std::max(1, count - odd_count)),
          sum_of_odd / float(std::max(1, odd_count))};
}

/// The greens of all.
std::vector<float> greens(const std::vector<glm::vec3>& colours) {
  std::vector<float> result;
  result.reserve(colours.size());
  for (const glm::vec3 colour : colours) result.push_back(colour.y);
  return result;
}

}  // namespace

VertexLight::VertexLight(std::vector<LitVertex> vertices) { restart(std::move(vertices)); }

void VertexLight::restart(std::vector<LitVertex> vertices) {
  vertices_ = std::move(vertices);
  restart();
}

void VertexLight::restart() {
  sums_.assign(vertices_.size(), {});
  open_.clear(), transfers_.clear();
  rays_ = sunlit_rays_ = sun_rays_ = 0;
}

bool VertexLight::is_open(std::size_t v, std::size_t ray) const {
  return (open_[ray / bits * vertices_.size() + v] >> ray % bits & 1u) != 0;
}

void VertexLight::add_from_sky(std::size_t v, std::size_t ray, glm::vec3 radiance) {
  sums_[v].sky += radiance;
  if (ray % 2 == 1) sums_[v].odd_sky += radiance.y;
}

/// What surfaces would give back of the sun if all of them saw it, per bounce.
glm::vec3 VertexLight::unshadowed(std::size_t v) const {
  glm::vec3 sum(0.0f);
  for (std::size_t k = 0; k < sun_harmonics_.size(); ++k) sum += transfers_[v][k] * sun_harmonics_[k];
  return glm::max(sum, glm::vec3(0.0f)) / (open_share * float(bounces_of(rays_)));
}

/// Of all that surfaces would give back of the sun if they saw it, what they do, by the rays so far.
float VertexLight::share_in_sun() const {
  if (transfers_.empty() || sunlit_rays_ == 0) return former_share_in_sun_;
  double product = 0.0, square = 0.0;
  for (std::size_t v = 0; v < sums_.size(); ++v) {
    const double without = double(unshadowed(v).y);
    product += without * double(sums_[v].bounced_sun.y), square += without * without;
  }
  return square > 0.0 ? float(product / square / double(bounces_of(sunlit_rays_))) : former_share_in_sun_;
}

void VertexLight::follow(const SkyTable& sky) {
  former_share_in_sun_ = share_in_sun();
  sun_harmonics_ = harmonics_of_sun(sky);
  sunlit_rays_ = sun_rays_ = 0;
  if (rays_ == 0) return;
  const float odd_part = float(odd_bounces_of(rays_)) / float(bounces_of(rays_));
  const DiscPatterns patterns(0, rays_);
  parallel_for(
      vertices_.size(),
      [&](std::size_t v) {
        sums_[v] = {};
        const reference::Frame frame = turned_frame(vertices_[v].normal, v);
        for (const DiscPoint& point : patterns.of(v))
          if (is_open(v, std::size_t(point.ray)))
            add_from_sky(v, std::size_t(point.ray), sky.radiance(on_hemisphere(frame, point.at)));
        if (transfers_.empty()) return;
        for (std::size_t k = 0; k < transfers_[v].size(); ++k)
          sums_[v].bounced += transfers_[v][k] * sky.harmonics()[k];
        sums_[v].bounced = glm::max(sums_[v].bounced, glm::vec3(0.0f));
        sums_[v].odd_bounced = odd_part * sums_[v].bounced.y;
      },
      2 * vertices_per_turn);
}

/// The ray found the sky.
void VertexLight::open(std::size_t v, std::size_t ray, glm::vec3 radiance) {
  open_[ray / bits * vertices_.size() + v] |= std::uint64_t(1) << ray % bits;
  add_from_sky(v, ray, radiance);
}

/// Of the rays of a packet that nothing stops; clears it.
void VertexLight::add_open(Packet& packet, const SkyTable& sky) {
  const std::uint32_t blocked = packet.blocked();
  for (std::size_t i = 0; i < packet.count(); ++i)
    if ((blocked >> i & 1u) == 0)
      open(packet.tag(i).vertex, packet.tag(i).ray, sky.radiance(packet.direction(i)));
  packet.clear();
}

/// From the sky, and from matt surfaces, which give back that of the sun, by a ray each, and of the sky as if
/// a share of what lies before the surface were open; clears the packet.
void VertexLight::add_seen(const reference::RayScene& scene, Packet& packet, const SkyTable& sky,
                           Finds finds) {
  Packet to_sun(scene);
  std::array<glm::vec3, reference::RayScene::packet_size> by_sun;  // of those whose surfaces face it
  const std::span<const std::optional<reference::Hit>> hits = packet.hits();
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const std::optional<reference::Hit>& seen = hits[i];
    const auto [v, ray] = packet.tag(i);
    if (!seen) {
      if (finds == Finds::all) open(v, ray, sky.radiance(packet.direction(i)));
      continue;
    }
    const reference::Hit& hit = *seen;
    const scene::TracedHit at =
        reference::traced_hit(*hit.place, hit.triangle, {hit.u, hit.v}, -packet.direction(i), 0.0f);
    if (!(glm::dot(at.normal, at.normal) > 0.5f)) continue;  // a sliver without a normal
    const glm::vec3 given_back = albedo_of(*hit.place) / pi;
    if (finds == Finds::all) {
      const glm::vec3 bounced = given_back * open_share * sky.irradiance(at.normal);
      sums_[v].bounced += bounced;
      if (ray % 2 == 1) sums_[v].odd_bounced += bounced.y;
      const std::array<float, 9> basis = shading::sh_basis(at.normal);
      for (std::size_t k = 0; k < basis.size(); ++k) transfers_[v][k] += given_back * open_share * basis[k];
    }
    const float facing = sky.spot() ? 0.0f : glm::dot(sky.to_sun(), at.normal);
    if (!(facing > 0.0f)) continue;
    by_sun[to_sun.count()] = given_back * facing * sky.sun_irradiance();
    to_sun.add(at.position + lift_m * at.normal, sky.to_sun(), {v, ray});
  }
  const std::uint32_t blocked = to_sun.blocked();
  for (std::size_t i = 0; i < to_sun.count(); ++i) {
    if ((blocked >> i & 1u) != 0) continue;
    const auto [v, ray] = to_sun.tag(i);
    sums_[v].bounced_sun += by_sun[i];
    if (ray % 2 == 1) sums_[v].odd_bounced_sun += by_sun[i].y;
  }
  packet.clear();
}

/// Of vertices that share a turn: each ray of all of them, then the next.
void VertexLight::add_to_sky(const reference::RayScene& scene, const SkyTable& sky, std::size_t begin,
                             std::size_t end, const DiscPatterns& disc, Blocked blocked, Finds finds) {
  std::vector<reference::Frame> frames;
  frames.reserve(end - begin);
  for (std::size_t v = begin; v < end; ++v) frames.push_back(turned_frame(vertices_[v].normal, v));
  Packet packet(scene);
  const auto each = [&](std::span<const DiscPoint> points, const auto& take) {
    for (const DiscPoint& point : points)
      for (std::size_t v = begin; v < end; ++v) {
        packet.add(lifted(vertices_[v]), on_hemisphere(frames[v - begin], point.at),
                   {v, std::size_t(point.ray)});
        if (packet.is_full()) take();
      }
    take();
  };
  const bool has_bounces = blocked == Blocked::bounces;
  if (has_bounces) each(disc.bounces_of_vertex(begin), [&] { add_seen(scene, packet, sky, finds); });
  if (finds == Finds::all)
    each(has_bounces ? disc.others_of_vertex(begin) : disc.of(begin), [&] { add_open(packet, sky); });
}

void VertexLight::add_rays(const reference::RayScene& scene, const SkyTable& sky, int first, int count,
                           Blocked blocked, Finds finds) {
  const int sun_rays = std::max(1, count / 4);
  const DiscPatterns to_sky(first, count), to_sun(sun_rays_, sun_rays);
  const std::size_t groups = (vertices_.size() + vertices_per_turn - 1) / vertices_per_turn;
  parallel_for(
      groups,
      [&](std::size_t group) {
        const std::size_t begin = group * vertices_per_turn,
                          end = std::min(begin + vertices_per_turn, vertices_.size());
        add_to_sky(scene, sky, begin, end, to_sky, blocked, finds);
        if (!has_sun(sky)) return;
        each_sun_ray(scene, sky, vertices_, begin, end, to_sun,
                     [&](std::size_t v, std::size_t ray, glm::vec3 light) {
                       sums_[v].sun += light;
                       if (ray % 2 == 1) sums_[v].odd_sun += light.y;
                     });
      },
      2);
  sunlit_rays_ += count, sun_rays_ += sun_rays;
}

void VertexLight::refine(const reference::RayScene& scene, const SkyTable& sky, int rays, Blocked blocked) {
  sun_harmonics_ = harmonics_of_sun(sky);
  const int again = std::min(rays, rays_ - sunlit_rays_);
  if (again > 0) add_rays(scene, sky, sunlit_rays_, again, blocked, Finds::sun);
  const int added = rays - again;
  if (added <= 0) return;
  if (blocked == Blocked::bounces) transfers_.resize(vertices_.size());
  open_.resize((std::size_t(rays_ + added) + bits - 1) / bits * vertices_.size());
  add_rays(scene, sky, rays_, added, blocked, Finds::all);
  rays_ += added;
}

/// What surfaces give back of the sun, per bounce. While fewer rays have brought it than there are, they
/// measure how much of what surfaces would give back without shadows arrives in the mean of all vertices, and
/// how much that says about each.
std::vector<glm::vec3> VertexLight::bounced_sun() const {
  std::vector<glm::vec3> result(vertices_.size(), glm::vec3(0.0f));
  if (transfers_.empty()) return result;
  const int found = bounces_of(sunlit_rays_), odd = odd_bounces_of(sunlit_rays_);
  for (std::size_t v = 0; v < result.size(); ++v)
    result[v] = sums_[v].bounced_sun / float(std::max(1, found));
  if (sunlit_rays_ == rays_) return result;
  const float share = share_in_sun();
  std::vector<glm::vec3> guess;
  guess.reserve(result.size());
  for (std::size_t v = 0; v < result.size(); ++v) guess.push_back(share * unshadowed(v));
  if (odd == 0) return guess;
  Halves halves;
  for (const Sums& sums : sums_) {
    const glm::vec2 means = means_of_halves(sums.bounced_sun.y, sums.odd_bounced_sun, found, odd);
    halves.first.push_back(means.x), halves.second.push_back(means.y);
  }
  const float weight = weight_of_rays(greens(guess), halves);
  for (std::size_t v = 0; v < result.size(); ++v) result[v] = glm::mix(guess[v], result[v], weight);
  return result;
}

std::vector<glm::vec3> VertexLight::sky_irradiance() const {
  if (rays_ == 0) return std::vector<glm::vec3>(vertices_.size(), glm::vec3(0.0f));
  std::vector<glm::vec3> result = bounced_sun();
  for (std::size_t v = 0; v < result.size(); ++v)
    result[v] = pi * (sums_[v].sky / float(rays_) + sums_[v].bounced / float(bounces_of(rays_)) + result[v]);
  return result;
}

std::vector<glm::vec3> VertexLight::sun_irradiance() const {
  std::vector<glm::vec3> result;
  result.reserve(vertices_.size());
  for (const Sums& sums : sums_) result.push_back(sums.sun / float(std::max(1, sun_rays_)));
  return result;
}

std::vector<glm::vec3> VertexLight::irradiance() const {
  std::vector<glm::vec3> result = sky_irradiance();
  const std::vector<glm::vec3> sun = sun_irradiance();
  for (std::size_t v = 0; v < result.size(); ++v) result[v] += sun[v];
  return result;
}

Halves VertexLight::halves_of_sky() const {
  Halves halves;
  const int bounces = bounces_of(rays_), odd_bounces = odd_bounces_of(rays_),
            sunlit = bounces_of(sunlit_rays_), odd_sunlit = odd_bounces_of(sunlit_rays_);
  for (const Sums& sums : sums_) {
    const glm::vec2 means =
        pi * (means_of_halves(sums.sky.y, sums.odd_sky, rays_, rays_ / 2) +
              means_of_halves(sums.bounced.y, sums.odd_bounced, bounces, odd_bounces) +
              means_of_halves(sums.bounced_sun.y, sums.odd_bounced_sun, sunlit, odd_sunlit));
    halves.first.push_back(means.x), halves.second.push_back(means.y);
  }
  return halves;
}

Halves VertexLight::halves_of_sun() const {
  Halves halves;
  for (const Sums& sums : sums_) {
    const glm::vec2 means = means_of_halves(sums.sun.y, sums.odd_sun, sun_rays_, sun_rays_ / 2);
    halves.first.push_back(means.x), halves.second.push_back(means.y);
  }
  return halves;
}

std::vector<glm::vec3> traced_sun(const std::vector<LitVertex>& vertices, const reference::RayScene& scene,
                                  const SkyTable& sky, int rays) {
  std::vector<glm::vec3> sums(vertices.size(), glm::vec3(0.0f));
  if (!has_sun(sky)) return sums;
  const DiscPatterns to_sun(0, rays);
  constexpr std::size_t group_size = 16;  // whose rays fill packets
  const std::size_t groups = (vertices.size() + group_size - 1) / group_size;
  parallel_for(groups, [&](std::size_t group) {
    const std::size_t begin = group * group_size, end = std::min(begin + group_size, vertices.size());
    each_sun_ray(scene, sky, vertices, begin, end, to_sun,
                 [&](std::size_t v, std::size_t, glm::vec3 light) { sums[v] += light / float(rays); });
  });
  return sums;
}

RelightingPlan plan_relighting(std::size_t vertices, double budget_ms, double rays_per_ms, bool has_places) {
  const double affordable =
      budget_ms * rays_per_ms / double(std::max<std::size_t>(vertices, 1)) / 1.25;  // and rays to the sun
  const int rays = std::min(max_rays, int(affordable) / 4 * 4);
  if (rays >= min_rays) return {Relighting::traced, rays};
  if (has_places && affordable >= rays_per_interpolation)
    return {Relighting::interpolated,
            std::clamp(int(affordable - rays_per_interpolation), 1, max_quick_sun_rays)};
  return {Relighting::open, 0};
}

}  // namespace parvis::light
