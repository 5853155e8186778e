// Packets of rays in double precision: Embree finds candidates among triangles that are grown by more than
// its error, along rays that begin earlier and end later by more than that. Candidates that are hit well
// within their edges, from a side that is beyond doubt and at a distance that no other is near, are decided
// in single precision; all others in double precision, here.
#include "graphics/reference/ray_query.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "graphics/reference/traced_hit.h"

namespace parvis::reference {
namespace {

/// Data that a query passes to the filters below.
struct QueryContext {
  RTCIntersectContext embree;
  const Places& places;
  std::span<Passage> passages;  ///< of each ray; empty: rays see as the renderer draws
  std::span<const FineRay> fine_rays = {};
  std::span<FineHit> fine_hits = {};  ///< the nearest so far
  std::uint32_t rough_hits = 0;  ///< a bit for each of them whose distance and weights are single precision
  float margin_m = 0.0f;
  bool passes_recorded = false;  ///< rays pass through what photographs show

  QueryContext(const Places& all, std::span<Passage> of_rays) : places(all), passages(of_rays) {
    rtcInitIntersectContext(&embree);
  }
};

/// A triangle along a ray.
struct Candidate {
  const PlacedPart& place;
  std::uint32_t triangle;
  float u, v;
  bool is_back;
  glm::vec3 direction;  ///< of the ray, in the frame of the triangle
};

glm::vec3 direction_in_world(const Candidate& candidate) {
  return candidate.place.is_joined ? candidate.direction
                                   : glm::mat3(candidate.place.world_from_mesh) * candidate.direction;
}

float alpha_of(const Candidate& candidate, bool is_shadow) {
  const PlacedPart& place = candidate.place;
  if (place.surface) {
    const glm::vec3 along = glm::normalize(direction_in_world(candidate));
    return place.surface->alpha(
        traced_hit(place, candidate.triangle, {candidate.u, candidate.v}, is_shadow ? along : -along, 0.0f));
  }
  const scene::Material& material = *place.material;
  float alpha = material.alpha;
  if (const std::vector<glm::vec4>& colours = place.mesh->colours; !colours.empty()) {
    const std::uint32_t* corner = place.mesh->indices.data() + 3 * std::size_t(candidate.triangle);
    alpha *= (1.0f - candidate.u - candidate.v) * colours[corner[0]].w + candidate.u * colours[corner[1]].w +
             candidate.v * colours[corner[2]].w;
  }
  if (material.base_colour_texture == scene::no_index) return alpha;
  const glm::vec2 uv = texture_coordinates(place, candidate.triangle, candidate.u, candidate.v);
  return alpha * (*place.textures)[std::size_t(material.base_colour_texture)].sample(uv, 1.0f).w;
}

bool stops_light(const Candidate& candidate, Passage& passage, bool is_shadow) {
  const scene::Material& material = *candidate.place.material;
  if (candidate.place.is_backdrop && (is_shadow || passage.passes_backdrops)) return false;
  if (!passage.sees_backs && !material.is_double_sided && candidate.is_back) return false;
  if (material.alpha_mode == scene::Alpha::opaque) return true;
  if (material.alpha_mode == scene::Alpha::cutout)
    return alpha_of(candidate, is_shadow) >= material.alpha_cutoff;
  return !candidate.place.is_painted_shadow && passage.random.uniform() < alpha_of(candidate, is_shadow);
}

/// A ray to the sun hits from behind what the sun sees from the front; panes and solid glass cast no
/// shadow.
bool stops_as_drawn(const Candidate& candidate, bool is_shadow) {
  const scene::Material& material = *candidate.place.material;
  const bool lets_through = material.alpha_mode == scene::Alpha::blend || material.refracts();
  if (is_shadow && (!candidate.place.casts_shadow || lets_through)) return false;
  if (!material.is_double_sided && candidate.is_back != is_shadow) return false;
  return material.alpha_mode != scene::Alpha::cutout ||
         alpha_of(candidate, is_shadow) >= material.alpha_cutoff;
}

/// Corners of a triangle in the world, as the float transform places them.
std::array<glm::dvec3, 3> fine_corners(const PlacedPart& place, std::uint32_t triangle) {
  const glm::dmat4 world_from_mesh(place.world_from_mesh);
  const std::uint32_t* const index = place.mesh->indices.data() + 3 * std::size_t(triangle);
  std::array<glm::dvec3, 3> corners;
  for (std::size_t k = 0; k < 3; ++k)
    corners[k] = glm::dvec3(world_from_mesh * glm::dvec4(place.mesh->positions[index[k]], 1.0));
  return corners;
}

/// Gives the nearest hit of a ray so far its distance and weights in double precision; `corners` are its
/// triangle's.
void refine_hit(QueryContext& context, unsigned ray, const std::array<glm::dvec3, 3>& corners) {
  FineHit& hit = context.fine_hits[ray];
  if (const auto found = crossing(context.fine_rays[ray], corners))
    hit.distance_m = found->distance_m, hit.u = float(found->u), hit.v = float(found->v);
  context.rough_hits &= ~(1u << ray);
}

/// The same of all rays. Those of a packet often hit the same triangle.
void refine_hits(QueryContext& context) {
  const PlacedPart* place = nullptr;
  std::uint32_t triangle = 0;
  std::array<glm::dvec3, 3> corners;
  for (unsigned ray = 0; ray < context.fine_rays.size(); ++ray) {
    if ((context.rough_hits >> ray & 1u) == 0) continue;
    const FineHit& hit = context.fine_hits[ray];
    if (hit.place != place || hit.triangle != triangle) {
      place = hit.place, triangle = hit.triangle;
      corners = fine_corners(*place, triangle);
    }
    refine_hit(context, ray, corners);
  }
}

/// Where Embree's form of a fine ray begins.
double begin_of(const FineRay& ray, float margin_m) {
  return std::max(ray.min_m - double(margin_m), -4.0 * double(margin_m));
}

/// Verdict of single precision on a candidate along a fine ray.
enum class Verdict : unsigned char { passes, stops, unsure };

/// `certain_share` is that of ray_scene.cpp: beyond it all weights lie within the triangle itself. Light
/// that grazes a triangle is left to double precision.
template <bool is_shadow>
Verdict rough_verdict(QueryContext& context, const Candidate& candidate, glm::vec3 ng, float certain_share,
                      unsigned ray, double distance_m) {
  constexpr float min_cosine_squared = 0.01f;
  const float cosine = glm::dot(ng, candidate.direction);
  const bool knows_side = cosine * cosine > min_cosine_squared * glm::dot(ng, ng) *
                                                glm::dot(candidate.direction, candidate.direction);
  if (!knows_side || candidate.place.material->alpha_mode == scene::Alpha::cutout) return Verdict::unsure;
  if (!stops_as_drawn(candidate, is_shadow)) return Verdict::passes;
  const FineRay& fine = context.fine_rays[ray];
  const double margin_m = double(context.margin_m);
  const bool is_within =
      std::min({candidate.u, candidate.v, 1.0f - candidate.u - candidate.v}) > certain_share &&
      distance_m > fine.min_m + margin_m && distance_m < fine.max_m - margin_m;
  if (!is_within) return Verdict::unsure;
  if (is_shadow || !context.fine_hits[ray].place) return Verdict::stops;
  const double behind_m = distance_m - context.fine_hits[ray].distance_m;
  if (std::abs(behind_m) < 4.0 * margin_m) return Verdict::unsure;
  return behind_m < 0.0 ? Verdict::stops : Verdict::passes;
}

/// The same in double precision, which replaces the candidate's weights and `distance_m`.
template <bool is_shadow>
bool fine_verdict(QueryContext& context, Candidate& candidate, unsigned ray, double& distance_m) {
  if (!is_shadow && (context.rough_hits >> ray & 1u) != 0)
    refine_hit(context, ray, fine_corners(*context.fine_hits[ray].place, context.fine_hits[ray].triangle));
  const FineRay& fine = context.fine_rays[ray];
  const auto found = crossing(fine, fine_corners(candidate.place, candidate.triangle));
  const double max_m =
      is_shadow || !context.fine_hits[ray].place ? fine.max_m : context.fine_hits[ray].distance_m;
  if (!found || found->distance_m <= fine.min_m || found->distance_m >= max_m) return false;
  distance_m = found->distance_m, candidate.u = float(found->u), candidate.v = float(found->v);
  candidate.is_back = found->is_back != candidate.place.is_mirrored;
  return stops_as_drawn(candidate, is_shadow);
}

/// Does a candidate stop a fine ray? It is then the nearest hit so far.
template <bool is_shadow>
bool stops_fine(QueryContext& context, const RTCFilterFunctionNArguments* arguments, unsigned lane,
                Candidate& candidate, glm::vec3 ng) {
  const unsigned n = arguments->N, ray = RTCRayN_id(arguments->ray, n, lane);
  float& embree_distance_m = RTCRayN_tfar(arguments->ray, n, lane);
  double distance_m = begin_of(context.fine_rays[ray], context.margin_m) + double(embree_distance_m);
  const float certain_share =
      static_cast<const float*>(arguments->geometryUserPtr)[3 * std::size_t(candidate.triangle)];
  const Verdict verdict = rough_verdict<is_shadow>(context, candidate, ng, certain_share, ray, distance_m);
  if (verdict == Verdict::passes) return false;
  if (verdict == Verdict::unsure && !fine_verdict<is_shadow>(context, candidate, ray, distance_m))
    return false;
  if (is_shadow) return true;
  context.fine_hits[ray] = {&candidate.place, candidate.triangle, distance_m, candidate.u, candidate.v};
  if (verdict == Verdict::stops) context.rough_hits |= 1u << ray;
  embree_distance_m += context.margin_m * 2.0f;  // candidates a little behind may yet prove to be nearer
  return true;
}

/// Asks about the `lane`-th of the rays that a call is about.
template <bool is_shadow, bool is_of_context>
bool stops(QueryContext& context, const RTCFilterFunctionNArguments* arguments, unsigned lane) {
  const unsigned n = arguments->N, ray = RTCRayN_id(arguments->ray, n, lane);
  const PlacedPart& place = *context.places[place_of(RTCHitN_instID(arguments->hit, n, lane, 0),
                                                     RTCHitN_geomID(arguments->hit, n, lane))];
  if (context.passes_recorded && place.is_recorded) return false;
  if (is_of_context && place.is_filtered) return true;  // its own filter has been asked
  const glm::vec3 ng(RTCHitN_Ng_x(arguments->hit, n, lane), RTCHitN_Ng_y(arguments->hit, n, lane),
                     RTCHitN_Ng_z(arguments->hit, n, lane));
  const glm::vec3 direction(RTCRayN_dir_x(arguments->ray, n, lane), RTCRayN_dir_y(arguments->ray, n, lane),
                            RTCRayN_dir_z(arguments->ray, n, lane));
  Candidate candidate{place,
                      RTCHitN_primID(arguments->hit, n, lane),
                      RTCHitN_u(arguments->hit, n, lane),
                      RTCHitN_v(arguments->hit, n, lane),
                      glm::dot(ng, direction) > 0.0f,  // mirroring exchanges nothing in the mesh's frame
                      direction};
  if (!context.fine_rays.empty()) return stops_fine<is_shadow>(context, arguments, lane, candidate, ng);
  return context.passages.empty() ? stops_as_drawn(candidate, is_shadow)
                                  : stops_light(candidate, context.passages[ray], is_shadow);
}

template <bool is_shadow, bool is_of_context>
void filter(const RTCFilterFunctionNArguments* arguments) {
  QueryContext& context = *reinterpret_cast<QueryContext*>(arguments->context);
  for (unsigned lane = 0; lane < arguments->N; ++lane)
    if (arguments->valid[lane] != 0 && !stops<is_shadow, is_of_context>(context, arguments, lane))
      arguments->valid[lane] = 0;
}

/// Rays without passages see as the renderer draws: no backs of single-sided parts.
bool asks_about_backs(std::span<const Passage> passages) {
  return passages.empty() || std::ranges::any_of(passages, [](const Passage& p) { return !p.sees_backs; });
}

RTCRay embree_ray(const Ray& ray) {
  return {ray.origin.x,
          ray.origin.y,
          ray.origin.z,
          ray.min_m,
          ray.direction.x,
          ray.direction.y,
          ray.direction.z,
          0.0f,
          ray.max_m,
          ~0u,  // hits every instance
          0,
          0};
}

/// Embree asserts that rays are finite. One that is not hits nothing: a surface so degenerate that it has no
/// normal must not end the program.
bool is_finite(const Ray& ray) {
  constexpr float embree_limit = 1.8e18f;
  const auto fits = [](glm::vec3 v) {
    return std::abs(v.x) < embree_limit && std::abs(v.y) < embree_limit && std::abs(v.z) < embree_limit;
  };
  return fits(ray.origin) && fits(ray.direction) && ray.min_m <= ray.max_m;
}

/// Begins and ends where single precision cannot miss what lies on the ray.
Ray embree_ray_around(const FineRay& ray, float margin_m) {
  const double before = begin_of(ray, margin_m);
  return {glm::vec3(ray.origin + before * ray.direction), glm::vec3(ray.direction), 0.0f,
          float(std::min(ray.max_m - before + double(margin_m), 1e30))};
}

/// Embree's packets of a width.
template <std::size_t width>
struct Embree;

template <>
struct Embree<8> {
  using Rays = RTCRayHit8;
  static constexpr auto intersect = rtcIntersect8;
  static constexpr auto occlude = rtcOccluded8;
};

template <>
struct Embree<16> {
  using Rays = RTCRayHit16;
  static constexpr auto intersect = rtcIntersect16;
  static constexpr auto occlude = rtcOccluded16;
};

/// The rays `first`, `first` + 1 and so on up to `count` in Embree's form; those that are missing or not
/// finite are left out. `valid` says so, and a ray that ends before it begins: without instructions for
/// packets of this width Embree does not read `valid`.
template <std::size_t width>
struct Packet {
  alignas(64) int valid[width];
  alignas(64) typename Embree<width>::Rays rays;

