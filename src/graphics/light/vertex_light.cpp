#include "graphics/light/vertex_light.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <span>

#include "base/parallel.h"
#include "graphics/light/disc_patterns.h"
#include "graphics/light/own_faces.h"
#include "graphics/light/ray_packet.h"
#include "graphics/reference/traced_hit.h"
#include "graphics/shading/shadow.h"
#include "graphics/shading/spherical_harmonics.h"
#include "graphics/shading/sun.h"

namespace parvis::light {
namespace {

constexpr std::size_t bits_per_word = 64;
/// Fewer rays than these look spotted: interpolated visibility is better.
constexpr int min_rays = 16, max_rays = 256;
/// To the sun's disc from a vertex whose sky is interpolated: what lies in the edge of a shadow.
constexpr int max_quick_sun_rays = 4;

glm::vec3 lifted_position(const LitVertex& vertex) { return vertex.position + lift_m * vertex.normal; }

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
    const glm::vec3 from = lifted_position(vertex);
    if (const auto& spot = sky.spot()) {
      const glm::vec3 light = spot_light(scene, sky, *spot, vertex, from, v);
      for (const DiscPoint& point : disc.of(v)) take(v, std::size_t(point.ray), light);
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

void add_to_halves(Halves& halves, glm::vec2 means) {
  halves.first.push_back(means.x), halves.second.push_back(means.y);
}

/// The greens of all.
std::vector<float> greens(const std::vector<glm::vec3>& colours) {
  std::vector<float> result;
  result.reserve(colours.size());
  for (const glm::vec3 colour : colours) result.push_back(colour.y);
  return result;
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

/// What surfaces give back of a sky.
glm::vec3 light_of(const std::array<glm::vec3, 9>& transfer, const std::array<glm::vec3, 9>& harmonics) {
  glm::vec3 sum(0.0f);
  for (std::size_t k = 0; k < harmonics.size(); ++k) sum += transfer[k] * harmonics[k];
  return sum;
}

}  // namespace

VertexLight::VertexLight(std::vector<LitVertex> vertices) { restart(std::move(vertices)); }

void VertexLight::restart(std::vector<LitVertex> vertices) {
  own_hits_.clear();
  shift(std::move(vertices));
}

void VertexLight::restart() {
  sums_.assign(vertices_.size(), {});
  open_.clear(), bounces_.clear(), own_.clear();
  rays_ = sunlit_rays_ = sun_rays_ = 0;
}

void VertexLight::shift(std::vector<LitVertex> vertices) {
  vertices_ = std::move(vertices);
  restart();
}

bool VertexLight::is_open(std::size_t v, std::size_t ray) const {
  return (open_[ray / bits_per_word * vertices_.size() + v] >> ray % bits_per_word & 1u) != 0;
}

/// What surfaces would give back of the sun if all of them saw it, per bounce.
glm::vec3 VertexLight::unshadowed(std::size_t v) const {
  glm::vec3 sum = light_of(bounces_[v].transfer, sun_harmonics_) / float(bounces_of(rays_));
  if (!own_.empty()) sum += light_of(own_[v].transfer, sun_harmonics_) / float(rays_);
  return glm::max(sum, glm::vec3(0.0f)) / open_share;
}

/// What rays have found that surfaces give back of it, per bounce.
glm::vec3 VertexLight::mean_bounced_sun(std::size_t v) const {
  glm::vec3 mean = bounces_[v].sums.sun / float(std::max(1, bounces_of(sunlit_rays_)));
  if (!own_.empty()) mean += own_[v].sums.sun / float(std::max(1, sunlit_rays_));
  return mean;
}

/// Of all that surfaces would give back of the sun if they saw it, what they do, by the rays so far.
float VertexLight::share_in_sun() const {
  if (bounces_.empty() || sunlit_rays_ == 0) return former_share_in_sun_;
  double product = 0.0, square = 0.0;
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    const double without = double(unshadowed(v).y);
    product += without * double(mean_bounced_sun(v).y), square += without * without;
  }
  return square > 0.0 ? float(product / square) : former_share_in_sun_;
}

void VertexLight::follow(const SkyTable& sky) {
  former_share_in_sun_ = share_in_sun();
  sun_harmonics_ = harmonics_of_sun(sky);
  sunlit_rays_ = sun_rays_ = 0;
  if (rays_ == 0) return;
  const DiscPatterns patterns(0, rays_);
  const auto follow = [&](Bounces& bounces, int count, int odd) {
    bounces.sums = {.sky = glm::max(light_of(bounces.transfer, sky.harmonics()), glm::vec3(0.0f))};
    bounces.sums.odd_sky = float(odd) / float(count) * bounces.sums.sky.y;
  };
  parallel_for(
      vertices_.size(),
      [&](std::size_t v) {
        sums_[v] = {};
        const reference::Frame frame = turned_frame(vertices_[v].normal, v);
        for (const DiscPoint& point : patterns.of(v))
          if (is_open(v, std::size_t(point.ray)))
            sums_[v].add_sky(std::size_t(point.ray), sky.radiance(on_hemisphere(frame, point.at)));
        if (!bounces_.empty()) follow(bounces_[v], bounces_of(rays_), odd_bounces_of(rays_));
        if (!own_.empty()) follow(own_[v], rays_, rays_ / 2);
      },
      2 * vertices_per_turn);
}

/// The ray found the sky.
void VertexLight::open(std::size_t v, std::size_t ray, glm::vec3 radiance) {
  open_[ray / bits_per_word * vertices_.size() + v] |= std::uint64_t(1) << ray % bits_per_word;
  sums_[v].add_sky(ray, radiance);
}

/// The rays of vertices that share a turn, each ray of all of them, then the next.
class VertexLight::Turn {
 public:
  Turn(VertexLight& light, const reference::RayScene& scene, const SkyTable& sky, const OwnFaces* own,
       Finds finds, std::size_t begin, std::size_t end)
      : light_(light),
        sky_(sky),
        own_(own),
        finds_(finds),
        begin_(begin),
        end_(end),
        open_(scene, meets_of(own)),
        seen_(scene, meets_of(own)),
        before_own_(scene, meets_of(own)),
        to_sun_(scene) {
    frames_.reserve(end - begin);
    for (std::size_t v = begin; v < end; ++v) frames_.push_back(turned_frame(light.vertices_[v].normal, v));
  }

