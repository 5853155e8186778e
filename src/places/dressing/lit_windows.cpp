#include "places/dressing/lit_windows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "base/colour.h"
#include "base/cut_polygon.h"
#include "base/disjoint_sets.h"
#include "base/random.h"
#include "places/dressing/model_triangles.h"
#include "synthesis/place_seed.h"

namespace parvis::dressing {
namespace {

constexpr float lit_probability = 0.32f;
constexpr float before_pane_m = 0.012f;
constexpr int gap_cells = 64;  // along a sheet of some 12 m: panes of one window lie nearer than 0.2 m
constexpr float same_pane_m = 0.05f, pane_cell_m = 0.5f;  // of middles of pieces of one window
constexpr std::uint8_t max_glass_roughness = 20;          // of 255: nothing else on a sheet is so smooth
constexpr float room = 0.35f, cloth = 2.2f;  // of a lit wall behind, and how much light things let through
constexpr std::int64_t max_sheets = 10'000;  // on one triangle: a wall of kilometres is no house
constexpr int tint_count = 3;
/// Radiance of a lit wall behind glass, W/m2/sr weighted by the eye: 12 to 40 cd/m2. Incandescent light, a
/// shaded lamp, daylight tubes.
constexpr std::array<glm::vec3, tint_count> room_light{
    {{0.05f, 0.031f, 0.0135f}, {0.032f, 0.0155f, 0.0055f}, {0.036f, 0.0325f, 0.0265f}}};

/// A rectangle of a sheet, in texture coordinates from 0 to 1.
struct PaneBox {
  glm::vec2 low{1.0f}, high{0.0f};
};

/// The glass of a sheet, which is smooth, lit; everything else has an alpha of 0.
Image8 lit_glass(const Image8& colour, const Image8& surface) {
  Image8 lit(surface.width, surface.height, 4);
  for (int y = 0; y < lit.height; ++y)
    for (int x = 0; x < lit.width; ++x) {
      if (surface.at(x, y)[1] > max_glass_roughness) continue;
      const std::uint8_t* seen = colour.at(x * colour.width / lit.width, y * colour.height / lit.height);
      std::uint8_t* out = lit.at(x, y);
      for (int c = 0; c < 3; ++c)
        out[c] = std::uint8_t(std::lround(
            255.0f *
            srgb_from_linear(std::min(room + cloth * linear_from_srgb(float(seen[c]) / 255.0f), 1.0f))));
      out[3] = 255;
    }
  return lit;
}

/// The windows of a sheet: its glass, in groups that gaps divide.
std::vector<PaneBox> windows_of(const Image8& lit) {
  const auto cell_of = [&](int x, int y) {
    return std::size_t(y * gap_cells / lit.height) * gap_cells + std::size_t(x * gap_cells / lit.width);
  };
  std::vector<char> has_glass(std::size_t(gap_cells) * gap_cells, 0);
  for (int y = 0; y < lit.height; ++y)
    for (int x = 0; x < lit.width; ++x)
      if (lit.at(x, y)[3] != 0) has_glass[cell_of(x, y)] = 1;
  DisjointSets groups(has_glass.size());
  for (int y = 0; y < gap_cells; ++y)
    for (int x = 0; x < gap_cells; ++x)
      for (const auto& [dx, dy] : {std::pair{1, 0}, {0, 1}, {1, 1}, {-1, 1}}) {
        const std::size_t here = std::size_t(y * gap_cells + x),
                          there = std::size_t((y + dy) * gap_cells + x + dx);
        if (x + dx < 0 || x + dx >= gap_cells || y + dy >= gap_cells) continue;
        if (has_glass[here] != 0 && has_glass[there] != 0) groups.join(here, there);
      }
  std::map<std::size_t, PaneBox> boxes;
  const glm::vec2 size(lit.width, lit.height);
  for (int y = 0; y < lit.height; ++y)
    for (int x = 0; x < lit.width; ++x) {
      if (lit.at(x, y)[3] == 0) continue;
      PaneBox& box = boxes[groups.root(cell_of(x, y))];
      box.low = glm::min(box.low, glm::vec2(x, y) / size);
      box.high = glm::max(box.high, glm::vec2(x + 1, y + 1) / size);
    }
  std::vector<PaneBox> windows;
  for (const auto& [group, box] : boxes) windows.push_back(box);
  return windows;
}

/// A corner of a piece of wall.
struct PaneCorner {
  glm::vec3 position;
  glm::vec2 uv;
};

PaneCorner mix(const PaneCorner& a, const PaneCorner& b, float weight) {
  return {glm::mix(a.position, b.position, weight), glm::mix(a.uv, b.uv, weight)};
}

/// The part of a triangle of wall that a rectangle of its texture covers.
std::vector<PaneCorner> covered(const std::array<PaneCorner, 3>& wall, const PaneBox& box) {
  std::vector<PaneCorner> piece(wall.begin(), wall.end());
  for (int axis = 0; axis < 2; ++axis) {
    piece = cut(piece, [&](const PaneCorner& corner) { return corner.uv[axis] - box.low[axis]; });
    piece = cut(piece, [&](const PaneCorner& corner) { return box.high[axis] - corner.uv[axis]; });
  }
  return piece;
}

/// Where the wall that a triangle is a part of has this texture coordinate.
glm::vec3 place_of(glm::vec2 uv, const std::array<PaneCorner, 3>& wall) {
  const glm::vec2 a = wall[1].uv - wall[0].uv, b = wall[2].uv - wall[0].uv, p = uv - wall[0].uv;
  const float area = a.x * b.y - a.y * b.x;
  const float s = (p.x * b.y - p.y * b.x) / area, t = (a.x * p.y - a.y * p.x) / area;
  return wall[0].position + s * (wall[1].position - wall[0].position) +
         t * (wall[2].position - wall[0].position);
}

/// Numbers of windows by their middles, the same for all pieces of one.
class Panes {
 public:
  std::uint64_t number_of(glm::vec3 middle) {
    // Walls often stand at round coordinates: cells do not begin there, where rounding would decide.
    const glm::ivec3 cell(glm::floor(middle / pane_cell_m + 0.37f));
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z)
          if (const auto found = known_.find(key(cell + glm::ivec3(x, y, z))); found != known_.end())
            for (const Pane& pane : found->second)
              if (glm::distance(pane.middle, middle) < same_pane_m) return pane.number;
    const std::uint64_t number = key(cell);
    known_[number].push_back({middle, number});
    return number;
  }

