#include "graphics/light/vertex_light.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <span>

#include "base/parallel.h"
#include "graphics/light/disc_patterns.h"
#include "graphics/light/ray_packet.h"
#include "graphics/reference/traced_hit.h"
#include "graphics/shading/shadow.h"
#include "graphics/shading/sun.h"

namespace parvis::light {
namespace {

constexpr std::size_t bits_per_word = 64;
/// Fraction of the sky before a surface that is open, where the surface's own light is wanted.
constexpr float open_fraction = 0.5f;
/// Albedo of surfaces that rooms draw by themselves: photographs of walls.
constexpr float wall_albedo = 0.35f;

/// Mean of a texture, or white where the surface has none.
glm::vec3 mean_of(const reference::PlacedPart& place, int texture) {
  if (texture == scene::no_index) return glm::vec3(1.0f);
  return glm::vec3((*place.textures)[std::size_t(texture)].mean());
}

/// Mean colour that a surface which a ray hit reflects diffusely, as a fraction of its irradiance.
/// A surface texture has metallic in blue (glTF 2.0, section 3.9.2), by which the factor, 1 unless it is
/// given, is multiplied.
glm::vec3 albedo_of(const reference::PlacedPart& place) {
  if (place.surface) return glm::vec3(wall_albedo);
  const scene::Material& material = *place.material;
  const float metallic = material.metallic * mean_of(place, material.surface_texture).z;
  return (1.0f - metallic) * material.base_colour * mean_of(place, material.base_colour_texture);
}

glm::vec3 lifted_position(const LitVertex& vertex) { return vertex.position + lift_m * vertex.normal; }

/// Weighted by the cosine with the frame's normal.
glm::vec3 on_hemisphere(const reference::Frame& frame, glm::vec2 p) {
  return frame.in_world({p.x, p.y, std::sqrt(std::max(0.0f, 1.0f - glm::dot(p, p)))});
}

/// Light of a lamp in the sun's place: as bright at any distance, within its cone.
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

/// Calls `take(vertex, irradiance)` for each ray to the sun's disc, or to the lamp in its place, that
/// arrives at the vertices from `first` up to `end`.
template <class Take>
void each_sun_ray(const reference::RayScene& scene, const SkyTable& sky,
                  const std::vector<LitVertex>& vertices, std::size_t first, std::size_t end,
                  const DiscPatterns& disc, const Take& take) {
  Packet packet(scene);
  const auto answer = [&] {
    const std::uint32_t blocked = packet.blocked();
    for (std::size_t i = 0; i < packet.count(); ++i) {
      const std::size_t v = packet.tag(i).vertex;
      if ((blocked >> i & 1u) == 0)
        take(v, glm::dot(packet.direction(i), vertices[v].normal) * sky.sun_irradiance());
    }
    packet.clear();
  };
  for (std::size_t v = first; v < end; ++v) {
    const LitVertex& vertex = vertices[v];
    const glm::vec3 from = lifted_position(vertex);
    if (const auto& spot = sky.spot()) {
      const glm::vec3 light = spot_light(scene, sky, *spot, vertex, from, v);
      take(v, float(disc.of(v).size()) * light);
      continue;
    }
    const reference::Frame frame = turned_frame(sky.to_sun(), v);
    for (const DiscPoint& point : disc.of(v)) {
      const glm::vec3 direction =
          glm::normalize(frame.in_world(glm::vec3(shading::sun_radius_rad * point.at, 1.0f)));
      if (!(glm::dot(direction, vertex.normal) > 0.0f)) continue;
      packet.add(from, direction, {v, std::size_t(point.ray)});
      if (packet.is_full()) answer();
    }
  }
  answer();
}

/// Calls `light(begin, end)` for all vertices that share a turn.
template <class Light>
void each_turn(std::size_t vertices, const Light& light) {
  parallel_for((vertices + vertices_per_turn - 1) / vertices_per_turn,
               [&](std::size_t turn) {
                 const std::size_t begin = turn * vertices_per_turn;
                 light(begin, std::min(begin + vertices_per_turn, vertices));
               },
               2);
}

}  // namespace

VertexLight::VertexLight(std::vector<LitVertex> vertices) { restart(std::move(vertices)); }

void VertexLight::restart(std::vector<LitVertex> vertices) {
  vertices_ = std::move(vertices);
  restart();
}

void VertexLight::restart() {
  sums_.assign(vertices_.size(), {});
  open_.clear();
  rays_ = relit_rays_ = sun_rays_ = 0;
}

bool VertexLight::is_open(std::size_t v, std::size_t ray) const {
  return (open_[ray / bits_per_word * vertices_.size() + v] >> ray % bits_per_word & 1u) != 0;
}

void VertexLight::follow(const SkyTable& sky) {
  relit_rays_ = sun_rays_ = 0;
  if (rays_ == 0) return;
  const DiscPatterns patterns(0, rays_);
  parallel_for(
      vertices_.size(),
      [&](std::size_t v) {
        sums_[v] = {};
        const reference::Frame frame = turned_frame(vertices_[v].normal, v);
        for (const DiscPoint& point : patterns.of(v))
          if (is_open(v, std::size_t(point.ray)))
            sums_[v].sky += sky.radiance(on_hemisphere(frame, point.at));
      },
      2 * vertices_per_turn);
}

/// The ray found the sky.
void VertexLight::open(std::size_t v, std::size_t ray, glm::vec3 radiance) {
  open_[ray / bits_per_word * vertices_.size() + v] |= std::uint64_t(1) << ray % bits_per_word;
  sums_[v].sky += radiance;
}

/// The rays of vertices that share a turn, each ray of all of them, then the next.
class VertexLight::Turn {
 public:
  Turn(VertexLight& light, const reference::RayScene& scene, const SkyTable& sky, Finds finds,
       std::size_t begin, std::size_t end)
      : light_(light),
        sky_(sky),
        finds_(finds),
        begin_(begin),
        end_(end),
        open_(scene),
        seen_(scene),
        to_sun_(scene) {
    frames_.reserve(end - begin);
    for (std::size_t v = begin; v < end; ++v) frames_.push_back(turned_frame(light.vertices_[v].normal, v));
  }

