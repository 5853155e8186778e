#include "graphics/light/vertex_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/parallel.h"
#include "graphics/reference/frame.h"
#include "graphics/reference/traced_hit.h"
#include "graphics/shading/octahedral.h"
#include "graphics/shading/shadow.h"
#include "graphics/shading/sky.h"
#include "graphics/shading/spherical_harmonics.h"

namespace parvis::light {
namespace {

constexpr float lift_m = 1e-3f;
/// Of surfaces that rooms draw by themselves: photographs of walls.
constexpr float wall_albedo = 0.35f;
/// Fewer rays than these look spotted: interpolated visibility is better.
constexpr int min_rays = 16, max_rays = 256;
/// One ray of so many brings the light of what it hits, for all of them: such light is smooth, and its rays
/// cost several times as much. Every third point of the R2 sequence is as even as all are; every fourth is
/// not.
constexpr int rays_per_bounce = 3;

glm::vec3 displayable(glm::vec3 xyz) { return glm::max(rec709_from_xyz(xyz), glm::vec3(0.0f)); }

/// In [0, 1), another for each number (PCG's output function, O'Neill 2014).
float scrambled(std::uint32_t value) {
  value = value * 747796405u + 2891336453u;
  value = ((value >> ((value >> 28) + 4)) ^ value) * 277803737u;
  return float((value >> 22 ^ value) >> 8) * 0x1p-24f;
}

/// Points of the R2 sequence (Roberts 2018), moved for each pattern (Cranley and Patterson 1976).
glm::vec2 low_discrepancy(int index, glm::vec2 shift) {
  const glm::dvec2 step(0.7548776662466927, 0.5698402909980532);
  return glm::vec2(glm::fract(glm::dvec2(shift) + double(index) * step));
}

/// Even over the unit disc (Shirley and Chiu 1997).
glm::vec2 on_disc(glm::vec2 u) {
  const glm::vec2 p = 2.0f * u - 1.0f;
  if (p.x == 0.0f && p.y == 0.0f) return p;
  const bool is_wide = std::abs(p.x) > std::abs(p.y);
  const float radius = is_wide ? p.x : p.y;
  const float angle = is_wide ? 0.785398163f * p.y / p.x : 1.570796327f - 0.785398163f * p.x / p.y;
  return radius * glm::vec2(std::cos(angle), std::sin(angle));
}

/// Everything stops light, from both sides; the random number is for what blends.
bool is_open(const reference::RayScene& scene, glm::vec3 from, glm::vec3 direction, std::uint64_t ray) {
  reference::Passage passage{Random(ray)};
  return !scene.is_blocked({from, direction, 1e-4f, 1e30f}, passage);
}

/// Rays that are answered together. Everything stops light, from both sides.
class Packet {
 public:
  explicit Packet(const reference::RayScene& scene) : scene_(scene) {}

  /// The number is for what blends.
  void add(glm::vec3 from, glm::vec3 direction, std::uint64_t number) {
    rays_[count_] = {from, direction, 1e-4f, 1e30f};
    passages_[count_++] = {Random(number)};
  }
  bool is_full() const { return count_ == rays_.size(); }
  std::size_t count() const { return count_; }
  glm::vec3 direction(std::size_t ray) const { return rays_[ray].direction; }
  void clear() { count_ = 0; }

  /// A bit for each ray that something stops.
  std::uint32_t blocked() {
    return count_ > 0 ? scene_.are_blocked(std::span(rays_.data(), count_), {passages_.data(), count_}) : 0;
  }
  /// What each ray hits first.
  std::span<const std::optional<reference::Hit>> hits() {
    if (count_ > 0) scene_.nearest_hits(std::span(rays_.data(), count_), {passages_.data(), count_}, hits_);
    return {hits_.data(), count_};
  }

