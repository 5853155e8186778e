#include "life/people/surface_net.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace parvis::people {
namespace {

float lattice_noise(glm::ivec3 c) {
  std::uint32_t h =
      std::uint32_t(c.x) * 0x8da6b343u ^ std::uint32_t(c.y) * 0xd8163841u ^ std::uint32_t(c.z) * 0xcb1ab31fu;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du, h = (h ^ (h >> 12)) * 0x297a2d39u, h ^= h >> 15;
  return float(h >> 8) * 0x1p-23f - 1.0f;
}

/// A grid of field values and the vertex of each cell.
struct Lattice {
  glm::ivec3 size{0};
  std::vector<float> values;

  std::size_t index(glm::ivec3 c) const {
    return (std::size_t(c.z) * std::size_t(size.y) + std::size_t(c.y)) * std::size_t(size.x) +
           std::size_t(c.x);
  }
};

/// Fills a block of a lattice: values far from the surface are those of the middles of their blocks, the
/// others are found in smaller blocks.
void sample_block(const Field& field, glm::vec3 low, glm::vec3 cell, glm::ivec3 first, int block,
                  Lattice& lattice) {
  constexpr int smallest = 2, next = 2;
  const glm::ivec3 end = glm::min(first + block, lattice.size);
  const float there = field(low + cell * (glm::vec3(first) + 0.5f * float(block - 1)));
  const float reach =
      1.6f * 0.5f * float(block) * glm::length(cell);  // half of the diagonal, and slopes above 1
  const bool is_far = std::abs(there) > reach;
  if (!is_far && block > smallest) {
    for (int z = first.z; z < end.z; z += next)
      for (int y = first.y; y < end.y; y += next)
        for (int x = first.x; x < end.x; x += next) sample_block(field, low, cell, {x, y, z}, next, lattice);
    return;
  }
  for (int z = first.z; z < end.z; ++z)
    for (int y = first.y; y < end.y; ++y)
      for (int x = first.x; x < end.x; ++x)
        lattice.values[lattice.index({x, y, z})] = is_far ? there : field(low + cell * glm::vec3(x, y, z));
}

Lattice sampled(const Field& field, glm::vec3 low, glm::ivec3 size, glm::vec3 cell) {
  constexpr int block = 6;
  Lattice lattice{size, std::vector<float>(std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z))};
  for (int z = 0; z < size.z; z += block)
    for (int y = 0; y < size.y; y += block)
      for (int x = 0; x < size.x; x += block) sample_block(field, low, cell, {x, y, z}, block, lattice);
  return lattice;
}

constexpr std::array<glm::ivec3, 8> corners_of_cell{
    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}}};
