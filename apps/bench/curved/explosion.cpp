// The search on a reflector map beside explosion maps (Ofek and Rappoport 1998).
#include <algorithm>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>

#include "base/random.h"
#include "base/test_directions.h"
#include "bench/parts.h"
#include "reflections/reflection_search/reflection_search.h"
#include "reflections/reflection_search/test_ellipsoid.h"
#include "reflections/reflection_search/test_exact_reflection.h"
#include "reflections/reflector_maps/reflector_map.h"
#include "scene/data/test_scene.h"

namespace parvis::bench {
namespace {

using namespace reflection_search;
using namespace reflector_maps;
using MapSearch = ReflectionSearch<ReflectorMap>;

constexpr glm::vec3 radii{1.0f, 0.6f, 0.8f};
constexpr int rings = 64, map_side = 512, explosion_side = 512;
constexpr std::size_t viewers = 20, quick_viewers = 6, vertices = 10000;  // of one viewer, as of a whale
constexpr int paper_iterations = 9;
constexpr float search_ends = 2e-9f;  // error, 0.005 degrees
constexpr float flattest = 0.1f;      // cosine: beyond it a pixel spans most of the body
constexpr double degrees = 57.29577951308232;

/// The explosion map of one viewer: the directions, from the middle, in which mirrored rays of the
/// tessellated reflector's vertices leave a sphere about it. Its triangles are drawn into a disc of
/// directions, whose middle is the viewer's; a pixel knows its triangle and where in it.
class ExplosionMap {
 public:
  ExplosionMap(const Mesh& mesh, glm::vec3 viewer, float sphere) : mesh_(mesh), axes_(axes_to(viewer)) {
    std::vector<glm::vec2> exploded(mesh.positions.size());
    std::vector<char> is_seen(mesh.positions.size());
    for (std::size_t v = 0; v < exploded.size(); ++v) {
      const glm::vec3 to_viewer = glm::normalize(viewer - mesh.positions[v]);
      is_seen[v] = glm::dot(to_viewer, mesh.normals[v]) > 0.0f;
      const glm::vec3 reflected = glm::reflect(-to_viewer, mesh.normals[v]), from = mesh.positions[v];
      const float along = glm::dot(from, reflected);
      const float length = std::sqrt(along * along - glm::dot(from, from) + sphere * sphere) - along;
      exploded[v] = pixel_of(from + length * reflected);
    }
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
      const std::uint32_t* corner = &mesh.indices[3 * std::size_t(t)];
      if (is_seen[corner[0]] && is_seen[corner[1]] && is_seen[corner[2]])
        draw(t, exploded[corner[0]], exploded[corner[1]], exploded[corner[2]]);
    }
  }

  /// Where the triangle found there shows a vertex, out of its corners. None: the map knows no triangle.
  std::optional<glm::vec3> place(glm::vec3 vertex) const {
    const glm::ivec2 at = glm::clamp(glm::ivec2(pixel_of(vertex)), 0, explosion_side - 1);
    const Pixel& pixel = pixels_[std::size_t(at.y) * explosion_side + std::size_t(at.x)];
    if (pixel.triangle == none) return {};
    const std::uint32_t* corner = &mesh_.indices[3 * std::size_t(pixel.triangle)];
    return pixel.shares.x * mesh_.positions[corner[0]] + pixel.shares.y * mesh_.positions[corner[1]] +
           pixel.shares.z * mesh_.positions[corner[2]];
  }

 private:
  static constexpr std::uint32_t none = 0xffffffff;
  struct Pixel {
    std::uint32_t triangle = none;
    glm::vec3 shares{0.0f};  ///< of its corners
  };

  static glm::mat3 axes_to(glm::vec3 viewer) {
    const glm::vec3 z = glm::normalize(viewer);
    const glm::vec3 x =
        glm::normalize(glm::cross(std::abs(z.z) < 0.9f ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0), z));
    return glm::transpose(glm::mat3(x, glm::cross(z, x), z));
  }
  glm::vec2 pixel_of(glm::vec3 from_middle) const {
    const glm::vec3 d = axes_ * glm::normalize(from_middle);
    const float off = std::acos(glm::clamp(d.z, -1.0f, 1.0f)) / 3.14159265f,
                across = glm::length(glm::vec2(d));
    const glm::vec2 on_disc = across > 1e-9f ? glm::vec2(d) * (off / across) : glm::vec2(0.0f);
    return 0.5f * float(explosion_side) * (1.0f + on_disc);
  }
  void draw(std::uint32_t triangle, glm::vec2 a, glm::vec2 b, glm::vec2 c) {
    const auto area = [](glm::vec2 p, glm::vec2 q, glm::vec2 r) {
      return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
    };
    const float whole = area(a, b, c);
    if (whole == 0.0f) return;
    const glm::ivec2 first = glm::clamp(glm::ivec2(glm::min(a, glm::min(b, c))), 0, explosion_side - 1),
                     last = glm::clamp(glm::ivec2(glm::max(a, glm::max(b, c))), 0, explosion_side - 1);
    for (int y = first.y; y <= last.y; ++y)
      for (int x = first.x; x <= last.x; ++x) {
        const glm::vec2 p(float(x) + 0.5f, float(y) + 0.5f);
        const glm::vec3 shares = glm::vec3(area(p, b, c), area(a, p, c), area(a, b, p)) / whole;
        if (shares.x >= 0.0f && shares.y >= 0.0f && shares.z >= 0.0f)
          pixels_[std::size_t(y) * explosion_side + std::size_t(x)] = {triangle, shares};
      }
  }

