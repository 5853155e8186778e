#include "bench/virtual_objects/judged_body.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "base/random.h"
#include "base/test_directions.h"
#include "bench/report.h"
#include "reflections/reflection_search/test_exact_reflection.h"

namespace parvis::bench {
namespace {

using namespace reflection_search;
using namespace reflector_maps;

constexpr int map_side = 512;
constexpr std::size_t max_maps = 200;
constexpr std::array reaches{1.1f, 1.5f, 2.5f, 4.0f};
constexpr float flattest = 0.1f;  // cosine of the steepest sight: beyond it a pixel spans most of the body
constexpr double degrees = 57.29577951308232;

/// Draws triangles by their area.
class AreaDraw {
 public:
  AreaDraw(const ReflectorMesh& mesh, const std::vector<ReflectorPatch>& patches) {
    for (std::size_t p = 0; p < patches.size(); ++p)
      for (const std::uint32_t t : patches[p].triangles) {
        const auto [a, b, c] = mesh.corners(t);
        sums_.push_back((sums_.empty() ? 0.0 : sums_.back()) + double(glm::length(glm::cross(b - a, c - a))));
        triangles_.emplace_back(p, t);
      }
  }
  std::pair<std::size_t, std::uint32_t> draw(Random& random) const {
    const auto at = std::upper_bound(sums_.begin(), sums_.end(), double(random.uniform()) * sums_.back());
    return triangles_[std::min(std::size_t(at - sums_.begin()), triangles_.size() - 1)];
  }

 private:
  std::vector<double> sums_;
  std::vector<std::pair<std::size_t, std::uint32_t>> triangles_;  ///< patch, triangle
};

/// A chance point of a triangle, with its interpolated normal.
MetSurface chance_point(const ReflectorMesh& mesh, std::uint32_t triangle, Random& random) {
  const auto p = mesh.corners(triangle);
  const auto n = mesh.normals(triangle);
  float u = random.uniform(), v = random.uniform();
  if (u + v > 1.0f) u = 1.0f - u, v = 1.0f - v;
  return {p[0] + u * (p[1] - p[0]) + v * (p[2] - p[0]),
          glm::normalize(n[0] + u * (n[1] - n[0]) + v * (n[2] - n[0]))};
}

/// Where a ray from `from` leaves the ball; `from` lies in it.
glm::vec3 leaves_ball(glm::vec3 from, glm::vec3 direction, glm::vec3 centre, float radius) {
  const glm::vec3 off = from - centre;
  const float along = glm::dot(off, direction);
  return from + (std::sqrt(std::max(along * along - glm::dot(off, off) + radius * radius, 0.0f)) - along) *
                    direction;
}

}  // namespace

Result<JudgedBody> JudgedBody::make(std::string name, const Mesh& mesh, std::size_t count) {
  Result<Reflector> made = make_reflector(mesh, name, map_side, max_maps);
  if (!made) return made.errors();
  const ReflectorMesh& ordered = made->mesh;
  const std::vector<ReflectorPatch>& patches = made->patches;
  JudgedBody body;
  body.name_ = std::move(name);
  body.triangles_ = ordered.neighbours.size();
  body.patches_ = patches.size();
  body.maps_ = std::move(made->maps);
  for (std::size_t i = 0; i < body.maps_.size(); ++i) {
    body.own_rays_.push_back(std::make_unique<SurfaceRays>(ordered, patches[i].triangles));
    body.rays_around_.push_back(std::make_unique<SurfaceRays>(ordered, patches[i].around));
  }

  std::vector<std::uint32_t> all(body.triangles_);
  std::iota(all.begin(), all.end(), 0u);
  const SurfaceRays whole(ordered, all);
  const AreaDraw area(ordered, patches);
  const glm::vec3 centre = ordered.mesh.bounds().centre();
  float radius = 0.0f;
  for (const glm::vec3& p : ordered.mesh.positions) radius = std::max(radius, glm::distance(p, centre));
  Random random(1);
  for (std::size_t tried = 0; body.reflections_.size() < count && tried < 100 * count; ++tried) {
    const auto [patch, triangle] = area.draw(random);
    const MetSurface at = chance_point(ordered, triangle, random);
    const glm::vec3 to_viewer = random_direction(random);
    if (glm::dot(to_viewer, at.normal) < flattest) continue;
    const glm::vec3 to_vertex = glm::reflect(-to_viewer, at.normal),
                    above = at.position + 1e-4f * radius * at.normal;
    if (whole.along(above, to_viewer) || whole.along(above, to_vertex)) continue;
    const float reach = reaches[body.reflections_.size() % reaches.size()];
    body.reflections_.push_back(
        {patch, leaves_ball(at.position, to_viewer, centre, random.uniform(1.5f, 6.0f) * radius),
         leaves_ball(at.position, to_vertex, centre, reach * radius), reach});
  }
  // As a reflector is drawn: patch by patch.
  std::sort(body.reflections_.begin(), body.reflections_.end(),
            [](const KnownReflection& a, const KnownReflection& b) { return a.patch < b.patch; });
  return body;
}

SearchFigures JudgedBody::judge(const Search& search) const {
  std::vector<MapSearch::PatchPoint> points(reflections_.size());
  SearchFigures figures;
  figures.microseconds = 1e3 / double(reflections_.size()) * milliseconds([&] {
                           for (std::size_t i = 0; i < reflections_.size(); ++i) {
                             const KnownReflection& known = reflections_[i];
                             if (known.patch >= maps_.size()) continue;
                             const ReflectorMap& map = maps_[known.patch];
                             MapSearch on_map{map};
                             points[i] = search(on_map, {known.viewer, known.vertex, map.window.centre});
                           }
                         });
  for (std::size_t i = 0; i < reflections_.size(); ++i) {
    const KnownReflection& known = reflections_[i];
    if (known.patch >= maps_.size()) {  // no map: told
      figures.angles_deg.push_back(std::nullopt);
      figures.is_told.push_back(true);
      continue;
    }
    MapSearch on_map{maps_[known.patch]};
    const glm::vec3 centre = maps_[known.patch].window.centre, direction = points[i].point.direction;
    std::optional<MetSurface> met = own_rays_[known.patch]->along(centre, direction);
    if (!met) met = rays_around_[known.patch]->along(centre, direction);
    figures.angles_deg.push_back(
        met ? std::optional(degrees * bisector_angle(met->position, met->normal, known.viewer, known.vertex))
            : std::nullopt);
    figures.is_told.push_back(!on_map.is_found(points[i]));
  }
  return figures;
}

std::string JudgedBody::description() const {
  return fmt::format("{}: {} triangles, {} patches, {} maps of {} x {}, {} reflections", name_, triangles_,
                     patches_, maps_.size(), map_side, map_side, reflections_.size());
}

}  // namespace parvis::bench