  /// `brings`: the rays bring what surfaces that they hit give back.
  void add(std::span<const DiscPoint> points, bool brings) {
    for (const DiscPoint& point : points)
      for (std::size_t v = begin_; v < end_; ++v) {
        const auto ray = std::size_t(point.ray);
        const glm::vec3 from = lifted_position(light_.vertices_[v]),
                        direction = on_hemisphere(frames_[v - begin_], point.at);
        const OwnHit* hit = own_ ? &light_.own_hit(v, ray) : nullptr;
        if (hit && hit->face != no_face)
          add_before_own(from, direction, {v, ray}, *hit);
        else if (brings)
          add_seen(from, direction, {v, ray});
        else if (finds_ == Finds::all)
          add_open(from, direction, {v, ray});
      }
  }
  /// Answers what is left.
  void end() {
    answer_before_own();
    answer_seen();
    answer_open();
    answer_sun();
  }

 private:
  static reference::Meets meets_of(const OwnFaces* own) {
    return own ? reference::Meets::others : reference::Meets::all;
  }

  void add_open(glm::vec3 from, glm::vec3 direction, Packet::Tag tag) {
    open_.add(from, direction, tag);
    if (open_.is_full()) answer_open();
  }
  void add_seen(glm::vec3 from, glm::vec3 direction, Packet::Tag tag) {
    seen_.add(from, direction, tag);
    if (seen_.is_full()) answer_seen();
  }
  void add_before_own(glm::vec3 from, glm::vec3 direction, Packet::Tag tag, const OwnHit& hit) {
    before_own_.add(from, direction, tag, hit.distance_m);
    if (before_own_.is_full()) answer_before_own();
  }
  void add_to_sun(glm::vec3 from, Packet::Tag tag, Bounces& bounces, glm::vec3 light) {
    to_sun_.add(from, sky_.to_sun(), tag);
    by_sun_[to_sun_.count() - 1] = {&bounces, light};
    if (to_sun_.is_full()) answer_sun();
  }

  void answer_open() {
    const std::uint32_t blocked = open_.blocked();
    for (std::size_t i = 0; i < open_.count(); ++i)
      if ((blocked >> i & 1u) == 0)
        light_.open(open_.tag(i).vertex, open_.tag(i).ray, sky_.radiance(open_.direction(i)));
    open_.clear();
  }

  /// From the sky, and from matt surfaces, which give back that of the sun, by a ray each, and of the sky as
  /// if a share of what lies before the surface were open.
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
      const glm::vec3 given_back = albedo_of(*hit.place) / glm::pi<float>();
      Bounces& bounces = light_.bounces_[v];
      if (finds_ == Finds::all)
        add_sky(bounces, ray, given_back, given_back * open_share * sky_.irradiance(at.normal),
                shading::sh_basis(at.normal));
      const float facing = sky_.spot() ? 0.0f : glm::dot(sky_.to_sun(), at.normal);
      if (facing > 0.0f)
        add_to_sun(at.position + lift_m * at.normal, {v, ray}, bounces,
                   given_back * facing * sky_.sun_irradiance());
    }
    seen_.clear();
  }