  const Mesh& mesh_;
  glm::mat3 axes_;
  std::vector<Pixel> pixels_ = std::vector<Pixel>(std::size_t(explosion_side) * explosion_side);
};

/// Vertices at 1.1 to 4 radii that the ellipsoid shows to the viewer.
std::vector<glm::vec3> shown_vertices(glm::vec3 viewer, Random& random) {
  const Ellipsoid ellipsoid{radii};
  std::vector<glm::vec3> shown;
  while (shown.size() < vertices) {
    const auto [at, normal] = ellipsoid.surface(random_direction(random));
    const glm::vec3 to_viewer = glm::normalize(viewer - at);
    if (glm::dot(to_viewer, normal) < flattest) continue;
    const glm::vec3 reflected = glm::reflect(-to_viewer, normal);
    const float reach = random.uniform(1.1f, 4.0f), along = glm::dot(at, reflected);
    shown.push_back(at + (std::sqrt(along * along - glm::dot(at, at) + reach * reach) - along) * reflected);
  }
  return shown;
}

struct Figures {
  std::vector<double> angles_deg;
  double ms = 0.0;
  void tell(const char* name, Report& report) const {
    report.note(fmt::format("{}: angle median and 99 % {:.4f} {:.2f} deg, {:.2f} us a vertex", name,
                            percentile(angles_deg, 0.5), percentile(angles_deg, 0.99),
                            1e3 * ms / double(angles_deg.size())));
  }
};

}  // namespace

void measure_explosion_maps(const BenchSetup& setup, Report& report) {
  Mesh mesh;
  append(mesh, scene::sphere(glm::vec3(0.0f), 1.0f, rings), glm::scale(glm::mat4(1.0f), radii));
  Mesh fine;
  append(fine, scene::sphere(glm::vec3(0.0f), 1.0f, 4 * rings), glm::scale(glm::mat4(1.0f), radii));
  const Reflector reflector = must(make_reflector(fine, "ellipsoid", map_side));
  MapSearch search{reflector.maps.front()};
  const Ellipsoid truth{radii};
  Figures far_map, two_maps, newton, midpoint;
  Random random(7);
  for (std::size_t i = 0; i < (setup.is_quick ? quick_viewers : viewers); ++i) {
    const glm::vec3 viewer = random.uniform(2.0f, 6.0f) * random_direction(random);
    const std::vector<glm::vec3> shown = shown_vertices(viewer, random);
    /// Judges a method that finds the direction of each vertex's reflection point from the middle; 0: none.
    const auto judge = [&](Figures& figures, const std::function<void(std::vector<glm::vec3>&)>& find) {
      std::vector<glm::vec3> found(shown.size());
      figures.ms += milliseconds([&] { find(found); });
      for (std::size_t v = 0; v < shown.size(); ++v) {
        const bool is_found = glm::length(found[v]) > 0.0f;
        const auto [at, normal] = truth.surface(is_found ? found[v] : glm::vec3(0, 0, 1));
        figures.angles_deg.push_back(is_found ? degrees * bisector_angle(at, normal, viewer, shown[v])
                                              : 180.0);
      }
    };
    const auto searched = [&](std::vector<glm::vec3>& found, auto&& point) {
      for (std::size_t v = 0; v < shown.size(); ++v)
        found[v] =
            point(MapSearch::ReflectionTask{viewer, shown[v], search.reflector.window.centre}).direction;
    };
    judge(newton, [&](auto& found) {
      searched(found,
               [&](const auto& task) { return search.search_patch(task, search.patch_kind(), -1).point; });
    });
    judge(midpoint, [&](auto& found) {
      searched(found, [&](const auto& task) {
        return search.search_by_midpoint(task, search.first_direction(task), paper_iterations, search_ends);
      });
    });
    judge(far_map, [&](auto& found) {
      const ExplosionMap map(mesh, viewer, 4.0f);
      for (std::size_t v = 0; v < shown.size(); ++v)
        if (const auto place = map.place(shown[v])) found[v] = *place;
    });
    // For near and for far, mixed by the inverse of the vertex's distance.
    judge(two_maps, [&](auto& found) {
      const ExplosionMap near(mesh, viewer, 1.1f), far(mesh, viewer, 4.0f);
      for (std::size_t v = 0; v < shown.size(); ++v) {
        const auto a = near.place(shown[v]), b = far.place(shown[v]);
        const float share = (1.0f / glm::length(shown[v]) - 0.25f) / (1.0f / 1.1f - 0.25f);
        if (a && b)
          found[v] = glm::mix(*b, *a, share);
        else if (a || b)
          found[v] = a ? *a : *b;
      }
    });
  }
  far_map.tell("an explosion map, far", report);
  two_maps.tell("explosion maps, near and far", report);
  midpoint.tell("9 midpoint iterations on the reflector map", report);
  newton.tell("the search on the reflector map", report);
  report.add("newton_over_explosion_map_p99_angle",
             percentile(newton.angles_deg, 0.99) / percentile(two_maps.angles_deg, 0.99));
  report.add("newton_over_explosion_map_time", newton.ms / two_maps.ms);
}

}  // namespace parvis::bench
