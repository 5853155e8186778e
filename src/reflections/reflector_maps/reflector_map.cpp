#include "reflections/reflector_maps/reflector_map.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "base/parallel.h"
#include "reflections/reflection_search/reflection_search.h"
#include "reflections/reflector_maps/surface_rays.h"

namespace parvis::reflector_maps {
namespace {

/// Gives the shared functions the texels that a shader has in its sampler.
struct Sampler {
  const ImageF& texels;

  vec4 reflector_texel(ivec2 at) const {
    const float* t = texels.at(at.x, at.y);
    return {t[0], t[1], t[2], t[3]};
  }

#include "reflections/reflector_maps/reflector_map.glsl"
};

constexpr float window_margin = 1.1f;   // about the patch
constexpr float widest_window = 0.9f;   // beyond it, all directions
constexpr float min_breadth = 1e-3f;    // radians, of a band
constexpr float band_share = 0.25f;     // of a square window's solid angle, from which on a band is better
constexpr double max_sides = 2.0;       // of the usual, of the largest maps
constexpr double usual_share = 0.020;   // of a reflector's surface, that a map of the usual side holds
constexpr double creased_share = 0.01;  // of a map: it is rebuilt, twice as wide
constexpr float crease_angle = 0.010f;  // radians, 0.6 degrees: what texels may be off between them
constexpr float crease_depth = 0.005f;  // of the distance

double area_of(const ReflectorMesh& mesh, std::size_t triangle) {
  const auto [a, b, c] = mesh.corners(triangle);
  return 0.5 * double(glm::length(glm::cross(b - a, c - a)));
}

glm::vec3 texel_direction(const MapWindow& window, glm::vec2 texel) {
  return window_direction(window, (texel + 0.5f) / window.side);
}

/// Calls `visit(direction)` for every corner of a patch, seen from its centre along the window's axes.
template <class Visit>
void for_each_corner(const ReflectorMesh& mesh, const ReflectorPatch& patch, const glm::mat3& axes,
                     Visit&& visit) {
  for (const std::uint32_t t : patch.triangles)
    for (const glm::vec3& corner : mesh.corners(t))
      visit(glm::transpose(axes) * glm::normalize(corner - patch.centre));
}

/// Extent of an octahedral layer about the third axis that holds all corners of a patch.
float square_extent(const ReflectorMesh& mesh, const ReflectorPatch& patch, const glm::mat3& axes) {
  float reach = 0.0f;
  for_each_corner(mesh, patch, axes, [&](glm::vec3 direction) {
    const glm::vec2 uv = octahedral_uv(direction);
    reach = std::max({reach, std::abs(2.0f * uv.x - 1.0f), std::abs(2.0f * uv.y - 1.0f)});
  });
  return window_margin * reach < widest_window ? window_margin * reach : 1.0f;
}

/// The band all around the third axis that holds all corners of a patch.
glm::vec3 band_around(const ReflectorMesh& mesh, const ReflectorPatch& patch, const glm::mat3& axes) {
  float minimum = glm::pi<float>(), maximum = 0.0f;
  for_each_corner(mesh, patch, axes, [&](glm::vec3 direction) {
    const float off_axis = std::atan2(glm::length(glm::vec2(direction)), direction.z);
    minimum = std::min(minimum, off_axis), maximum = std::max(maximum, off_axis);
  });
  const float margin = 0.5f * (window_margin - 1.0f) * (maximum - minimum);
  minimum = std::max(minimum - margin, 0.0f), maximum = std::min(maximum + margin, glm::pi<float>());
  return {glm::pi<float>(), minimum, maximum - minimum};
}

/// A window that holds all corners of a patch, seen from its centre: the one of the smaller solid angle.
MapWindow window_of(const ReflectorMesh& mesh, const ReflectorPatch& patch, int side) {
  glm::vec3 middle(0.0f);
  for (const std::uint32_t t : patch.triangles) {
    const auto [a, b, c] = mesh.corners(t);
    middle += glm::length(glm::cross(b - a, c - a)) * glm::normalize(a + b + c - 3.0f * patch.centre);
  }
  MapWindow window = all_directions;
  window.centre = patch.centre, window.side = float(side), window.reach = 0.0f;
  for (const std::vector<std::uint32_t>* triangles : {&patch.triangles, &patch.around})
    for (const std::uint32_t t : *triangles)
      for (const glm::vec3& corner : mesh.corners(t))
        window.reach = std::max(window.reach, 1.001f * glm::distance(corner, patch.centre));
  if (!(glm::length(middle) > 0.0f)) return window;
  const glm::vec3 z = glm::normalize(middle);
  const glm::vec3 x =
      glm::normalize(glm::cross(std::abs(z.x) < 0.8f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0), z));
  window.axes = {x, glm::cross(z, x), z};
  const float extent = square_extent(mesh, patch, window.axes);
  const glm::vec3 band = band_around(mesh, patch, window.axes);
  const float of_square = 4.0f * glm::pi<float>() * extent * extent,
              of_band = 2.0f * glm::pi<float>() * (std::cos(band.y) - std::cos(band.y + band.z));
  if (band.z > min_breadth && of_band < band_share * of_square)
    window.extent = 0.0f, window.band = band;
  else
    window.extent = extent;
  return window;
}

/// The patch's own surface, and beside it that of its neighbours.
struct PatchRays {
  SurfaceRays own, around;