 private:
  const reference::RayScene& scene_;
  std::size_t count_ = 0;
  std::array<reference::Ray, reference::RayScene::packet_size> rays_;
  std::array<reference::Passage, reference::RayScene::packet_size> passages_{};
  std::array<std::optional<reference::Hit>, reference::RayScene::packet_size> hits_;
};

glm::vec3 lifted(const LitVertex& vertex) { return vertex.position + lift_m * vertex.normal; }

/// Which of the rays of a vertex bring the light of what they hit, and how many of the first rays do.
bool brings_bounce(int ray) { return ray % rays_per_bounce == 0; }
int bounces_of(int rays) { return (rays + rays_per_bounce - 1) / rays_per_bounce; }

/// Points of the unit disc for several vertices to share: rays `first` to `first + count - 1` of each
/// pattern. Vertices that share a pattern differ by a turn about their normals. Rays that bring bounces come
/// first, then the others, each by their angles: rays that are answered together go about the same way.
class DiscPatterns {
 public:
  DiscPatterns(int first, int count)
      : count_(std::size_t(count)), bounces_(std::size_t(bounces_of(first + count) - bounces_of(first))) {
    points_.reserve(pattern_count * count_);
    std::vector<glm::vec2> others;
    others.reserve(count_);
    for (std::size_t pattern = 0; pattern < pattern_count; ++pattern) {
      const glm::vec2 shift(scrambled(std::uint32_t(2 * pattern)), scrambled(std::uint32_t(2 * pattern + 1)));
      others.clear();
      for (int i = first; i < first + count; ++i)
        (brings_bounce(i) ? points_ : others).push_back(on_disc(low_discrepancy(i, shift)));
      sort_by_angle(std::span(points_).last(bounces_));
      sort_by_angle(others);
      points_.insert(points_.end(), others.begin(), others.end());
    }
  }
  /// How many rays of each vertex bring bounces.
  std::size_t bounces() const { return bounces_; }
  /// Those of a vertex, before its turn.
  std::span<const glm::vec2> of(std::size_t vertex) const {
    return {points_.data() + vertex % pattern_count * count_, count_};
  }

 private:
  static void sort_by_angle(std::span<glm::vec2> points) {
    std::ranges::sort(points, {}, [](glm::vec2 p) { return std::atan2(p.y, p.x); });
  }

