#include "places/dressing/ground_cover.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/gtc/matrix_inverse.hpp>
#include <map>
#include <tuple>
#include <utility>

#include "places/dressing/model_triangles.h"
#include "scene/data/model_parts.h"
#include "synthesis/ground_texture.h"
#include "synthesis/tree.h"

namespace parvis::dressing {
namespace {

using synthesis::SurfacePictures, synthesis::TreeSpot, synthesis::asphalt_pictures,
    synthesis::asphalt_sheet_m, synthesis::gravel_pictures, synthesis::gravel_sheet_m,
    synthesis::lawn_pictures, synthesis::lawn_sheet_m, synthesis::paving_pictures, synthesis::paving_sheet_m,
    synthesis::plant_small_trees;

struct Cover {
  std::string name;
  SurfacePictures (*paint)(std::uint32_t seed);
  float sheet_m;
};

const std::vector<Cover>& covers() {
  static const std::vector<Cover> all{{"lawn", lawn_pictures, lawn_sheet_m},
                                      {"paving", paving_pictures, paving_sheet_m},
                                      {"gravel", gravel_pictures, gravel_sheet_m},
                                      {"asphalt", asphalt_pictures, asphalt_sheet_m}};
  return all;
}

const Cover& cover_named(std::string_view name) {
  const auto found = std::ranges::find(covers(), name, &Cover::name);
  assert(found != covers().end() && "the schema offers ground_covers() alone");
  return *found;
}

constexpr float ground_cell_m = 4.0f;  // the lowest point of 3 x 3 cells is the ground of the middle one
constexpr float raised_m = 1.2f;       // above it nothing is ground
constexpr float lowest_tree_m = 3.0f, highest_tree_m = 22.0f;

using Cell = std::pair<int, int>;

Cell cell_of(glm::vec3 p) {
  return {int(std::floor(p.x / ground_cell_m)), int(std::floor(p.y / ground_cell_m))};
}

/// The ground below green, out of the lowest points nearby.
class Ground {
 public:
  void add(glm::vec3 p) {
    const auto [known, is_new] = lowest_.try_emplace(cell_of(p), p.z);
    if (!is_new) known->second = std::min(known->second, p.z);
  }
  float below(glm::vec3 p) const {
    const auto [column, row] = cell_of(p);
    float lowest = p.z;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (const auto cell = lowest_.find({column + dx, row + dy}); cell != lowest_.end())
          lowest = std::min(lowest, cell->second);
    return lowest;
  }

 private:
  std::map<Cell, float> lowest_;
};

/// The highest tops first; each keeps lower ones as far away as its crown is wide.
std::vector<TreeSpot> without_crowding(std::vector<TreeSpot> tops) {
  std::sort(tops.begin(), tops.end(), [](const TreeSpot& a, const TreeSpot& b) {
    return std::tie(b.height_m, a.foot.x, a.foot.y) < std::tie(a.height_m, b.foot.x, b.foot.y);
  });
  std::vector<TreeSpot> kept;
  for (const TreeSpot& top : tops) {
    const bool is_free = std::none_of(kept.begin(), kept.end(), [&](const TreeSpot& tree) {
      return glm::distance(glm::vec2(tree.foot), glm::vec2(top.foot)) < 0.45f * tree.height_m;
    });
    if (is_free) kept.push_back(top);
  }
  return kept;
}

/// Calls `change(position in the model's frame)` for the vertices of some parts.
template <class Change>
void for_each_vertex(scene::Model& model, const std::vector<std::size_t>& parts, Change&& change) {
  const std::vector<glm::mat4> pose = scene::rest_pose(model);
  for (const std::size_t index : parts) {
    scene::Part& part = model.parts[index];
    const glm::mat4& model_from_node = pose[std::size_t(part.node)];
    const glm::mat4 node_from_model = glm::affineInverse(model_from_node);
    for (glm::vec3& position : part.mesh.positions) {
      glm::vec3 in_model(model_from_node * glm::vec4(position, 1.0f));
      if (change(in_model)) position = glm::vec3(node_from_model * glm::vec4(in_model, 1.0f));
    }
  }
}

}  // namespace

const std::vector<std::string>& ground_covers() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Cover& cover : covers()) all.push_back(cover.name);
    return all;
  }();
  return names;
}

int add_cover_material(scene::Model& model, std::string_view cover) {
  const Cover& chosen = cover_named(cover);
  SurfacePictures pictures = chosen.paint(1);
  scene::Material material;
  material.name = chosen.name, material.base_colour = glm::vec3(1.0f);
  material.roughness = 1.0f, material.metallic = 1.0f;  // factors of the picture
  material.base_colour_texture = add_texture(model, material.name, std::move(pictures.colour), true);
  material.normal_texture = add_texture(model, material.name, std::move(pictures.normal), false);
  material.surface_texture = add_texture(model, material.name, std::move(pictures.surface), false);
  material.is_double_sided = true;
  model.materials.push_back(material);
  return int(model.materials.size()) - 1;
}

float cover_sheet_m(std::string_view cover) { return cover_named(cover).sheet_m; }

std::size_t add_ground_cover(scene::Model& model, std::string_view target, std::string_view cover) {
  const std::vector<std::size_t> parts = scene::matching_parts(model, target);
  if (parts.empty() || std::ranges::find(ground_covers(), cover) == ground_covers().end()) return 0;
  const int material = add_cover_material(model, cover);

  const std::vector<glm::mat4> pose = scene::rest_pose(model);
  for (const std::size_t index : parts) {
    scene::Part& part = model.parts[index];
    part.material = material;
    part.mesh.uvs.clear();
    for (const glm::vec3& position : part.mesh.positions) {
      const glm::vec3 p(pose[std::size_t(part.node)] * glm::vec4(position, 1.0f));
      part.mesh.uvs.push_back(glm::vec2(p.x, -p.y) / cover_sheet_m(cover));
    }
  }
  return parts.size();
}

std::size_t add_greenery(scene::Model& model, std::string_view target, std::uint64_t seed) {
  const std::vector<std::size_t> parts = scene::matching_parts(model, target);
  Ground ground;
  for_each_vertex(model, parts, [&](glm::vec3 p) { return ground.add(p), false; });
  std::vector<TreeSpot> tops;
  for_each_vertex(model, parts, [&](glm::vec3& p) {
    const float ground_m = ground.below(p), height_m = p.z - ground_m;
    if (height_m < raised_m) return false;
    p.z = ground_m;
    if (height_m >= lowest_tree_m) tops.push_back({p, std::min(height_m, highest_tree_m)});
    return true;
  });
  for (const std::size_t index : parts) {
    Mesh& mesh = model.parts[index].mesh;
    std::fill(mesh.normals.begin(), mesh.normals.end(), glm::vec3(0.0f));
    fill_normals(mesh);
  }
  add_ground_cover(model, target, "lawn");
  const std::vector<TreeSpot> trees = without_crowding(std::move(tops));
  plant_small_trees(model, trees, seed);
  return trees.size();
}

}  // namespace parvis::dressing