  static void add_sky(Bounces& bounces, std::size_t ray, glm::vec3 given_back, glm::vec3 light,
                      const std::array<float, 9>& basis) {
    bounces.sums.add_sky(ray, light);
    for (std::size_t k = 0; k < basis.size(); ++k) bounces.transfer[k] += given_back * open_share * basis[k];
  }

  /// What hits the object itself, unless other things stand before that.
  void answer_before_own() {
    const std::uint32_t blocked = before_own_.blocked();
    for (std::size_t i = 0; i < before_own_.count(); ++i) {
      const auto [v, ray] = before_own_.tag(i);
      const glm::vec3 from = before_own_.from(i), direction = before_own_.direction(i);
      if ((blocked >> i & 1u) != 0) {
        if (brings_bounce(int(ray))) add_seen(from, direction, {v, ray});
        continue;
      }
      const OwnHit& hit = light_.own_hit(v, ray);
      const OwnFaces::Face& face = own_->face(hit.face);
      Bounces& bounces = light_.own_[v];
      if (finds_ == Finds::all) add_sky(bounces, ray, face.given_back, face.sky, face.basis);
      bounces.sums.add_sun(ray, face.sun);
      if (brings_bounce(int(ray))) add_difference(from + hit.distance_m * direction, {v, ray}, face);
    }
    before_own_.clear();
  }

  /// The sun at a point of a face, less that of the whole face, which the vertex has been given for all of
  /// its rays.
  void add_difference(glm::vec3 point, Packet::Tag tag, const OwnFaces::Face& face) {
    const float facing = sky_.spot() ? 0.0f : glm::dot(sky_.to_sun(), face.normal);
    if (!(facing > 0.0f)) return;
    Bounces& bounces = light_.bounces_[tag.vertex];
    bounces.sums.add_sun(tag.ray, -face.sun);
    add_to_sun(point + lift_m * face.normal, tag, bounces, face.given_back * facing * sky_.sun_irradiance());
  }

  void answer_sun() {
    const std::uint32_t blocked = to_sun_.blocked();
    for (std::size_t i = 0; i < to_sun_.count(); ++i)
      if ((blocked >> i & 1u) == 0) by_sun_[i].bounces->sums.add_sun(to_sun_.tag(i).ray, by_sun_[i].light);
    to_sun_.clear();
  }

  VertexLight& light_;
  const SkyTable& sky_;
  const OwnFaces* own_;
  Finds finds_;
  std::size_t begin_, end_;
  std::vector<reference::Frame> frames_;
  Packet open_, seen_, before_own_, to_sun_;
  /// What the rays to the sun bring, and to what.
  struct BySun {
    Bounces* bounces;
    glm::vec3 light;
  };
  std::array<BySun, reference::RayScene::packet_size> by_sun_;
};

void VertexLight::add_rays(const reference::RayScene& scene, const SkyTable& sky, int first, int count,
                           Blocked blocked, const OwnFaces* own, Finds finds) {
  const int sun_rays = std::max(1, count / 4);
  const DiscPatterns to_sky(first, count), to_sun(sun_rays_, sun_rays);
  const bool has_bounces = blocked == Blocked::bounces;
  each_turn(vertices_.size(), [&](std::size_t begin, std::size_t end) {
    Turn turn(*this, scene, sky, own, finds, begin, end);
    if (has_bounces) turn.add(to_sky.bounces_of_vertex(begin), true);
    if (finds == Finds::all || own)
      turn.add(has_bounces ? to_sky.others_of_vertex(begin) : to_sky.of(begin), false);
    turn.end();
    if (has_sun(sky))
      each_sun_ray(scene, sky, vertices_, begin, end, to_sun,
                   [&](std::size_t v, std::size_t ray, glm::vec3 light) { sums_[v].add_sun(ray, light); });
  });
  sunlit_rays_ += count, sun_rays_ += sun_rays;
}

/// What the first `rays` of each vertex hit of its own object.
void VertexLight::find_own(const reference::RayScene& scene, const OwnFaces& own, int rays) {
  const int known = vertices_.empty() ? rays : int(own_hits_.size() / vertices_.size());
  if (known >= rays) return;
  own_hits_.resize(std::size_t(rays) * vertices_.size(), {no_face, 0.0f});
  const DiscPatterns patterns(known, rays - known);
  each_turn(vertices_.size(), [&](std::size_t begin, std::size_t end) {
    Packet packet(scene, reference::Meets::apart);
    const auto answer = [&] {
      const std::span<const std::optional<reference::Hit>> hits = packet.hits();
      for (std::size_t i = 0; i < hits.size(); ++i)
        if (hits[i])
          own_hits_[packet.tag(i).ray * vertices_.size() + packet.tag(i).vertex] = {
              own.number(*hits[i], packet.direction(i)), hits[i]->distance_m};
      packet.clear();
    };
    std::vector<reference::Frame> frames;
    for (std::size_t v = begin; v < end; ++v) frames.push_back(turned_frame(vertices_[v].normal, v));
    for (const DiscPoint& point : patterns.of(begin))
      for (std::size_t v = begin; v < end; ++v) {
        packet.add(lifted_position(vertices_[v]), on_hemisphere(frames[v - begin], point.at),
                   {v, std::size_t(point.ray)});
        if (packet.is_full()) answer();
      }
    answer();
  });
}