  PatchRays(const ReflectorMesh& mesh, const ReflectorPatch& patch)
      : own(mesh, patch.triangles), around(mesh, patch.around) {}
  std::optional<MetSurface> along(glm::vec3 centre, glm::vec3 direction) const {
    const std::optional<MetSurface> met = own.along(centre, direction);
    return met ? met : around.along(centre, direction);
  }
};

/// Normals and distances of the surface along each texel's direction, 0 where there is none.
ImageF cast(const PatchRays& rays, const MapWindow& window) {
  const int side = int(window.side);
  ImageF texels(side, side, 4);
  parallel_for(std::size_t(side), [&](std::size_t row) {
    for (int x = 0; x < side; ++x) {
      const std::optional<MetSurface> met = rays.along(window.centre, texel_direction(window, {x, row}));
      if (!met) continue;
      float* t = texels.at(x, int(row));
      for (int k = 0; k < 3; ++k) t[k] = met->normal[k];
      t[3] = glm::distance(met->position, window.centre);
    }
  });
  return texels;
}

std::size_t texel_index(const MapWindow& window, glm::vec3 direction) {
  const int side = int(window.side);
  const glm::ivec2 at = glm::clamp(glm::ivec2(glm::floor(window_uv(window, direction) * window.side)),
                                   glm::ivec2(0), glm::ivec2(side - 1));
  return std::size_t(at.y) * std::size_t(side) + std::size_t(at.x);
}

/// Calls `visit(index, texel)` for every texel.
template <class Visit>
void for_each_texel(const MapWindow& window, Visit&& visit) {
  std::size_t index = 0;
  for (int y = 0; y < int(window.side); ++y)
    for (int x = 0; x < int(window.side); ++x) visit(index++, glm::vec2(x, y));
}

/// Distances for the directions without a surface, smoothly on from those that have one: a coarser map first,
/// each of its texels the mean of what it covers; what it says is then smoothed (Gortler 1996, pull and
/// push).
std::vector<float> closed_distances(const std::vector<float>& known, const MapWindow& window) {
  std::vector<float> filled = known;
  if (window.side > 6.0f) {
    MapWindow half = window;
    half.side = std::ceil(0.5f * window.side);
    std::vector<float> sums(std::size_t(half.side * half.side)), counts(sums.size());
    for_each_texel(window, [&](std::size_t i, glm::vec2 texel) {
      if (known[i] == 0.0f) return;
      const std::size_t at = texel_index(half, texel_direction(window, texel));
      sums[at] += known[i], counts[at] += 1.0f;
    });
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] = counts[i] > 0.0f ? sums[i] / counts[i] : 0.0f;
    const std::vector<float> coarse = closed_distances(sums, half);
    for_each_texel(window, [&](std::size_t i, glm::vec2 texel) {
      if (known[i] == 0.0f) filled[i] = coarse[texel_index(half, texel_direction(window, texel))];
    });
  } else {
    float sum = 0.0f, count = 0.0f;
    for (const float d : known) sum += d, count += d > 0.0f ? 1.0f : 0.0f;
    for (float& d : filled) d = d > 0.0f ? d : sum / std::max(count, 1.0f);
  }
  const int rounds = window.side > 64.0f ? 2 : 8;  // of smoothing: coarse levels make the shape
  for (int round = 0; round < rounds; ++round)
    for_each_texel(window, [&](std::size_t i, glm::vec2 texel) {
      if (known[i] > 0.0f) return;
      float sum = 0.0f;
      for (const glm::vec2 off : {glm::vec2(1, 0), glm::vec2(-1, 0), glm::vec2(0, 1), glm::vec2(0, -1)})
        sum += filled[texel_index(window, texel_direction(window, texel + off))];
      filled[i] = 0.25f * sum;
    });
  return filled;
}