 private:
  struct Pane {
    glm::vec3 middle;
    std::uint64_t number;
  };
  static std::uint64_t key(glm::ivec3 cell) {
    return (std::uint64_t(std::uint32_t(cell.x)) << 42) ^ (std::uint64_t(std::uint32_t(cell.y)) << 21) ^
           std::uint64_t(std::uint32_t(cell.z));
  }
  std::map<std::uint64_t, std::vector<Pane>> known_;
};

/// The lit sheets and materials of the walls of a model, made when the first window needs them.
class LitSheets {
 public:
  struct Sheet {
    int first_material;
    std::vector<PaneBox> windows;
  };

  LitSheets(const scene::Model& dressed, scene::Model& lit) : dressed_(dressed), lit_(lit) {}

  /// The sheet of a material of walls, which walls of several colours share.
  const Sheet& of(const scene::Material& wall) {
    const auto [known, is_new] = sheets_.try_emplace(wall.surface_texture);
    if (!is_new) return known->second;
    const auto texture = [&](int index) -> const scene::Texture& {
      return dressed_.textures[std::size_t(index)];
    };
    Image8 glass = lit_glass(texture(wall.base_colour_texture).image, texture(wall.surface_texture).image);
    known->second = {int(lit_.materials.size()), windows_of(glass)};
    if (known->second.windows.empty()) return known->second;
    const int picture = add_texture(lit_, "lit " + wall.name, std::move(glass), true);
    int normal = scene::no_index;
    if (wall.normal_texture != scene::no_index)
      normal = add_texture(lit_, "lit " + wall.name, texture(wall.normal_texture).image, false);
    for (const glm::vec3& light : room_light) {
      scene::Material& material = lit_.materials.emplace_back();
      material.name = "lit windows";
      material.base_colour = glm::vec3(0.04f), material.roughness = 0.06f;
      material.base_colour_texture = material.emission_texture = picture;
      material.normal_texture = normal, material.relief_m = normal == scene::no_index ? 0.0f : wall.relief_m;
      material.emission = light;
      material.alpha_mode = scene::Alpha::cutout;
    }
    return known->second;
  }