  /// Rays that are asked for the surface that they hit.
  void add_seen(std::span<const DiscPoint> points) {
    add(points, seen_, [this] { answer_seen(); });
  }
  /// Rays that are asked whether they are open.
  void add_open(std::span<const DiscPoint> points) {
    add(points, open_, [this] { answer_open(); });
  }
  /// Answers what is left.
  void end() {
    answer_seen();
    answer_open();
    answer_sun();
  }

 private:
  template <class Answer>
  void add(std::span<const DiscPoint> points, Packet& packet, const Answer& answer) {
    for (const DiscPoint& point : points)
      for (std::size_t v = begin_; v < end_; ++v) {
        packet.add(lifted_position(light_.vertices_[v]), on_hemisphere(frames_[v - begin_], point.at),
                   {v, std::size_t(point.ray)});
        if (packet.is_full()) answer();
      }
  }

  void answer_open() {
    const std::uint32_t blocked = open_.blocked();
    for (std::size_t i = 0; i < open_.count(); ++i)
      if ((blocked >> i & 1u) == 0)
        light_.open(open_.tag(i).vertex, open_.tag(i).ray, sky_.radiance(open_.direction(i)));
    open_.clear();
  }

  /// Adds light from the sky, and from matt surfaces, which reflect that of the sun, by a ray each, and of
  /// the sky as if a fraction of the directions before the surface were open.
  void answer_seen() {
    const std::span<const std::optional<reference::Hit>> hits = seen_.hits();
    for (std::size_t i = 0; i < hits.size(); ++i) {
      const auto [v, ray] = seen_.tag(i);
      if (!hits[i]) {
        if (finds_ == Finds::all) light_.open(v, ray, sky_.radiance(seen_.direction(i)));
        continue;
      }
      const reference::Hit& hit = *hits[i];
      const scene::TracedHit at =
          reference::traced_hit(*hit.place, hit.triangle, {hit.u, hit.v}, -seen_.direction(i), 0.0f);
      if (!(glm::dot(at.normal, at.normal) > 0.5f)) continue;  // a sliver without a normal
      const glm::vec3 brdf = albedo_of(*hit.place) / glm::pi<float>();
      light_.sums_[v].reflected += brdf * open_fraction * sky_.irradiance(at.normal);
      const float facing = sky_.spot() ? 0.0f : glm::dot(sky_.to_sun(), at.normal);
      if (facing > 0.0f)
        add_to_sun(at.position + lift_m * at.normal, {v, ray}, brdf * facing * sky_.sun_irradiance());
    }
    seen_.clear();
  }

  void add_to_sun(glm::vec3 from, Packet::Tag tag, glm::vec3 radiance) {
    to_sun_.add(from, sky_.to_sun(), tag);
    by_sun_[to_sun_.count() - 1] = radiance;
    if (to_sun_.is_full()) answer_sun();
  }