constexpr std::array<std::array<int, 2>, 12> edges_of_cell{
    {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

/// The mean of the places where the surface cuts the cell's edges; false where it cuts none.
bool vertex_of_cell(const Lattice& lattice, glm::ivec3 cell, glm::vec3& vertex) {
  std::array<float, 8> value;
  int inside = 0;
  for (std::size_t c = 0; c < 8; ++c) {
    value[c] = lattice.values[lattice.index(cell + corners_of_cell[c])];
    inside += value[c] < 0.0f ? 1 : 0;
  }
  if (inside == 0 || inside == 8) return false;
  glm::vec3 sum(0.0f);
  int cuts = 0;
  for (const auto& edge : edges_of_cell) {
    const float a = value[std::size_t(edge[0])], b = value[std::size_t(edge[1])];
    if ((a < 0.0f) == (b < 0.0f)) continue;
    sum += glm::mix(glm::vec3(corners_of_cell[std::size_t(edge[0])]),
                    glm::vec3(corners_of_cell[std::size_t(edge[1])]), a / (a - b));
    ++cuts;
  }
  vertex = glm::vec3(cell) + sum / float(cuts);
  return true;
}

void add_quads(const Lattice& lattice, const std::vector<int>& vertex_of, Mesh& mesh) {
  for (int axis = 0; axis < 3; ++axis) {
    glm::ivec3 u(0), v(0), along(0);
    along[axis] = 1, u[(axis + 1) % 3] = 1, v[(axis + 2) % 3] = 1;
    for (int z = 0; z < lattice.size.z; ++z)
      for (int y = 0; y < lattice.size.y; ++y)
        for (int x = 0; x < lattice.size.x; ++x) {
          const glm::ivec3 p(x, y, z);
          if (p[axis] + 1 >= lattice.size[axis] || p[(axis + 1) % 3] == 0 || p[(axis + 2) % 3] == 0) continue;
          if (p[(axis + 1) % 3] + 1 >= lattice.size[(axis + 1) % 3] ||
              p[(axis + 2) % 3] + 1 >= lattice.size[(axis + 2) % 3])
            continue;
          const bool from = lattice.values[lattice.index(p)] < 0.0f,
                     to = lattice.values[lattice.index(p + along)] < 0.0f;
          if (from == to) continue;
          std::array<std::uint32_t, 4> q{std::uint32_t(vertex_of[lattice.index(p - u - v)]),
                                         std::uint32_t(vertex_of[lattice.index(p - v)]),
                                         std::uint32_t(vertex_of[lattice.index(p)]),
                                         std::uint32_t(vertex_of[lattice.index(p - u)])};
          if (!from) std::swap(q[1], q[3]);
          mesh.indices.insert(mesh.indices.end(), {q[0], q[1], q[2], q[0], q[2], q[3]});
        }
  }
}

}  // namespace

float round_cone(glm::vec3 p, glm::vec3 a, glm::vec3 b, float ra, float rb) {
  const glm::vec3 ab = b - a;
  const float t = glm::clamp(glm::dot(p - a, ab) / std::max(glm::dot(ab, ab), 1e-12f), 0.0f, 1.0f);
  return glm::distance(p, a + t * ab) - std::lerp(ra, rb, t);
}

float ellipsoid(glm::vec3 p, glm::vec3 centre, glm::vec3 radii) {
  const glm::vec3 q = (p - centre) / radii;
  const float k = glm::length(q), slope = glm::length(q / radii);
  return slope > 1e-6f ? k * (k - 1.0f) / slope : -std::min({radii.x, radii.y, radii.z});
}

float smooth_noise(glm::vec3 p) {
  const glm::vec3 base = glm::floor(p), f = p - base, w = f * f * (3.0f - 2.0f * f);
  const glm::ivec3 c(base);
  float sum = 0.0f;
  for (const glm::ivec3 corner : corners_of_cell) {
    const glm::vec3 part = glm::mix(1.0f - w, w, glm::vec3(corner));
    sum += part.x * part.y * part.z * lattice_noise(c + corner);
  }
  return sum;
}

glm::vec3 normal_of(const Field& field, glm::vec3 p, float step_m) {
  // Four corners of a tetrahedron: two samples less than central differences.
  glm::vec3 slope(0.0f);
  for (const glm::vec3 corner :
       {glm::vec3(1, -1, -1), glm::vec3(-1, -1, 1), glm::vec3(-1, 1, -1), glm::vec3(1, 1, 1)})
    slope += corner * field(p + 0.577f * step_m * corner);
  const float length = glm::length(slope);
  return length > 0.0f ? slope / length : glm::vec3(0, 0, 1);
}

Mesh surface_net(const Field& field, glm::vec3 low, glm::vec3 high, float cell_m) {
  return surface_net(field, low, high, glm::vec3(cell_m));
}

Mesh surface_net(const Field& field, glm::vec3 low, glm::vec3 high, glm::vec3 cell) {
  const float cell_m = std::min({cell.x, cell.y, cell.z});
  const glm::ivec3 size = glm::ivec3(glm::ceil((high - low) / cell)) + 2;
  const Lattice lattice = sampled(field, low, size, cell);
  Mesh mesh;
  std::vector<int> vertex_of(lattice.values.size(), -1);
  for (int z = 0; z + 1 < size.z; ++z)
    for (int y = 0; y + 1 < size.y; ++y)
      for (int x = 0; x + 1 < size.x; ++x) {
        glm::vec3 vertex;
        if (!vertex_of_cell(lattice, {x, y, z}, vertex)) continue;
        vertex_of[lattice.index({x, y, z})] = int(mesh.positions.size());
        mesh.positions.push_back(low + cell * vertex);
      }
  add_quads(lattice, vertex_of, mesh);
  for (glm::vec3& p : mesh.positions) {
    const glm::vec3 towards =
        normal_of(field, p, 0.15f * cell_m);  // of the surface nearby: good for all steps
    for (int i = 0; i < 3; ++i) {
      const float there = field(p);
      if (std::abs(there) < 1e-4f) break;
      p -= glm::clamp(there, -0.4f * cell_m, 0.4f * cell_m) * towards;
    }
    mesh.normals.push_back(normal_of(field, p, std::max(0.002f, 0.15f * cell_m)));
  }
  mesh.uvs.resize(mesh.positions.size());
  return mesh;
}

Mesh clipped(const Mesh& mesh, const Field& keep) {
  Mesh result;
  std::vector<float> value(mesh.positions.size());
  for (std::size_t v = 0; v < value.size(); ++v) value[v] = keep(mesh.positions[v]);
  std::vector<int> of_vertex(value.size(), -1);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> of_edge;
  const auto vertex = [&](std::uint32_t v) {
    if (of_vertex[v] < 0) {
      of_vertex[v] = int(result.positions.size());
      append_vertex(result, mesh, v);
    }
    return std::uint32_t(of_vertex[v]);
  };
  const auto cut = [&](std::uint32_t a, std::uint32_t b) {
    const auto [found, is_new] =
        of_edge.try_emplace(std::minmax(a, b), std::uint32_t(result.positions.size()));
    if (is_new) {
      const float t = value[a] / (value[a] - value[b]);
      append_vertex(result, mesh, a);
      result.positions.back() = glm::mix(mesh.positions[a], mesh.positions[b], t);
      result.normals.back() = glm::normalize(glm::mix(mesh.normals[a], mesh.normals[b], t));
      result.uvs.back() = glm::mix(mesh.uvs[a], mesh.uvs[b], t);
    }
    return found->second;
  };
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    std::vector<std::uint32_t> polygon;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t a = mesh.indices[i + c], b = mesh.indices[i + (c + 1) % 3];
      if (value[a] < 0.0f) polygon.push_back(vertex(a));
      if ((value[a] < 0.0f) != (value[b] < 0.0f)) polygon.push_back(cut(a, b));
    }
    for (std::size_t c = 2; c < polygon.size(); ++c)
      result.indices.insert(result.indices.end(), {polygon[0], polygon[c - 1], polygon[c]});
  }
  return result;
}

}  // namespace parvis::people