  template <class MakeRay>
  Packet(std::size_t first, std::size_t count, const MakeRay& make_ray) {
    constexpr Ray left_out{glm::vec3(0.0f), glm::vec3(0.0f, 0.0f, 1.0f), 1.0f, 0.0f};
    for (std::size_t i = 0; i < width; ++i) {
      Ray ray = first + i < count ? make_ray(first + i) : left_out;
      valid[i] = first + i < count && is_finite(ray) ? -1 : 0;
      if (!valid[i]) ray = left_out;
      auto& r = rays.ray;
      r.org_x[i] = ray.origin.x, r.org_y[i] = ray.origin.y, r.org_z[i] = ray.origin.z;
      r.dir_x[i] = ray.direction.x, r.dir_y[i] = ray.direction.y, r.dir_z[i] = ray.direction.z;
      r.tnear[i] = ray.min_m, r.tfar[i] = ray.max_m, r.time[i] = 0.0f;
      r.mask[i] = ~0u, r.id[i] = unsigned(first + i), r.flags[i] = 0;
      rays.hit.geomID[i] = rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
  }

  void intersect(RTCScene scene, RTCIntersectContext& context) {
    Embree<width>::intersect(valid, scene, &context, &rays);
  }

  /// Which are blocked: bits of their numbers.
  std::uint32_t occlude(RTCScene scene, RTCIntersectContext& context) {
    Embree<width>::occlude(valid, scene, &context, &rays.ray);
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < width; ++i)
      bits |= std::uint32_t(valid[i] != 0 && rays.ray.tfar[i] < 0.0f) << rays.ray.id[i];
    return bits;
  }
};

/// Has `answer` answer rays in packets for which the processor has instructions: of wider ones Embree takes
/// ray by ray.
template <class MakeRay, class Answer>
void each_packet(std::size_t count, bool is_wide, const MakeRay& make_ray, const Answer& answer) {
  assert(count <= RayScene::packet_size);
  if (is_wide) {
    Packet<16> packet(0, count, make_ray);
    return answer(packet);
  }
  for (std::size_t first = 0; first < count; first += 8) {
    Packet<8> packet(first, count, make_ray);
    answer(packet);
  }
}

}  // namespace

void filter_seen(const RTCFilterFunctionNArguments* arguments) { filter<false, false>(arguments); }
void filter_shadow(const RTCFilterFunctionNArguments* arguments) { filter<true, false>(arguments); }

glm::vec2 texture_coordinates(const PlacedPart& place, std::uint32_t triangle, float u, float v) {
  const Mesh& mesh = *place.mesh;
  const std::uint32_t* corner = mesh.indices.data() + 3 * std::size_t(triangle);
  const glm::vec2 uv =
      (1.0f - u - v) * mesh.uvs[corner[0]] + u * mesh.uvs[corner[1]] + v * mesh.uvs[corner[2]];
  return glm::vec2(place.material->texture_from_mesh_uv * glm::vec3(uv, 1.0f));
}

glm::vec3 facet_normal(const PlacedPart& place, std::uint32_t triangle) {
  const std::uint32_t* const corner = place.mesh->indices.data() + 3 * std::size_t(triangle);
  const glm::mat3 turn(place.world_from_mesh);
  const glm::vec3 a = place.mesh->positions[corner[0]], ab = turn * (place.mesh->positions[corner[1]] - a),
                  ac = turn * (place.mesh->positions[corner[2]] - a);
  return place.is_mirrored ? glm::cross(ac, ab) : glm::cross(ab, ac);
}

void RayScene::nearest_hits(std::span<const FineRay> rays, std::span<FineHit> hits) const {
  assert(margin_m_ > 0.0f && hits.size() >= rays.size());
  std::fill(hits.begin(), hits.end(), FineHit{});
  QueryContext context(places_, {});
  context.fine_rays = rays, context.fine_hits = hits, context.margin_m = margin_m_;
  context.embree.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  each_packet(
      rays.size(), has_wide_packets_, [&](std::size_t i) { return embree_ray_around(rays[i], margin_m_); },
      [&](auto& packet) { packet.intersect(top_, context.embree); });
  refine_hits(context);
}

std::uint32_t RayScene::are_blocked(std::span<const FineRay> rays) const {
  assert(margin_m_ > 0.0f);
  QueryContext context(places_, {});
  context.fine_rays = rays, context.margin_m = margin_m_;
  std::uint32_t blocked = 0;
  each_packet(
      rays.size(), has_wide_packets_, [&](std::size_t i) { return embree_ray_around(rays[i], margin_m_); },
      [&](auto& packet) { blocked |= packet.occlude(top_, context.embree); });
  return blocked;
}

std::uint32_t RayScene::are_blocked(std::span<const Ray> rays, std::span<Passage> passages) const {
  assert(margin_m_ == 0.0f && (passages.empty() || passages.size() >= rays.size()));
  QueryContext context(places_, passages);
  if (asks_about_backs(passages)) context.embree.filter = filter<true, true>;
  std::uint32_t blocked = 0;
  each_packet(
      rays.size(), has_wide_packets_, [&](std::size_t i) { return rays[i]; },
      [&](auto& packet) { blocked |= packet.occlude(top_, context.embree); });
  return blocked;
}

void RayScene::nearest_hits(std::span<const Ray> rays, std::span<Passage> passages,
                            std::span<std::optional<Hit>> hits) const {
  assert(margin_m_ == 0.0f && (passages.empty() || passages.size() >= rays.size()) &&
         hits.size() >= rays.size());
  QueryContext context(places_, passages);
  if (asks_about_backs(passages)) context.embree.filter = filter<false, true>;
  const auto answer = [&](auto& packet) {
    packet.intersect(top_, context.embree);
    for (std::size_t i = 0; i < std::size(packet.valid); ++i) {
      const std::size_t ray = packet.rays.ray.id[i];
      if (ray >= rays.size()) continue;
      const auto& hit = packet.rays.hit;
      if (!packet.valid[i] || hit.geomID[i] == RTC_INVALID_GEOMETRY_ID)
        hits[ray].reset();
      else
        hits[ray] = Hit{places_[place_of(hit.instID[0][i], hit.geomID[i])].get(), hit.primID[i], hit.u[i],
                        hit.v[i], packet.rays.ray.tfar[i]};
    }
  };
  each_packet(
      rays.size(), has_wide_packets_, [&](std::size_t i) { return rays[i]; }, answer);
}

std::optional<Hit> RayScene::nearest_hit(const Ray& ray, Passage* passage) const {
  assert(margin_m_ == 0.0f);
  if (!is_finite(ray)) return std::nullopt;
  QueryContext context(places_, {passage, passage ? 1u : 0u});
  if (!passage || !passage->sees_backs) context.embree.filter = filter<false, true>;
  RTCRayHit query{};
  query.ray = embree_ray(ray);
  query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(top_, &context.embree, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  const std::size_t place = place_of(query.hit.instID[0], query.hit.geomID);
  return Hit{places_[place].get(), query.hit.primID, query.hit.u, query.hit.v, query.ray.tfar};
}

bool RayScene::is_blocked(const Ray& ray, Passage* passage, bool passes_recorded) const {
  assert(margin_m_ == 0.0f);
  if (!is_finite(ray)) return false;
  QueryContext context(places_, {passage, passage ? 1u : 0u});
  context.passes_recorded = passes_recorded;
  if (!passage || !passage->sees_backs || passes_recorded) context.embree.filter = filter<true, true>;
  RTCRay query = embree_ray(ray);
  rtcOccluded1(top_, &context.embree, &query);
  return query.tfar < 0.0f;
}

std::optional<Hit> RayScene::nearest_hit(const Ray& ray) const { return nearest_hit(ray, nullptr); }
std::optional<Hit> RayScene::nearest_hit(const Ray& ray, Passage& passage) const {
  return nearest_hit(ray, &passage);
}
bool RayScene::is_blocked(const Ray& ray) const { return is_blocked(ray, nullptr); }
bool RayScene::is_blocked_by_inserted(const Ray& ray) const { return is_blocked(ray, nullptr, true); }
bool RayScene::is_blocked(const Ray& ray, Passage& passage) const { return is_blocked(ray, &passage); }
bool RayScene::is_blocked_by_inserted(const Ray& ray, Passage& passage) const {
  return is_blocked(ray, &passage, true);
}

}  // namespace parvis::reference
