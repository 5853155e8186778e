// Candidates for the sun are judged by rays from points of the captured surfaces. What a photograph shows
// dark may be dark paint: single points prove nothing, the correlation over all of them does.
#include "capture/facades/photographed_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "base/colour.h"
#include "base/parallel.h"
#include "capture/facades/photographed_sky.h"
#include "capture/facades/surface_points.h"
#include "capture/photographs/shadow_strength.h"
#include "graphics/reference/ray_scene.h"
#include "graphics/shading/sky.h"
#include "scene/data/scene.h"

namespace parvis::facades {
namespace {

constexpr std::size_t coarse_directions = 2000, sun_candidates = 4;
constexpr std::size_t coarse_points = 3000, fine_points = 24000, min_points_of_surface = 500;
constexpr std::array cap_radii_deg{4.0, 2.0, 1.0, 0.5};  // of the rounds about a candidate
constexpr std::size_t directions_per_cap = 25;
constexpr double candidates_apart_deg = 8.0;
constexpr float lowest_sun = 0.035f;     // sine: 2 degrees
constexpr float grazing_cosine = 0.02f;  // the relief's own roughness shades what the sun grazes
constexpr double plateau = 0.003;        // of the correlation: directions that are as good as the best
constexpr float lift = 1.5e-3f;          // of ray origins, of the place's radius

/// A point that is lit or shaded.
struct LitPoint {
  glm::vec3 position, normal;
  glm::vec3 radiance;
  float lit;            ///< 0 in shadow, 1 in the sun
  std::size_t surface;  ///< number of its run
};

/// Unit directions evenly over a cap about `axis` (Fibonacci lattice).
std::vector<glm::vec3> cap_of_directions(glm::vec3 axis, double radius_deg, std::size_t count) {
  const glm::dvec3 z(axis), side = std::abs(z.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
  const glm::dvec3 x = glm::normalize(glm::cross(side, z)), y = glm::cross(z, x);
  const double golden = 2.39996322972865332, height = 1.0 - std::cos(glm::radians(radius_deg));
  std::vector<glm::vec3> directions;
  for (std::size_t i = 0; i < count; ++i) {
    const double along = 1.0 - height * (double(i) + 0.5) / double(count);
    const double across = std::sqrt(std::max(1.0 - along * along, 0.0)), turn = golden * double(i);
    directions.emplace_back(across * std::cos(turn) * x + across * std::sin(turn) * y + along * z);
  }
  return directions;
}

/// The surfaces without the backdrop, as what casts shadows.
scene::Scene casters_of(const PackedFacade& facade, const std::vector<TriangleRun>& runs) {
  Mesh mesh;
  for (const TriangleRun& run : runs)
    for (std::size_t i = 3 * run.first; i < 3 * run.second; ++i) {
      mesh.indices.push_back(std::uint32_t(mesh.positions.size()));
      mesh.positions.push_back(facade.corners[i]);
    }
  mesh.uvs.assign(mesh.positions.size(), glm::vec2(0.0f));
  fill_normals(mesh);
  scene::Material material;
  material.is_double_sided = true;
  const auto model = std::make_shared<scene::Model>();
  model->materials.push_back(material);
  model->parts.push_back({.object = "place", .mesh = std::move(mesh)});
  scene::Scene casters;
  casters.objects.emplace_back().model = model;
  return casters;
}

/// The points of a surface that photographs show partly lit and partly shaded; none of others. All radiances
/// that photographs show of it are added to `seen`.
std::vector<LitPoint> lit_points(const PackedFacade& facade, FacadeLookup& lookup, const TriangleRun& run,
                                 std::size_t number, std::size_t count, glm::vec3 eye,
                                 std::vector<LitPoint>& seen) {
  SurfacePoints points(facade, run);
  std::vector<glm::vec3> radiances;
  for (std::size_t i = 0; i < count; ++i) {
    const SurfacePoints::Point point = points.next();
    const glm::vec3 away = eye - point.position;
    const float distance = std::max(glm::length(away), 1e-6f);
    const glm::uvec2 list = facade.lists[point.triangle];
    const bool is_seen =
        std::ranges::any_of(std::span(facade.candidates).subspan(list.x, list.y), [&](std::uint32_t layer) {
          return lookup.key(layer, point.position, away / distance, 1e-3f * distance) < 100.0f;
        });
    if (!is_seen) continue;  // a proposal proves nothing
    const std::optional<glm::vec3> radiance = recorded_radiance(lookup, point, eye);
    if (!radiance) continue;
    const glm::vec3* c = facade.corners.data() + 3 * point.triangle;
    glm::vec3 normal = glm::cross(c[1] - c[0], c[2] - c[0]);
    if (!(glm::length(normal) > 0.0f)) continue;
    normal = glm::normalize(glm::dot(normal, away) < 0.0f ? -normal : normal);
    seen.push_back({point.position, normal, *radiance, 1.0f, number});
    radiances.push_back(*radiance);
  }
  const std::optional<photographs::LitAndShaded> classes = photographs::lit_and_shaded(radiances);
  if (!classes) return {};
  std::vector<LitPoint> judged(seen.end() - std::ptrdiff_t(radiances.size()), seen.end());
  const float shade = classes->kept * classes->lit;
  for (LitPoint& point : judged)
    point.lit = std::clamp((luminance(point.radiance) - shade) / (classes->lit - shade), 0.0f, 1.0f);
  return judged;
}

/// Correlation of two variables.
struct Correlation {
  double count = 0.0, a = 0.0, b = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;

  void add(double x, double y) { count += 1.0, a += x, b += y, aa += x * x, bb += y * y, ab += x * y; }
  double value() const {
    const double spread = (count * aa - a * a) * (count * bb - b * b);
    return spread > 1e-9 ? (count * ab - a * b) / std::sqrt(spread) : 0.0;
  }
};

/// Rays from points to candidates for the sun.
class SunJudge {
 public:
  SunJudge(const PackedFacade& facade, const std::vector<TriangleRun>& runs, std::vector<LitPoint> points)
      : casters_(casters_of(facade, runs)), rays_(casters_), points_(std::move(points)) {
    const Bounds bounds = casters_.objects[0].model->parts[0].mesh.bounds();
    lift_ = lift * bounds.radius();
  }
  std::span<const LitPoint> points() const { return points_; }

  bool is_lit(const LitPoint& point, glm::vec3 to_sun) const {
    return glm::dot(point.normal, to_sun) > grazing_cosine &&
           !rays_.is_blocked({point.position + lift_ * point.normal, to_sun});
  }
  /// How what is lit from there is correlated with what the photographs show lit; of so many points at least.
  double agreement(glm::vec3 to_sun, std::size_t count) const {
    Correlation correlation;
    const std::size_t step = std::max<std::size_t>(points_.size() / std::max<std::size_t>(count, 1), 1);
    for (std::size_t i = 0; i < points_.size(); i += step)
      correlation.add(is_lit(points_[i], to_sun) ? 1.0 : 0.0, double(points_[i].lit));
    return correlation.value();
  }
  /// The same with points that are lit or not: the phi coefficient.
  double phi(glm::vec3 to_sun) const {
    Correlation correlation;
    for (const LitPoint& point : points_)
      correlation.add(is_lit(point, to_sun) ? 1.0 : 0.0, point.lit > 0.5f ? 1.0 : 0.0);
    return correlation.value();
  }

 private:
  scene::Scene casters_;
  reference::RayScene rays_;
  std::vector<LitPoint> points_;
  float lift_ = 0.0f;
};

struct SunCandidate {
  glm::vec3 to_sun{0, 0, 1};
  double agreement = -1.0;
};

/// Agreements of directions above the horizon, best first.
std::vector<SunCandidate> judged_directions(const SunJudge& judge, const std::vector<glm::vec3>& directions,
                                            std::size_t points) {
  std::vector<SunCandidate> found(directions.size());
  parallel_for(directions.size(), [&](std::size_t i) {
    found[i].to_sun = directions[i];
    if (directions[i].z > lowest_sun) found[i].agreement = judge.agreement(directions[i], points);
  });
  std::ranges::stable_sort(found, std::ranges::greater{}, &SunCandidate::agreement);
  return found;
}

/// The best direction in ever smaller caps about a candidate: the middle of those that are as good as the
/// best, for with so many points there is no single one.
SunCandidate refined(const SunJudge& judge, SunCandidate candidate) {
  for (const double radius_deg : cap_radii_deg) {
    std::vector<glm::vec3> directions = cap_of_directions(candidate.to_sun, radius_deg, directions_per_cap);
    directions.push_back(candidate.to_sun);
    const std::vector<SunCandidate> found = judged_directions(judge, directions, fine_points);
    glm::vec3 sum(0.0f);
    for (const SunCandidate& one : found)
      if (one.agreement >= found[0].agreement - plateau) sum += one.to_sun;
    candidate = {glm::normalize(sum), found[0].agreement};
  }
  return candidate;
}

SunCandidate best_sun(const SunJudge& judge) {
  const std::vector<SunCandidate> coarse =
      judged_directions(judge, cap_of_directions({0, 0, 1}, 90.0, coarse_directions), coarse_points);
  std::vector<SunCandidate> chosen;
  const auto apart = float(std::cos(glm::radians(candidates_apart_deg)));
  for (const SunCandidate& candidate : coarse) {
    const bool is_near = std::ranges::any_of(
        chosen, [&](const SunCandidate& other) { return glm::dot(candidate.to_sun, other.to_sun) > apart; });
    if (!is_near) chosen.push_back(candidate);
    if (chosen.size() == sun_candidates) break;
  }
  SunCandidate best;
  for (const SunCandidate& candidate : chosen)
    if (const SunCandidate found = refined(judge, candidate); found.agreement > best.agreement) best = found;
  return best;
}

/// Irradiance of the sun on a plane that faces it: on each surface the sun adds to the light of the sky what
/// lit points are brighter than shaded ones of the same paint.
glm::vec3 irradiance_of_sun(const SunJudge& judge, glm::vec3 to_sun, const ImageF& sky) {
  struct Sides {
    glm::dvec3 lit{0.0}, shaded{0.0}, normal{0.0};
    double lit_count = 0.0, shaded_count = 0.0, cosines = 0.0;
  };
  std::vector<Sides> surfaces;
  for (const LitPoint& point : judge.points()) {
    surfaces.resize(std::max(surfaces.size(), point.surface + 1));
    Sides& sides = surfaces[point.surface];
    const bool is_lit = judge.is_lit(point, to_sun);
    if (is_lit && point.lit > 0.8f) {
      sides.lit += glm::dvec3(point.radiance), sides.lit_count += 1.0;
      sides.cosines += double(glm::dot(point.normal, to_sun)), sides.normal += glm::dvec3(point.normal);
    } else if (!is_lit && point.lit < 0.2f) {
      sides.shaded += glm::dvec3(point.radiance), sides.shaded_count += 1.0;
    }
  }
  shading::SkyLight light = shading::make_sky_light(sky, 1.0f, 0.0f);
  glm::dvec3 sum(0.0);
  double weights = 0.0;
  for (const Sides& sides : surfaces) {
    if (!(sides.lit_count > 0.0 && sides.shaded_count > 0.0)) continue;
    const glm::dvec3 ratio =
        (sides.lit / sides.lit_count) / glm::max(sides.shaded / sides.shaded_count, 1e-6);
    const glm::dvec3 of_sky(
        shading::sky_irradiance(light.irradiance_sh.data(), glm::vec3(glm::normalize(sides.normal))));
    const double weight = std::min(sides.lit_count, sides.shaded_count);
    sum += weight * of_sky * glm::max(ratio - 1.0, 0.0) / (sides.cosines / sides.lit_count);
    weights += weight;
  }
  return weights > 0.0 ? glm::vec3(sum / weights) : glm::vec3(0.0f);
}

}  // namespace

Result<PhotographedLight> find_photographed_light(const PackedFacade& facade) {
  const std::vector<TriangleRun> runs = runs_of_surfaces(facade);
  if (facade.photos.empty() || runs.empty())
    return error(
        "the place has {} photographs and {} surfaces beside its backdrop: expected both; run parvis facade "
        "pack",
        facade.photos.size(), runs.size());
  double area = 0.0;
  for (const TriangleRun& run : runs) area += SurfacePoints(facade, run).area();
  const glm::vec3 middle = middle_of_photographs(facade);
  const FacadeTexels texels(facade);
  std::vector<std::vector<LitPoint>> judged_of(runs.size()), seen_of(runs.size());
  parallel_for(runs.size(), [&](std::size_t i) {
    FacadeLookup lookup(facade, &texels);
    const double part = area > 0.0 ? SurfacePoints(facade, runs[i]).area() / area : 0.0;
    const std::size_t count = std::max(min_points_of_surface, std::size_t(part * double(fine_points)));
    judged_of[i] = lit_points(facade, lookup, runs[i], i, count, middle, seen_of[i]);
  });
  std::vector<LitPoint> judged;
  std::vector<WallSample> walls;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    judged.insert(judged.end(), judged_of[i].begin(), judged_of[i].end());
    // A surface with both shows what the sky alone gives where it is shaded.
    for (const LitPoint& point : judged_of[i].empty() ? seen_of[i] : judged_of[i])
      if (judged_of[i].empty() || point.lit < 0.2f) walls.push_back({point.normal, point.radiance});
  }
  PhotographedLight light;
  light.sky = photographed_sky(facade, texels, middle, walls);
  light.points = judged.size();
  if (judged.empty()) return light;
  const SunJudge judge(facade, runs, std::move(judged));
  light.to_sun = best_sun(judge).to_sun;
  light.agreement = judge.phi(light.to_sun);
  light.is_overcast = light.agreement < sunlit_agreement;
  if (!light.is_overcast) light.sun_irradiance = irradiance_of_sun(judge, light.to_sun, light.sky);
  return light;
}

}  // namespace parvis::facades
