#include "capture/trees/measure.h"

#include <algorithm>
#include <cmath>

#include "capture/trees/tree_outline.h"

namespace parvis::trees {
namespace {

constexpr int slices = TreeOutline::slice_count, density_bands = 10;
constexpr float crown_over_trunk = 2.5f;
constexpr int trunk_slices = slices / 5;
constexpr float sample_m = 0.02f;     // of triangles
constexpr int max_side_samples = 60;  // along a triangle's side

/// The trunk is the narrowest slice near the ground, the foot left out; above it the crown begins.
TreeMeasures outline_measures(const TreeOutline& outline) {
  TreeMeasures result;
  if (outline.slices.empty()) return result;
  const float step = outline.slice_height_m();
  result.height_m = outline.top_m - outline.foot_m;
  const auto width = [&](int slice) { return outline.slices[std::size_t(slice)].mean_width_m(); };
  int base = 1;
  for (int slice = 1; slice < trunk_slices; ++slice)
    if (const float w = width(slice);
        w > 0.0f && (result.trunk_diameter_m == 0.0f || w < result.trunk_diameter_m))
      result.trunk_diameter_m = w, base = slice;
  while (base < slices && width(base) < crown_over_trunk * result.trunk_diameter_m) ++base;
  result.crown_base_m = float(base) * step;
  TreeSlice crown;
  for (int i = base; i < slices; ++i) {
    const TreeSlice& slice = outline.slices[std::size_t(i)];
    crown.add(slice), result.crown_volume_m3 += step * slice.hull_area_m2();
  }
  result.crown_width_m = crown.mean_width_m();
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

/// Leaves per band: twice the extinction, over the band's share of the crown. What is below the crown is
/// trunk.
std::vector<float> leaf_area_density(const TreeVolume& volume, const TreeOutline& outline,
                                     float crown_base_m) {
  const glm::vec3 size = volume.grid.cell_size_m();
  const float step = outline.slice_height_m(), height = outline.top_m - outline.foot_m;
  std::vector<float> leaves(density_bands, 0.0f), space(density_bands, 0.0f);
  for (std::size_t i = 0; i < volume.grid.size(); ++i) {
    const float up_m = volume.grid.centre(i).z - outline.foot_m;
    if (up_m < crown_base_m) continue;
    leaves[std::size_t(std::clamp(int(up_m / height * density_bands), 0, density_bands - 1))] +=
        2.0f * volume.extinction_per_m[i] * size.x * size.y * size.z;
  }
  for (int i = int(std::lround(crown_base_m / step)); i < slices; ++i)
    space[std::size_t(i * density_bands / slices)] += step * outline.slices[std::size_t(i)].hull_area_m2();
  for (std::size_t band = 0; band < space.size(); ++band)
    leaves[band] = space[band] > 0.0f ? leaves[band] / space[band] : 0.0f;
  return leaves;
}

/// Does a cutout material show at a place of its textures? As the path tracer's nearest texel.
bool is_there(const scene::Model& model, const scene::Material& material, glm::vec2 uv) {
  if (material.alpha_mode != scene::Alpha::cutout || material.base_colour_texture == scene::no_index)
    return true;
  const scene::Texture& texture = model.textures[std::size_t(material.base_colour_texture)];
  const Image8& image = texture.image;
  uv = glm::vec2(material.texture_from_mesh_uv * glm::vec3(uv, 1.0f));
  uv = {scene::wrapped(uv.x, texture.wrap_u), scene::wrapped(uv.y, texture.wrap_v)};
  const int x = std::min(int(uv.x * float(image.width)), image.width - 1),
            y = std::min(int(uv.y * float(image.height)), image.height - 1);
  return material.alpha * float(image.at(x, y)[3]) >= material.alpha_cutoff * 255.0f;
}

}  // namespace

TreeMeasures measured(const TreeVolume& volume, float min_alpha) {
  const TreeOutline outline = outline_of(volume, min_alpha);
  TreeMeasures result = outline_measures(outline);
  if (outline.slices.empty()) return result;
  result.projected_area_m2 = 0.5f * (projected_area(volume, 0) + projected_area(volume, 1));
  result.leaf_area_density_per_m = leaf_area_density(volume, outline, result.crown_base_m);
  return result;
}

TreeMeasures measured(const scene::Model& model) {
  std::vector<glm::vec3> points;
  for (const scene::Part& part : model.parts) {
    const Mesh& mesh = part.mesh;
    const scene::Material& material = model.materials[std::size_t(part.material)];
    for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
      const std::uint32_t i = mesh.indices[t], j = mesh.indices[t + 1], k = mesh.indices[t + 2];
      const glm::vec3 a = mesh.positions[i], b = mesh.positions[j], c = mesh.positions[k];
      const bool has_uvs = mesh.uvs.size() == mesh.positions.size();
      // So densely that no slice misses a long triangle.
      const float edge = std::max(glm::distance(a, b), std::max(glm::distance(b, c), glm::distance(c, a)));
      const int steps = std::clamp(int(std::ceil(edge / sample_m)), 1, max_side_samples);
      for (int m = 0; m <= steps; ++m)
        for (int n = 0; n <= steps - m; ++n) {
          const float u = float(m) / float(steps), v = float(n) / float(steps);
          const glm::vec2 uv =
              has_uvs ? mesh.uvs[i] + u * (mesh.uvs[j] - mesh.uvs[i]) + v * (mesh.uvs[k] - mesh.uvs[i])
                      : glm::vec2(0.0f);
          if (is_there(model, material, uv)) points.push_back(a + u * (b - a) + v * (c - a));
        }
    }
  }
  return outline_measures(outline_of(points));
}

}  // namespace parvis::trees