/// Gives every direction a surface: what was closed has the normal of its own shape.
void close(ImageF& texels, const MapWindow& window, bool is_convex) {
  std::vector<float> known;
  for (std::size_t i = 3; i < texels.pixels.size(); i += 4) known.push_back(texels.pixels[i]);
  const std::vector<float> filled = closed_distances(known, window);
  const auto position = [&](glm::vec2 texel) {
    const glm::vec3 d = texel_direction(window, texel);
    return d * filled[texel_index(window, d)];
  };
  for_each_texel(window, [&](std::size_t i, glm::vec2 texel) {
    if (known[i] > 0.0f) return;
    const glm::vec2 u(1, 0), v(0, 1);
    const glm::vec3 d = texel_direction(window, texel);
    glm::vec3 normal =
        glm::cross(position(texel + u) - position(texel - u), position(texel + v) - position(texel - v));
    normal = glm::length(normal) > 0.0f ? glm::normalize(normal) : d;
    if ((glm::dot(normal, d) > 0.0f) != is_convex) normal = -normal;
    const glm::vec4 value(normal, filled[i]);
    for (int k = 0; k < 4; ++k) texels.pixels[4 * i + std::size_t(k)] = value[k];
  });
}

/// The kind of surface between four texels: do they agree, in their middle and on both sides of it?
float kind_between(const ReflectorMap& map, const PatchRays& rays, glm::vec2 first) {
  for (const glm::vec2 at : {glm::vec2(0.5f), glm::vec2(0.2f, 0.6f), glm::vec2(0.8f, 0.4f),
                             glm::vec2(0.4f, 0.1f), glm::vec2(0.6f, 0.9f)}) {
    const glm::vec3 between = texel_direction(map.window, first + at);
    const std::optional<MetSurface> met = rays.along(map.window.centre, between);
    if (!met) return kind_closed;
    const auto [position, normal] = map.surface(between);
    const float distance = glm::distance(position, map.window.centre);
    if (glm::distance(met->normal, normal) > crease_angle ||
        glm::distance(met->position, position) > crease_depth * distance)
      return kind_crease;
  }
  return kind_surface;
}

/// Does the window end in the square between a texel and the next? All beyond is looked up there: what it
/// holds is none of it.
bool is_at_an_end(const MapWindow& window, std::size_t x, std::size_t y) {
  const std::size_t last = std::size_t(window.side) - 2;
  const bool ends_across = window.extent > 0.0f && window.extent < 1.0f;  // a band goes all around
  return window.extent < 1.0f && (y == 0 || y == last || (ends_across && (x == 0 || x == last)));
}

/// Turns distances into what the map stores; `is_open` marks texels whose ray hit no surface.
void encode(ReflectorMap& map, const PatchRays& rays, const std::vector<char>& is_open) {
  const int side = map.texels.width;
  for (std::size_t i = 3; i < map.texels.pixels.size(); i += 4)
    map.texels.pixels[i] /= 2.0f * map.window.reach;
  std::vector<float> kinds(is_open.size(), kind_closed);  // the last row and column begin no square of four
  parallel_for(std::size_t(side) - 1, [&](std::size_t row) {
    for (std::size_t x = 0; x + 1 < std::size_t(side); ++x) {
      const std::size_t i = row * std::size_t(side) + x;
      const bool has_all = !is_open[i] && !is_open[i + 1] && !is_open[i + std::size_t(side)] &&
                           !is_open[i + std::size_t(side) + 1];
      if (has_all && !is_at_an_end(map.window, x, row)) kinds[i] = kind_between(map, rays, {x, row});
    }
  });
  for (std::size_t i = 0; i < kinds.size(); ++i) map.texels.pixels[4 * i + 3] += kinds[i];
}

/// Texels for a patch's share of the surface, so that all patches are sampled about as finely: `side` where
/// that is `usual_share`.
int side_of(const ReflectorMesh& mesh, const ReflectorPatch& patch, double surface, int side) {
  double area = 0.0;
  for (const std::uint32_t t : patch.triangles) area += area_of(mesh, t);
  const double fitting = side * std::sqrt(area / (usual_share * surface));
  return int(std::clamp(fitting, 0.25 * side, max_sides * side));
}