  void answer_sun() {
    const std::uint32_t blocked = to_sun_.blocked();
    for (std::size_t i = 0; i < to_sun_.count(); ++i)
      if ((blocked >> i & 1u) == 0) light_.sums_[to_sun_.tag(i).vertex].reflected += by_sun_[i];
    to_sun_.clear();
  }

  VertexLight& light_;
  const SkyTable& sky_;
  Finds finds_;
  std::size_t begin_, end_;
  std::vector<reference::Frame> frames_;
  Packet open_, seen_, to_sun_;
  std::array<glm::vec3, reference::RayScene::packet_size>
      by_sun_;  ///< radiance that each ray to the sun brings
};

void VertexLight::add_rays(const reference::RayScene& scene, const SkyTable& sky, int first, int count,
                           Blocked blocked, Finds finds) {
  const int sun_rays = std::max(1, count / 4);
  const DiscPatterns to_sky(first, count), to_sun(sun_rays_, sun_rays);
  const bool has_bounces = blocked == Blocked::bounces;
  each_turn(vertices_.size(), [&](std::size_t begin, std::size_t end) {
    Turn turn(*this, scene, sky, finds, begin, end);
    if (has_bounces) turn.add_seen(to_sky.bounces_of_vertex(begin));
    if (finds == Finds::all) turn.add_open(has_bounces ? to_sky.others_of_vertex(begin) : to_sky.of(begin));
    turn.end();
    if (sky.sun_irradiance() != glm::vec3(0.0f))
      each_sun_ray(scene, sky, vertices_, begin, end, to_sun,
                   [&](std::size_t v, glm::vec3 irradiance) { sums_[v].sun += irradiance; });
  });
  relit_rays_ += count, sun_rays_ += sun_rays;
}

void VertexLight::refine(const reference::RayScene& scene, const SkyTable& sky, int rays, Blocked blocked) {
  const int again = std::min(rays, rays_ - relit_rays_), added = rays - again;
  if (again > 0) add_rays(scene, sky, relit_rays_, again, blocked, Finds::reflected);
  if (added <= 0) return;
  open_.resize((std::size_t(rays_ + added) + bits_per_word - 1) / bits_per_word * vertices_.size());
  add_rays(scene, sky, rays_, added, blocked, Finds::all);
  rays_ += added;
}

/// Light that surfaces reflect, in the mean of all rays: the mean over the blocked rays that brought it,
/// times the fraction of all rays that are blocked (a ratio estimator: Cochran 1977, Sampling techniques,
/// chapter 6). Fewer rays bring it than are known to be blocked, above all under a new sky.
glm::vec3 VertexLight::mean_reflected(std::size_t v) const {
  constexpr std::uint64_t every_third = 0x9249'2492'4924'9249u;
  static_assert(rays_per_bounce == 3);
  const auto first_bits = [](int count) {
    return count >= int(bits_per_word) ? ~std::uint64_t(0) : (std::uint64_t(1) << std::max(count, 0)) - 1;
  };
  int blocked = 0, bringing = 0;
  for (int first = 0; first < rays_; first += int(bits_per_word)) {
    const std::uint64_t closed =
        ~open_[std::size_t(first) / bits_per_word * vertices_.size() + v] & first_bits(rays_ - first);
    const std::uint64_t brings = every_third << (3 - first % 3) % 3;
    blocked += std::popcount(closed);
    bringing += std::popcount(closed & brings & first_bits(relit_rays_ - first));
  }
  return bringing > 0 ? float(blocked) / float(rays_ * bringing) * sums_[v].reflected : glm::vec3(0.0f);
}

std::vector<glm::vec3> VertexLight::sky_irradiance() const {
  std::vector<glm::vec3> result;
  result.reserve(sums_.size());
  for (std::size_t v = 0; v < sums_.size(); ++v)
    result.push_back(glm::pi<float>() * (sums_[v].sky / float(std::max(1, rays_)) + mean_reflected(v)));
  return result;
}

std::vector<glm::vec3> VertexLight::sun_irradiance() const {
  std::vector<glm::vec3> result;
  result.reserve(sums_.size());
  for (const Sums& sums : sums_) result.push_back(sums.sun / float(std::max(1, sun_rays_)));
  return result;
}

std::vector<glm::vec3> VertexLight::irradiance() const {
  std::vector<glm::vec3> result = sky_irradiance();
  const std::vector<glm::vec3> sun = sun_irradiance();
  for (std::size_t v = 0; v < result.size(); ++v) result[v] += sun[v];
  return result;
}

}  // namespace parvis::light