void VertexLight::refine(const reference::RayScene& scene, const SkyTable& sky, int rays, Blocked blocked,
                         const OwnFaces* own) {
  if (blocked != Blocked::bounces) own = nullptr;
  if (rays_ > 0 && (own != nullptr) == own_.empty()) restart();
  sun_harmonics_ = harmonics_of_sun(sky);
  const int again = std::min(rays, rays_ - sunlit_rays_);
  if (again > 0) add_rays(scene, sky, sunlit_rays_, again, blocked, own, Finds::sun);
  const int added = rays - again;
  if (added <= 0) return;
  if (blocked == Blocked::bounces) bounces_.resize(vertices_.size());
  if (own) own_.resize(vertices_.size()), find_own(scene, *own, rays_ + added);
  open_.resize((std::size_t(rays_ + added) + bits_per_word - 1) / bits_per_word * vertices_.size());
  add_rays(scene, sky, rays_, added, blocked, own, Finds::all);
  rays_ += added;
}

/// What surfaces give back of the sun, per bounce. While fewer rays have brought it than there are, they
/// measure how much of what surfaces would give back without shadows arrives in the mean of all vertices, and
/// how much that says about each.
std::vector<glm::vec3> VertexLight::bounced_sun() const {
  std::vector<glm::vec3> result(vertices_.size(), glm::vec3(0.0f));
  if (bounces_.empty()) return result;
  for (std::size_t v = 0; v < result.size(); ++v) result[v] = mean_bounced_sun(v);
  if (sunlit_rays_ == rays_) return result;
  const float share = share_in_sun();
  std::vector<glm::vec3> guess;
  guess.reserve(result.size());
  for (std::size_t v = 0; v < result.size(); ++v) guess.push_back(share * unshadowed(v));
  if (odd_bounces_of(sunlit_rays_) == 0) return guess;
  Halves halves;
  for (std::size_t v = 0; v < result.size(); ++v) add_to_halves(halves, halves_of_bounced_sun(v));
  const float weight = weight_of_rays(greens(guess), halves);
  for (std::size_t v = 0; v < result.size(); ++v) result[v] = glm::mix(guess[v], result[v], weight);
  return result;
}

/// By even and by odd rays.
glm::vec2 VertexLight::halves_of_bounced_sun(std::size_t v) const {
  glm::vec2 means(0.0f);
  if (!bounces_.empty())
    means = means_of_halves(bounces_[v].sums.sun.y, bounces_[v].sums.odd_sun, bounces_of(sunlit_rays_),
                            odd_bounces_of(sunlit_rays_));
  if (!own_.empty())
    means += means_of_halves(own_[v].sums.sun.y, own_[v].sums.odd_sun, sunlit_rays_, sunlit_rays_ / 2);
  return means;
}

std::vector<glm::vec3> VertexLight::sky_irradiance() const {
  if (rays_ == 0) return std::vector<glm::vec3>(vertices_.size(), glm::vec3(0.0f));
  std::vector<glm::vec3> result = bounced_sun();
  for (std::size_t v = 0; v < result.size(); ++v) {
    result[v] += sums_[v].sky / float(rays_);
    if (!bounces_.empty()) result[v] += bounces_[v].sums.sky / float(bounces_of(rays_));
    if (!own_.empty()) result[v] += own_[v].sums.sky / float(rays_);
    result[v] *= glm::pi<float>();
  }
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
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    glm::vec2 means = means_of_halves(sums_[v].sky.y, sums_[v].odd_sky, rays_, rays_ / 2);
    if (!bounces_.empty())
      means += means_of_halves(bounces_[v].sums.sky.y, bounces_[v].sums.odd_sky, bounces_of(rays_),
                               odd_bounces_of(rays_));
    if (!own_.empty()) means += means_of_halves(own_[v].sums.sky.y, own_[v].sums.odd_sky, rays_, rays_ / 2);
    add_to_halves(halves, glm::pi<float>() * (means + halves_of_bounced_sun(v)));
  }
  return halves;
}

Halves VertexLight::halves_of_sun() const {
  Halves halves;
  for (const Sums& sums : sums_)
    add_to_halves(halves, means_of_halves(sums.sun.y, sums.odd_sun, sun_rays_, sun_rays_ / 2));
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
