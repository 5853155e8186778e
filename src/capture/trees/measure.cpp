#include "capture/trees/measure.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace parvis::trees {
namespace {

constexpr int slices = 40, sectors = 24, directions = 36, density_bands = 10;
constexpr float crown_over_trunk = 2.5f;
constexpr int trunk_slices = slices / 5;
constexpr float pi = 3.14159265f;

/// Points of the tree with how far each reaches beyond itself.
struct Points {
  std::vector<glm::vec3> places;
  float reach_m = 0.0f;
};

/// Area of an outline round the points' centroid: the farthest point of each sector.
float outline_area(const std::vector<glm::vec2>& points, float reach_m) {
  if (points.size() < 3) return 0.0f;
  glm::vec2 middle(0.0f);
  for (const glm::vec2 p : points) middle += p / float(points.size());
  std::array<float, sectors> radius{};
  for (const glm::vec2 p : points) {
    const glm::vec2 d = p - middle;
    const int s = std::min(int((std::atan2(d.y, d.x) + pi) / (2.0f * pi) * sectors), sectors - 1);
    radius[std::size_t(s)] = std::max(radius[std::size_t(s)], glm::length(d) + reach_m);
  }
  float area = 0.0f;
  for (const float r : radius) area += pi / sectors * r * r;
  return area;
}

/// Mean extent over horizontal directions.
float mean_width(const std::vector<glm::vec2>& points, float reach_m) {
  if (points.empty()) return 0.0f;
  float sum = 0.0f;
  for (int i = 0; i < directions; ++i) {
    const glm::vec2 along(std::cos(pi * float(i) / directions), std::sin(pi * float(i) / directions));
    float low = 1e30f, high = -1e30f;
    for (const glm::vec2 p : points)
      low = std::min(low, glm::dot(p, along)), high = std::max(high, glm::dot(p, along));
    sum += high - low + 2.0f * reach_m;
  }
  return sum / directions;
}

/// Points between two heights, from above.
std::vector<glm::vec2> between(const Points& points, float low, float high) {
  std::vector<glm::vec2> result;
  for (const glm::vec3 p : points.places)
    if (p.z >= low && p.z < high) result.emplace_back(p.x, p.y);
  return result;
}

TreeMeasures measured(const Points& points) {
  TreeMeasures result;
  if (points.places.empty()) return result;
  const auto [lowest, highest] = std::ranges::minmax_element(points.places, {}, &glm::vec3::z);
  const float foot = lowest->z - points.reach_m, top = highest->z + points.reach_m,
              step = (top - foot) / slices;
  result.height_m = top - foot;
  const auto width = [&](int slice) {
    return mean_width(between(points, foot + float(slice) * step, foot + float(slice + 1) * step),
                      points.reach_m);
  };
  int base = 1;
  for (int slice = 1; slice < trunk_slices; ++slice)
    if (const float w = width(slice);
        w > 0.0f && (result.trunk_diameter_m == 0.0f || w < result.trunk_diameter_m))
      result.trunk_diameter_m = w, base = slice;
  while (base < slices && width(base) < crown_over_trunk * result.trunk_diameter_m) ++base;
  result.crown_base_m = float(base) * step;
  result.crown_width_m = mean_width(between(points, foot + result.crown_base_m, top + 1.0f), points.reach_m);
  for (int i = base; i < slices; ++i)
    result.crown_volume_m3 +=
        step *
        outline_area(between(points, foot + float(i) * step, foot + float(i + 1) * step), points.reach_m);
  return result;
}

/// Opaque area along axis 0 or 1.
float projected_area(const TreeVolume& volume, int axis) {
  const CellGrid& grid = volume.grid;
  const glm::vec3 size = grid.cell_size_m();
  const int across = 1 - axis, side = grid.side();
  std::vector<float> depth(std::size_t(side) * std::size_t(side), 0.0f);
  for (std::size_t i = 0; i < grid.size(); ++i)
    depth[std::size_t(grid.cells()[i].z) * std::size_t(side) + std::size_t(grid.cells()[i][across])] +=
        volume.extinction_per_m[i] * size[axis];
  float area = 0.0f;
  for (const float d : depth) area += (1.0f - std::exp(-d)) * size[across] * size.z;
  return area;
}

}  // namespace

TreeMeasures measured(const TreeVolume& volume, float min_alpha) {
  const CellGrid& grid = volume.grid;
  const glm::vec3 size = grid.cell_size_m();
  Points points;
  points.reach_m = 0.5f * std::min(size.x, std::min(size.y, size.z));
  for (std::size_t i = 0; i < grid.size(); ++i)
    if (volume.alpha(i) >= min_alpha) points.places.push_back(grid.centre(i));
  TreeMeasures result = measured(points);
  result.projected_area_m2 = 0.5f * (projected_area(volume, 0) + projected_area(volume, 1));
  // Leaves per band: twice the extinction, over the band's share of the crown.
  const float height = grid.box().size().z;
  std::vector<float> leaves(density_bands, 0.0f), space(density_bands, 0.0f);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const auto band = std::size_t(std::clamp(
        int((grid.centre(i).z - grid.box().min.z) / height * density_bands), 0, density_bands - 1));
    leaves[band] += 2.0f * volume.extinction_per_m[i] * size.x * size.y * size.z;
  }
  for (std::size_t band = 0; band < space.size(); ++band) {
    const float low = grid.box().min.z + height * float(band) / density_bands;
    space[band] = height / density_bands *
                  outline_area(between(points, low, low + height / density_bands), points.reach_m);
    result.leaf_area_density_per_m.push_back(space[band] > 0.0f ? leaves[band] / space[band] : 0.0f);
  }
  return result;
}

TreeMeasures measured(const scene::Model& model) {
  Points points;
  for (const scene::Part& part : model.parts) {
    const Mesh& mesh = part.mesh;
    for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
      const glm::vec3 a = mesh.positions[mesh.indices[t]], b = mesh.positions[mesh.indices[t + 1]],
                      c = mesh.positions[mesh.indices[t + 2]];
      // So densely that no slice misses a long triangle.
      const float edge = std::max(glm::distance(a, b), std::max(glm::distance(b, c), glm::distance(c, a)));
      const int steps = std::clamp(int(std::ceil(edge / 0.1f)), 1, 40);
      for (int i = 0; i <= steps; ++i)
        for (int j = 0; j <= steps - i; ++j)
          points.places.push_back(a + (b - a) * (float(i) / float(steps)) +
                                  (c - a) * (float(j) / float(steps)));
    }
  }
  return measured(points);
}

}  // namespace parvis::trees
