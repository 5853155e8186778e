#include "reflections/reflector_maps/reflector_patches.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "reflections/reflector_maps/surface_rays.h"

namespace parvis::reflector_maps {
namespace {

constexpr int smoothing_rounds = 10;      // over neighbouring triangles: noise of scanned meshes is no patch
constexpr float flat_curvature = 0.1f;    // per size of the mesh: smaller curvatures count as convex
constexpr float saddle_curvature = 0.1f;  // product of the principal curvatures per size squared, negative
constexpr double saddle_share = 0.2;      // of a patch's area, from which on it may show a vertex twice
constexpr double small_patch = 0.01;      // of the surface
constexpr int absorbing_rounds = 7;       // each of patches twice as large
constexpr float min_slope = 0.15f;        // cosine at which a centre must see each triangle of its patch
constexpr int centre_rounds = 200;
constexpr float same_layer = 1e-3f;  // of the distance: what lies before that much hides what is behind
constexpr double overlap = 0.3;      // of a patch's area: how far its map goes on over its neighbours

/// Data of each triangle that every step needs.
struct Facets {
  std::vector<glm::vec3> middle, normal;
  std::vector<float> area;
  std::vector<char> is_saddle;
  double surface = 0.0;
  float size = 0.0f;
};

Facets facets_of(const ReflectorMesh& mesh) {
  Facets facets;
  for (std::size_t t = 0; t < mesh.neighbours.size(); ++t) {
    const auto [a, b, c] = mesh.corners(t);
    const glm::vec3 twice = glm::cross(b - a, c - a);
    facets.middle.push_back((a + b + c) / 3.0f);
    facets.area.push_back(0.5f * glm::length(twice));
    facets.normal.push_back(glm::normalize(twice));
    facets.surface += double(facets.area.back());
  }
  facets.size = 0.5f * glm::length(mesh.mesh.bounds().size());
  return facets;
}

/// Sum of the principal curvatures, positive where the surface curves away from its normal: the divergence of
/// the normal.
float curvature(const ReflectorMesh& mesh, std::size_t t) {
  const auto p = mesh.corners(t);
  const auto n = mesh.normals(t);
  const glm::vec3 twice = glm::cross(p[1] - p[0], p[2] - p[0]);
  float divergence = 0.0f;
  for (std::size_t k = 0; k < 3; ++k)
    divergence += glm::dot(n[k], glm::cross(twice, p[(k + 2) % 3] - p[(k + 1) % 3])) / glm::dot(twice, twice);
  return divergence;
}

/// Product of the principal curvatures: how much of the ball of normals a triangle's normals cover, for its
/// area.
float gaussian_curvature(const ReflectorMesh& mesh, std::size_t t) {
  const auto p = mesh.corners(t);
  const auto n = mesh.normals(t);
  const glm::vec3 twice = glm::cross(p[1] - p[0], p[2] - p[0]);
  return glm::dot(twice, glm::cross(n[1] - n[0], n[2] - n[0])) / glm::dot(twice, twice);
}

/// Means over what surrounds each triangle.
void smooth(const ReflectorMesh& mesh, const Facets& facets, std::vector<float>& values) {
  std::vector<float> next;
  for (int round = 0; round < smoothing_rounds; ++round) {
    next = values;
    for (std::size_t t = 0; t < values.size(); ++t) {
      float sum = facets.area[t] * values[t], area = facets.area[t];
      for (const std::uint32_t other : mesh.neighbours[t])
        if (other != no_triangle) sum += facets.area[other] * values[other], area += facets.area[other];
      next[t] = sum / area;
    }
    values.swap(next);
  }
}

std::vector<char> convex_triangles(const ReflectorMesh& mesh, const Facets& facets) {
  std::vector<float> curvatures(mesh.neighbours.size());
  for (std::size_t t = 0; t < curvatures.size(); ++t) curvatures[t] = facets.size * curvature(mesh, t);
  smooth(mesh, facets, curvatures);
  std::vector<char> is_convex(curvatures.size());
  for (std::size_t t = 0; t < curvatures.size(); ++t) is_convex[t] = curvatures[t] > -flat_curvature;
  return is_convex;
}

std::vector<char> saddle_triangles(const ReflectorMesh& mesh, const Facets& facets) {
  std::vector<float> curvatures(mesh.neighbours.size());
  for (std::size_t t = 0; t < curvatures.size(); ++t)
    curvatures[t] = facets.size * facets.size * gaussian_curvature(mesh, t);
  smooth(mesh, facets, curvatures);
  std::vector<char> is_saddle(curvatures.size());
  for (std::size_t t = 0; t < curvatures.size(); ++t) is_saddle[t] = curvatures[t] < -saddle_curvature;
  return is_saddle;
}

/// Sets of neighbouring triangles that are alike.
template <class Alike>
std::vector<std::vector<std::uint32_t>> connected(const ReflectorMesh& mesh,
                                                  const std::vector<std::uint32_t>& among, Alike alike) {
  std::vector<char> is_free(mesh.neighbours.size());
  for (const std::uint32_t t : among) is_free[t] = 1;
  std::vector<std::vector<std::uint32_t>> sets;
  for (const std::uint32_t first : among) {
    if (!is_free[first]) continue;
    std::vector<std::uint32_t>& set = sets.emplace_back(1, first);
    is_free[first] = 0;
    for (std::size_t i = 0; i < set.size(); ++i)
      for (const std::uint32_t other : mesh.neighbours[set[i]])
        if (other != no_triangle && is_free[other] && alike(set[i], other)) {
          is_free[other] = 0;
          set.push_back(other);
        }
  }
  return sets;
}

double area_of(const Facets& facets, const std::vector<std::uint32_t>& triangles) {
  double sum = 0.0;
  for (const std::uint32_t t : triangles) sum += double(facets.area[t]);
  return sum;
}

/// Small sets take the sign of what surrounds them, the smallest first; of two that touch, one.
void absorb_small(const ReflectorMesh& mesh, const Facets& facets, const std::vector<std::uint32_t>& all,
                  std::vector<char>& is_convex) {
  for (int round = 0; round < absorbing_rounds; ++round) {
    const double limit = std::ldexp(small_patch, round + 1 - absorbing_rounds);
    const std::vector<char> before = is_convex;
    const auto alike = [&](std::uint32_t a, std::uint32_t b) { return before[a] == before[b]; };
    for (const std::vector<std::uint32_t>& set : connected(mesh, all, alike)) {
      if (area_of(facets, set) > limit * facets.surface) continue;
      bool has_surroundings = false, may_turn = true;
      for (const std::uint32_t t : set)
        for (const std::uint32_t other : mesh.neighbours[t]) {
          if (other == no_triangle || before[other] == before[t]) continue;
          has_surroundings = true;
          may_turn &= is_convex[other] == before[other];
        }
      if (!has_surroundings || !may_turn) continue;
      for (const std::uint32_t t : set) is_convex[t] = !is_convex[t];
    }
  }
}

/// A place from which all triangles show the same side, not too flat: the middle of what they enclose, moved
/// off from those that are worst until all are well.
std::optional<glm::vec3> centre_of(const Facets& facets, const std::vector<std::uint32_t>& triangles,
                                   bool is_convex) {
  const float side = is_convex ? 1.0f : -1.0f;
  glm::vec3 middle(0.0f), facing(0.0f);
  float area = 0.0f, reach = 0.0f;
  for (const std::uint32_t t : triangles) {
    middle += facets.area[t] * facets.middle[t];
    facing += facets.area[t] * facets.normal[t];
    area += facets.area[t];
  }
  middle /= area;
  for (const std::uint32_t t : triangles)
    reach = std::max(reach, glm::distance(facets.middle[t], middle) + std::sqrt(facets.area[t]));
  glm::vec3 centre = middle - side * reach * facing / area;
  float step = 0.2f * reach;
  for (int round = 0; round < centre_rounds; ++round, step *= 0.98f) {
    glm::vec3 push(0.0f);
    float worst = 1.0f;
    for (const std::uint32_t t : triangles) {
      const glm::vec3 from_centre = facets.middle[t] - centre;
      const float slope =
          side * glm::dot(facets.normal[t], from_centre) / std::max(glm::length(from_centre), 1e-12f);
      if (slope < 2.0f * min_slope)
        push -= side * facets.area[t] * (2.0f * min_slope - slope) * facets.normal[t];
      if (slope < worst) worst = slope;
    }
    if (worst > min_slope) return centre;
    if (glm::length(push) < 1e-12f * area) return std::nullopt;
    centre += step * glm::normalize(push);
  }
  return std::nullopt;
}

/// Two sets by where normals point: each triangle goes to the nearer of two directions (Lloyd 1982).
std::vector<std::uint8_t> halves(const Facets& facets, const std::vector<std::uint32_t>& triangles) {
  const glm::vec3 first = facets.normal[triangles.front()];
  const std::uint32_t farthest =
      *std::min_element(triangles.begin(), triangles.end(), [&](std::uint32_t a, std::uint32_t b) {
        return glm::dot(facets.normal[a], first) < glm::dot(facets.normal[b], first);
      });
  glm::vec3 means[2]{facets.normal[farthest], first};
  std::vector<std::uint8_t> half(facets.area.size());
  for (int round = 0; round < 10; ++round) {
    glm::vec3 sums[2]{glm::vec3(0.0f), glm::vec3(0.0f)};
    for (const std::uint32_t t : triangles) {
      half[t] = glm::dot(facets.normal[t], means[1] - means[0]) > 0.0f;
      sums[std::size_t(half[t])] += facets.area[t] * facets.normal[t];
    }
    for (std::size_t k = 0; k < 2; ++k)
      if (glm::length(sums[k]) > 0.0f) means[k] = glm::normalize(sums[k]);
  }
  return half;
}

/// A patch's triangles that others of it hide from its centre.
std::vector<std::uint32_t> hidden_triangles(const ReflectorMesh& mesh, const Facets& facets,
                                            const std::vector<std::uint32_t>& triangles, glm::vec3 centre) {
  const SurfaceRays rays(mesh, triangles);
  std::vector<std::uint32_t> hidden;
  for (const std::uint32_t t : triangles) {
    const glm::vec3 from_centre = facets.middle[t] - centre;
    const std::optional<MetSurface> met = rays.along(centre, from_centre);
    if (met && glm::distance(met->position, centre) < (1.0f - same_layer) * glm::length(from_centre))
      hidden.push_back(t);
  }
  return hidden.size() < triangles.size() ? hidden : std::vector<std::uint32_t>();
}

/// Rings of what surrounds a patch, as far as its centre sees them well beside it: where patches meet, each
/// map goes on.
std::vector<std::uint32_t> surroundings(const ReflectorMesh& mesh, const Facets& facets,
                                        const ReflectorPatch& patch) {
  const SurfaceRays rays(mesh, patch.triangles);
  std::vector<char> is_seen(mesh.neighbours.size());
  for (const std::uint32_t t : patch.triangles) is_seen[t] = 1;
  std::vector<std::uint32_t> around, rim = patch.triangles;
  const double maximum = overlap * area_of(facets, patch.triangles);
  for (double area = 0.0; !rim.empty() && area < maximum;) {
    std::vector<std::uint32_t> next;
    for (const std::uint32_t t : rim)
      for (const std::uint32_t other : mesh.neighbours[t]) {
        if (other == no_triangle || is_seen[other]) continue;
        is_seen[other] = 1;
        const glm::vec3 from_centre = facets.middle[other] - patch.centre;
        const float slope =
            (patch.is_convex ? 1.0f : -1.0f) * glm::dot(facets.normal[other], glm::normalize(from_centre));
        if (slope < min_slope || rays.along(patch.centre, from_centre)) continue;
        next.push_back(other);
        area += double(facets.area[other]);
      }
    around.insert(around.end(), next.begin(), next.end());
    rim.swap(next);
  }
  return around;
}

/// One patch, or as many as it takes until each has a centre that sees it whole.
void add_patches(const ReflectorMesh& mesh, const Facets& facets, const std::vector<std::uint32_t>& triangles,
                 bool is_convex, std::vector<ReflectorPatch>& patches) {
  const auto add_parts = [&](const std::vector<std::vector<std::uint32_t>>& parts) {
    for (const std::vector<std::uint32_t>& part : parts) add_patches(mesh, facets, part, is_convex, patches);
  };
  if (const std::optional<glm::vec3> centre = centre_of(facets, triangles, is_convex)) {
    const std::vector<std::uint32_t> hidden = hidden_triangles(mesh, facets, triangles, *centre);
    std::vector<char> is_hidden(mesh.neighbours.size());
    for (const std::uint32_t t : hidden) is_hidden[t] = 1;
    ReflectorPatch patch{{}, {}, is_convex, true, *centre};
    std::vector<std::uint32_t> saddles;
    for (const std::uint32_t t : triangles) {
      if (is_hidden[t]) continue;
      patch.triangles.push_back(t);
      if (facets.is_saddle[t]) saddles.push_back(t);
    }
    patch.shows_once =
        is_convex && area_of(facets, saddles) < saddle_share * area_of(facets, patch.triangles);
    patch.around = surroundings(mesh, facets, patch);
    patches.push_back(std::move(patch));
    add_parts(connected(mesh, hidden, [](std::uint32_t, std::uint32_t) { return true; }));
    return;
  }
  const std::vector<std::uint8_t> half = halves(facets, triangles);
  std::vector<std::vector<std::uint32_t>> parts =
      connected(mesh, triangles, [&](std::uint32_t a, std::uint32_t b) { return half[a] == half[b]; });
  if (parts.size() == 1)  // all normals alike, yet folded over: triangle by triangle
    parts = connected(mesh, triangles, [](std::uint32_t, std::uint32_t) { return false; });
  add_parts(parts);
}

}  // namespace

std::vector<ReflectorPatch> reflector_patches(const ReflectorMesh& mesh) {
  Facets facets = facets_of(mesh);
  facets.is_saddle = saddle_triangles(mesh, facets);
  std::vector<char> is_convex = convex_triangles(mesh, facets);
  std::vector<std::uint32_t> all(mesh.neighbours.size());
  for (std::uint32_t t = 0; t < all.size(); ++t) all[t] = t;
  absorb_small(mesh, facets, all, is_convex);
  std::vector<ReflectorPatch> patches;
  for (const auto& set :
       connected(mesh, all, [&](std::uint32_t a, std::uint32_t b) { return is_convex[a] == is_convex[b]; }))
    add_patches(mesh, facets, set, is_convex[set.front()] != 0, patches);
  std::sort(patches.begin(), patches.end(), [&](const ReflectorPatch& a, const ReflectorPatch& b) {
    return area_of(facets, a.triangles) > area_of(facets, b.triangles);
  });
  return patches;
}

}  // namespace parvis::reflector_maps