  static constexpr std::size_t pattern_count = 64;
  std::size_t count_, bounces_;
  std::vector<glm::vec2> points_;
};

/// Axes about a direction, turned for a vertex.
reference::Frame turned_frame(glm::vec3 normal, std::size_t vertex) {
  reference::Frame frame(normal);
  const float turn = 6.2831853f * scrambled(std::uint32_t(vertex)), c = std::cos(turn), s = std::sin(turn);
  const glm::vec3 tangent = c * frame.tangent + s * frame.bitangent;
  frame.bitangent = c * frame.bitangent - s * frame.tangent;
  frame.tangent = tangent;
  return frame;
}

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

/// Of the rays of a packet that nothing stops; clears it.
glm::vec3 open_radiance(Packet& packet, const SkyTable& sky) {
  glm::vec3 sum(0.0f);
  const std::uint32_t blocked = packet.blocked();
  for (std::size_t i = 0; i < packet.count(); ++i)
    if ((blocked >> i & 1u) == 0) sum += sky.radiance(packet.direction(i));
  packet.clear();
  return sum;
}

/// Light that arrives along the rays of a packet.
struct Arriving {
  glm::vec3 from_sky, bounced;
};

/// From the sky, and from matt surfaces, which give back that of the sun, by a ray each, and of the sky as if
/// half of what lies before the surface were open; clears the packet.
Arriving seen_radiance(const reference::RayScene& scene, Packet& packet, const SkyTable& sky) {
  constexpr float open_share = 0.5f;
  Arriving sum{glm::vec3(0.0f), glm::vec3(0.0f)};
  Packet to_sun(scene);
  std::array<glm::vec3, reference::RayScene::packet_size> by_sun;  // of those whose surfaces face it
  const std::span<const std::optional<reference::Hit>> hits = packet.hits();
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const std::optional<reference::Hit>& seen = hits[i];
    if (!seen) {
      sum.from_sky += sky.radiance(packet.direction(i));
      continue;
    }
    const reference::Hit& hit = *seen;
    const scene::TracedHit at =
        reference::traced_hit(*hit.place, hit.triangle, {hit.u, hit.v}, -packet.direction(i), 0.0f);
    if (!(glm::dot(at.normal, at.normal) > 0.5f)) continue;  // a sliver without a normal
    const glm::vec3 given_back = albedo_of(*hit.place) / 3.14159265f;
    sum.bounced += given_back * open_share * sky.irradiance(at.normal);
    const float facing = sky.spot() ? 0.0f : glm::dot(sky.to_sun(), at.normal);
    if (!(facing > 0.0f)) continue;
    by_sun[to_sun.count()] = given_back * facing * sky.sun_irradiance();
    to_sun.add(at.position + lift_m * at.normal, sky.to_sun(), hit.triangle);
  }
  const std::uint32_t blocked = to_sun.blocked();
  for (std::size_t i = 0; i < to_sun.count(); ++i)
    if ((blocked >> i & 1u) == 0) sum.bounced += by_sun[i];
  packet.clear();
  return sum;
}

/// Of level ground that is as bright everywhere.
glm::vec3 from_below(glm::vec3 normal, const SkyTable& sky, Blocked blocked) {
  if (blocked == Blocked::dark) return glm::vec3(0.0f);
  return 0.5f * (1.0f - normal.z) * 3.14159265f * sky.radiance({0.0f, 0.0f, -1.0f});
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

}  // namespace

SkyTable::SkyTable(const SkyModel& sky)
    : to_sun_(sky.to_sun()), sun_irradiance_(displayable(sky.sun_irradiance_xyz())) {
  fill([&](glm::vec3 direction) { return displayable(sky.sky_radiance_xyz(direction)); });
}

SkyTable::SkyTable(const scene::Scene& scene)
    : to_sun_(glm::normalize(scene.sun.direction_to_sun)),
      sun_irradiance_(scene.sun.irradiance),
      spot_(scene.data<scene::SunShadows>().spot) {
  const shading::SkyLight light =
      shading::make_sky_light(scene.sky.picture, scene.sky.intensity, scene.sky.heading);
  fill([&](glm::vec3 direction) { return shading::sky_radiance(light, direction, 0.0f); });
}

void SkyTable::fill(const std::function<glm::vec3(glm::vec3 direction)>& radiance) {
  texels_.resize(std::size_t(side) * side);
  const auto direction_of = [](std::size_t i) {
    const int row = int(i) / side, column = int(i) % side;
    const glm::vec2 uv = (glm::vec2(float(column), float(row)) + 0.5f) / float(side);
    return shading::octahedral_direction(uv);
  };
  parallel_for(
      texels_.size(), [&](std::size_t i) { texels_[i] = radiance(direction_of(i)); }, 256);
  // A texel of the octahedron |x| + |y| + |z| = 1 stands for a solid angle that grows with 1 / distance^3
  // from its middle.
  float sphere = 0.0f;
  for (std::size_t i = 0; i < texels_.size(); ++i) {
    const glm::vec3 d = direction_of(i);
    const float one_norm = std::abs(d.x) + std::abs(d.y) + std::abs(d.z),
                weight = one_norm * one_norm * one_norm;
    const std::array<float, 9> basis = shading::sh_basis(d);
    for (std::size_t k = 0; k < 9; ++k) sh_[k] += weight * shading::cosine_lobe[k] * basis[k] * texels_[i];
    sphere += weight;
  }
  for (glm::vec3& coefficient : sh_) coefficient *= 12.566371f / sphere;
}

glm::vec3 SkyTable::irradiance(glm::vec3 normal) const {
  std::array<glm::vec3, 9> sh = sh_;
  return shading::sky_irradiance(sh.data(), normal);
}

glm::vec3 SkyTable::radiance(glm::vec3 direction) const {
  const glm::vec2 at = shading::octahedral_uv(direction) * float(side);
  const int x = std::clamp(int(at.x), 0, side - 1), y = std::clamp(int(at.y), 0, side - 1);
  return texels_[std::size_t(y) * side + std::size_t(x)];
}

VertexLight::VertexLight(std::vector<LitVertex> vertices) { restart(std::move(vertices)); }

void VertexLight::restart(std::vector<LitVertex> vertices) {
  vertices_ = std::move(vertices);
  restart();
}

void VertexLight::restart() {
  sky_sums_.assign(vertices_.size(), glm::vec3(0.0f));
  bounced_sums_.assign(vertices_.size(), glm::vec3(0.0f));
  sun_sums_.assign(vertices_.size(), glm::vec3(0.0f));
  rays_ = sun_rays_ = 0;
}

void VertexLight::add_sky_light(const reference::RayScene& scene, const SkyTable& sky, std::size_t v,
                                std::span<const glm::vec2> disc, std::size_t bounces) {
  const LitVertex& vertex = vertices_[v];
  const reference::Frame frame = turned_frame(vertex.normal, v);
  const glm::vec3 from = lifted(vertex);
  Packet seeing(scene), others(scene);
  const auto take_seen = [&] {
    const Arriving arriving = seen_radiance(scene, seeing, sky);
    sky_sums_[v] += arriving.from_sky, bounced_sums_[v] += arriving.bounced;
  };
  for (std::size_t i = 0; i < disc.size(); ++i) {
    const glm::vec2 p = disc[i];
    (i < bounces ? seeing : others)
        .add(from, frame.in_world({p.x, p.y, std::sqrt(std::max(0.0f, 1.0f - glm::dot(p, p)))}), v + i);
    if (others.is_full()) sky_sums_[v] += open_radiance(others, sky);
    if (seeing.is_full()) take_seen();
  }
  sky_sums_[v] += open_radiance(others, sky);
  take_seen();
}

glm::vec3 VertexLight::sun_light(const reference::RayScene& scene, const SkyTable& sky, std::size_t v,
                                 std::span<const glm::vec2> disc) const {
  const LitVertex& vertex = vertices_[v];
  const glm::vec3 from = lifted(vertex);
  if (const auto& spot = sky.spot())
    return float(disc.size()) * spot_light(scene, sky, *spot, vertex, from, v);
  const reference::Frame frame = turned_frame(sky.to_sun(), v);
  glm::vec3 sum(0.0f);
  Packet packet(scene);
  const auto take = [&] {
    const std::uint32_t blocked = packet.blocked();
    for (std::size_t i = 0; i < packet.count(); ++i)
      if ((blocked >> i & 1u) == 0)
        sum += glm::dot(packet.direction(i), vertex.normal) * sky.sun_irradiance();
    packet.clear();
  };
  for (std::size_t i = 0; i < disc.size(); ++i) {
    const glm::vec3 direction =
        glm::normalize(frame.in_world(glm::vec3(float(sun_radius_rad) * disc[i], 1.0f)));
    if (glm::dot(direction, vertex.normal) > 0.0f) packet.add(from, direction, v + i);
    if (packet.is_full()) take();
  }
  take();
  return sum;
}

void VertexLight::refine(const reference::RayScene& scene, const SkyTable& sky, int rays, Blocked blocked) {
  const int sun_rays = std::max(1, rays / 4);
  const bool has_sun = sky.sun_irradiance() != glm::vec3(0.0f);
  const DiscPatterns to_sky(rays_, rays), to_sun(sun_rays_, sun_rays);
  parallel_for(
      vertices_.size(),
      [&](std::size_t v) {
        add_sky_light(scene, sky, v, to_sky.of(v), blocked == Blocked::bounces ? to_sky.bounces() : 0);
        if (has_sun) sun_sums_[v] += sun_light(scene, sky, v, to_sun.of(v));
      },
      16);
  rays_ += rays, sun_rays_ += sun_rays;
}

std::vector<glm::vec3> VertexLight::sky_irradiance() const {
  std::vector<glm::vec3> result(vertices_.size(), glm::vec3(0.0f));
  if (rays_ == 0) return result;
  for (std::size_t v = 0; v < result.size(); ++v)
    result[v] = 3.14159265f * (sky_sums_[v] / float(rays_) + bounced_sums_[v] / float(bounces_of(rays_)));
  return result;
}

std::vector<glm::vec3> VertexLight::irradiance() const {
  std::vector<glm::vec3> result = sky_irradiance();
  if (rays_ == 0) return result;
  for (std::size_t v = 0; v < result.size(); ++v) result[v] += sun_sums_[v] / float(sun_rays_);
  return result;
}

const std::vector<glm::vec3>& VisibilityPlaces::directions() {
  static const std::vector<glm::vec3> even = [] {
    std::vector<glm::vec3> result;
    for (int i = 0; i < 64; ++i) {
      const float z = (float(i) + 0.5f) / 64.0f, across = std::sqrt(1.0f - z * z),
                  turn = 2.39996323f * float(i);
      result.emplace_back(across * std::cos(turn), across * std::sin(turn), z);
    }
    return result;
  }();
  return even;
}

VisibilityPlaces::VisibilityPlaces(const reference::RayScene& scene, const Bounds& region, float spacing_m,
                                   std::size_t max_places)
    : origin_(region.min), spacing_m_(spacing_m) {
  const auto counts = [&] { return glm::ivec3(glm::ceil(region.size() / spacing_m_)) + 1; };
  while (glm::dot(glm::dvec3(1.0), glm::log(glm::dvec3(counts()))) > std::log(double(max_places)))
    spacing_m_ *= 1.26f;
  counts_ = counts();
  masks_.resize(std::size_t(counts_.x) * std::size_t(counts_.y) * std::size_t(counts_.z));
  parallel_for(
      masks_.size(),
      [&](std::size_t i) {
        const int x = int(i) % counts_.x, y = int(i) / counts_.x % counts_.y,
                  z = int(i) / counts_.x / counts_.y;
        const glm::vec3 at = origin_ + spacing_m_ * glm::vec3(x, y, z);
        for (std::size_t k = 0; k < 64; ++k)
          if (is_open(scene, at, directions()[k], i + k)) masks_[i] |= std::uint64_t(1) << k;
      },
      16);
}

std::uint64_t VisibilityPlaces::mask(glm::ivec3 place) const {
  const glm::ivec3 p = glm::clamp(place, glm::ivec3(0), counts_ - 1);
  return masks_[(std::size_t(p.z) * std::size_t(counts_.y) + std::size_t(p.y)) * std::size_t(counts_.x) +
                std::size_t(p.x)];
}

void VisibilityPlaces::interpolate(glm::vec3 point, float (&shares)[64]) const {
  const glm::vec3 at = (point - origin_) / spacing_m_, low = glm::floor(at), part = at - low;
  std::fill(std::begin(shares), std::end(shares), 0.0f);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::ivec3 step(corner & 1, corner >> 1 & 1, corner >> 2);
    float weight = 1.0f;
    for (int axis = 0; axis < 3; ++axis) weight *= step[axis] ? part[axis] : 1.0f - part[axis];
    const std::uint64_t bits = mask(glm::ivec3(low) + step);
    for (std::size_t k = 0; k < 64; ++k) shares[k] += weight * float(bits >> k & 1);
  }
}

