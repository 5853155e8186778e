#include "planning/sun_hours/finer_mesh.h"

#include <algorithm>
#include <array>
#include <unordered_map>

namespace parvis::sun_hours {
namespace {

/// Vertices in the middle of edges, found again by the two that they lie between.
class Middles {
 public:
  explicit Middles(Mesh& mesh) : mesh_(mesh) {}

  std::uint32_t of(std::uint32_t a, std::uint32_t b) {
    const std::uint64_t key = (std::uint64_t(std::min(a, b)) << 32) | std::max(a, b);
    const auto [entry, is_new] = found_.try_emplace(key, std::uint32_t(mesh_.positions.size()));
    if (is_new) {
      mesh_.positions.push_back(0.5f * (mesh_.positions[a] + mesh_.positions[b]));
      const glm::vec3 normal = mesh_.normals[a] + mesh_.normals[b];
      mesh_.normals.push_back(glm::length(normal) > 1e-6f ? glm::normalize(normal) : mesh_.normals[a]);
      mesh_.uvs.emplace_back(0.0f);
    }
    return entry->second;
  }

 private:
  Mesh& mesh_;
  std::unordered_map<std::uint64_t, std::uint32_t> found_;
};

/// Appends a mesh without the vertices that no triangle has.
void append_used(Mesh& result, const Mesh& mesh) {
  constexpr std::uint32_t none = ~0u;
  std::vector<std::uint32_t> place(mesh.positions.size(), none);
  for (const std::uint32_t index : mesh.indices) {
    if (place[index] == none) {
      place[index] = std::uint32_t(result.positions.size());
      result.positions.push_back(mesh.positions[index]);
      result.normals.push_back(mesh.normals[index]);
      result.uvs.push_back(mesh.uvs[index]);
    }
    result.indices.push_back(place[index]);
  }
}

}  // namespace

void append_finer(Mesh& result, const Mesh& mesh, float max_edge_m, glm::vec2 low, glm::vec2 high) {
  Mesh fine;
  fine.positions = mesh.positions, fine.normals = mesh.normals;
  fine.uvs.resize(fine.positions.size(), glm::vec2(0.0f));
  Middles middles(fine);
  std::vector<std::array<std::uint32_t, 3>> left;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const std::array<std::uint32_t, 3> whole{mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
    for (left.assign(1, whole); !left.empty();) {
      const std::array<std::uint32_t, 3> t = left.back();
      left.pop_back();
      const glm::vec2 a2(fine.positions[t[0]]), b2(fine.positions[t[1]]), c2(fine.positions[t[2]]);
      const glm::vec2 least = glm::min(a2, glm::min(b2, c2)), most = glm::max(a2, glm::max(b2, c2));
      if (most.x < low.x || most.y < low.y || least.x > high.x || least.y > high.y) continue;
      float longest = 0.0f;
      std::size_t edge = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const float length = glm::distance(fine.positions[t[k]], fine.positions[t[(k + 1) % 3]]);
        if (length > longest) longest = length, edge = k;
      }
      if (longest <= max_edge_m) {
        const glm::vec2 middle = (a2 + b2 + c2) / 3.0f;
        if (middle.x < low.x || middle.y < low.y || middle.x > high.x || middle.y > high.y) continue;
        fine.indices.insert(fine.indices.end(), t.begin(), t.end());
        continue;
      }
      const std::uint32_t a = t[edge], b = t[(edge + 1) % 3], c = t[(edge + 2) % 3], m = middles.of(a, b);
      left.push_back({a, m, c});
      left.push_back({m, b, c});
    }
  }
  append_used(result, fine);
}

}  // namespace parvis::sun_hours