 private:
  const scene::Model& dressed_;
  scene::Model& lit_;
  std::map<int, Sheet> sheets_;
};

/// Windows lie in walls with a relief; bricks alone have none.
bool has_windows(const scene::Part& part, const scene::Material& material) {
  return part.object == "facade" && material.relief_m > 0.0f && material.surface_texture != scene::no_index &&
         material.base_colour_texture != scene::no_index &&
         part.mesh.uvs.size() == part.mesh.positions.size();
}

/// Appends a convex piece of a window, lifted off its wall.
void add_piece(const std::vector<PaneCorner>& piece, glm::vec3 normal, Mesh& mesh) {
  const auto first = std::uint32_t(mesh.positions.size());
  for (const PaneCorner& corner : piece) {
    mesh.positions.push_back(corner.position + before_pane_m * normal);
    mesh.normals.push_back(normal), mesh.uvs.push_back(corner.uv);
  }
  for (std::uint32_t i = 1; i + 1 < piece.size(); ++i)
    mesh.indices.insert(mesh.indices.end(), {first, first + i, first + i + 1});
}

}  // namespace

std::optional<scene::Model> lit_windows(const scene::Model& model) {
  bool has_walls = false;
  scene::Model lit;
  lit.name = "lit windows";
  LitSheets sheets(model, lit);
  Panes panes;
  std::map<int, Mesh> meshes;  // by material
  const std::vector<glm::mat4> pose = scene::rest_pose(model);
  for (const scene::Part& part : model.parts) {
    const scene::Material& material = model.materials[std::size_t(part.material)];
    if (!has_windows(part, material)) continue;
    has_walls = true;
    const LitSheets::Sheet& sheet = sheets.of(material);
    for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3) {
      std::array<PaneCorner, 3> wall;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t index = part.mesh.indices[i + k];
        wall[k] = {glm::vec3(pose[std::size_t(part.node)] * glm::vec4(part.mesh.positions[index], 1.0f)),
                   part.mesh.uvs[index]};
      }
      const glm::vec3 across =
          glm::cross(wall[1].position - wall[0].position, wall[2].position - wall[0].position);
      const glm::vec2 a = wall[1].uv - wall[0].uv, b = wall[2].uv - wall[0].uv;
      if (!(glm::length(across) > 0.0f) || !(std::abs(a.x * b.y - a.y * b.x) > 0.0f)) continue;
      const glm::ivec2 first(glm::floor(glm::min(glm::min(wall[0].uv, wall[1].uv), wall[2].uv))),
          last(glm::floor(glm::max(glm::max(wall[0].uv, wall[1].uv), wall[2].uv)));
      if (std::int64_t(last.x - first.x) * (last.y - first.y) > max_sheets) continue;
      for (int v = first.y; v <= last.y; ++v)
        for (int u = first.x; u <= last.x; ++u)
          for (const PaneBox& window : sheet.windows) {
            const PaneBox box{window.low + glm::vec2(u, v), window.high + glm::vec2(u, v)};
            const std::vector<PaneCorner> piece = covered(wall, box);
            if (piece.size() < 3) continue;
            Random random(synthesis::place_seed,
                          panes.number_of(place_of(0.5f * (box.low + box.high), wall)));
            if (!random.chance(lit_probability)) continue;
            add_piece(piece, glm::normalize(across), meshes[sheet.first_material + random.index(tint_count)]);
          }
    }
  }
  if (!has_walls) return std::nullopt;
  for (auto& [material, mesh] : meshes) {
    scene::Part part;
    part.object = "lit windows", part.material = material, part.casts_shadow = false;
    part.mesh = std::move(mesh);
    lit.parts.push_back(std::move(part));
  }
  return lit;
}

}  // namespace parvis::dressing