InterpolatedLight interpolated_irradiance(const std::vector<LitVertex>& vertices,
                                          const VisibilityPlaces& places, const reference::RayScene& scene,
                                          const SkyTable& sky, Blocked blocked) {
  std::vector<glm::vec3> radiance;
  for (const glm::vec3 direction : VisibilityPlaces::directions())
    radiance.push_back(sky.radiance(direction));
  InterpolatedLight result{std::vector<glm::vec3>(vertices.size()),
                           std::vector<glm::vec3>(vertices.size(), glm::vec3(0.0f))};
  parallel_for(
      vertices.size(),
      [&](std::size_t v) {
        float shares[64];
        places.interpolate(vertices[v].position, shares);
        glm::vec3 sum(0.0f);
        for (std::size_t k = 0; k < 64; ++k)
          sum += shares[k] * std::max(glm::dot(VisibilityPlaces::directions()[k], vertices[v].normal), 0.0f) *
                 radiance[k];
        result.sky[v] = 6.2831853f / 64.0f * sum + from_below(vertices[v].normal, sky, blocked);
        if (const auto& spot = sky.spot()) {
          result.sun[v] = spot_light(scene, sky, *spot, vertices[v], lifted(vertices[v]), v);
          return;
        }
        const float facing = glm::dot(sky.to_sun(), vertices[v].normal);
        if (facing > 0.0f && is_open(scene, lifted(vertices[v]), sky.to_sun(), v))
          result.sun[v] = facing * sky.sun_irradiance();
      },
      64);
  return result;
}