bool has_many_creases(const ReflectorMap& map) {
  std::size_t creases = 0;
  for (std::size_t i = 3; i < map.texels.pixels.size(); i += 4)
    creases += std::floor(map.texels.pixels[i]) == kind_crease ? 1 : 0;
  return 4.0 * double(creases) > creased_share * double(map.texels.pixels.size());
}

/// The map of a body in one piece, which most often is round: `side` texels wide if that suffices.
ReflectorMap map_of_body(const ReflectorMesh& mesh, const ReflectorPatch& patch, int side) {
  ReflectorMap map = reflector_map(mesh, patch, side);
  return has_many_creases(map) ? reflector_map(mesh, patch, int(max_sides * side)) : map;
}

std::vector<std::string> remarks_on(const ReflectorMesh& mesh, const std::string& name) {
  std::vector<std::string> remarks;
  if (mesh.dropped_triangles > 0)
    remarks.push_back(
        fmt::format("{}: {} triangles without area are left out", name, mesh.dropped_triangles));
  if (mesh.turned_triangles > 0)
    remarks.push_back(
        fmt::format("{}: {} triangles that ran the other way round than their neighbours are turned", name,
                    mesh.turned_triangles));
  if (mesh.open_edges > 0)
    remarks.push_back(fmt::format(
        "{}: {} edges have not two triangles; holes are closed for the search and reflect nothing", name,
        mesh.open_edges));
  return remarks;
}

}  // namespace

MapPoint ReflectorMap::sample(glm::vec3 direction) const {
  const glm::vec3 unit = glm::normalize(direction);
  const Sampler::MapSample sample = Sampler{texels}.map_sample(window, unit);
  return {window.centre + sample.distance * unit, sample.normal, sample.kind};
}

std::pair<glm::vec3, glm::vec3> ReflectorMap::surface(glm::vec3 direction) const {
  const MapPoint at = sample(direction);
  return {at.position, at.normal};
}

float ReflectorMap::surface_kind(glm::vec3 direction) const { return sample(direction).kind; }

ReflectorMap reflector_map(const ReflectorMesh& mesh, const ReflectorPatch& patch, int side) {
  ReflectorMap map;
  map.window = window_of(mesh, patch, side);
  map.is_convex = patch.is_convex;
  map.shows_once = patch.shows_once;
  const PatchRays rays(mesh, patch);
  map.texels = cast(rays, map.window);
  std::vector<char> is_open;
  for (std::size_t i = 3; i < map.texels.pixels.size(); i += 4)
    is_open.push_back(map.texels.pixels[i] == 0.0f);
  close(map.texels, map.window, map.is_convex);
  encode(map, rays, is_open);
  map.starts = spread_starts(map, mesh, patch);
  return map;
}

Result<Reflector> make_reflector(const Mesh& mesh, const std::string& name, int side,
                                 std::size_t max_patches) {
  Result<ReflectorMesh> ordered = reflector_mesh(mesh, name);
  if (!ordered) return ordered.errors();
  Reflector reflector;
  reflector.mesh = *std::move(ordered);
  reflector.remarks = remarks_on(reflector.mesh, name);
  reflector.patches = reflector_patches(reflector.mesh);
  reflector.maps.resize(std::min(reflector.patches.size(), max_patches));
  double surface = 0.0;
  for (std::size_t t = 0; t < reflector.mesh.neighbours.size(); ++t) surface += area_of(reflector.mesh, t);
  parallel_for(reflector.maps.size(), [&](std::size_t i) {
    const ReflectorPatch& patch = reflector.patches[i];
    reflector.maps[i] =
        reflector.patches.size() == 1
            ? map_of_body(reflector.mesh, patch, side)
            : reflector_map(reflector.mesh, patch, side_of(reflector.mesh, patch, surface, side));
  });
  std::size_t without = 0;
  for (std::size_t i = reflector.maps.size(); i < reflector.patches.size(); ++i)
    without += reflector.patches[i].triangles.size();
  if (without > 0)
    reflector.remarks.push_back(fmt::format(
        "{}: {} of its {} patches have no map, with {} of {} triangles: they show an environment map "
        "alone; a smoother mesh has fewer patches",
        name, reflector.patches.size() - reflector.maps.size(), reflector.patches.size(), without,
        reflector.mesh.neighbours.size()));
  return reflector;
}

}  // namespace parvis::reflector_maps