RelightingPlan plan_relighting(std::size_t vertices, double budget_ms, double rays_per_ms, bool has_places) {
  const double affordable =
      budget_ms * rays_per_ms / double(std::max<std::size_t>(vertices, 1)) / 1.25;  // and rays to the sun
  const int rays = std::min(max_rays, int(affordable) / 4 * 4);
  if (rays >= min_rays) return {Relighting::traced, rays};
  // a vertex interpolates in the time of about two rays
  if (has_places && affordable >= 2.0) return {Relighting::interpolated, 0};
  return {Relighting::open, 0};
}

std::vector<glm::vec3> open_irradiance(const std::vector<LitVertex>& vertices, const SkyTable& sky,
                                       Blocked blocked) {
  std::vector<glm::vec3> result(vertices.size());
  parallel_for(
      vertices.size(),
      [&](std::size_t v) {
        glm::vec3 sum(0.0f);
        for (const glm::vec3 direction : VisibilityPlaces::directions())
          sum += std::max(glm::dot(direction, vertices[v].normal), 0.0f) * sky.radiance(direction);
        result[v] = 6.2831853f / 64.0f * sum +
                    std::max(glm::dot(sky.to_sun(), vertices[v].normal), 0.0f) * sky.sun_irradiance() +
                    from_below(vertices[v].normal, sky, blocked);
      },
      64);
  return result;
}

}  // namespace parvis::light
