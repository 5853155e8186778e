#include "places/kerbside/map_trees.h"

#include <algorithm>
#include <array>
#include <map>

#include "base/bounds.h"
#include "base/disjoint_sets.h"
#include "scene/data/model_parts.h"

namespace parvis::kerbside {
namespace {

constexpr float same_point_m = 0.01f;

struct Genus {
  std::string_view word;  ///< in lower case, of a name
  std::string_view kind;
};
constexpr std::array<Genus, 6> genera{{{"quercus", "oak"},
                                       {"oak", "oak"},
                                       {"platanus", "plane"},
                                       {"acer", "plane"},
                                       {"citrus", "orange"},
                                       {"orange", "orange"}}};

}  // namespace

std::vector<MapTree> take_trees(scene::Model& model, std::string_view target) {
  const std::vector<glm::mat4> pose = scene::rest_pose(model);
  struct Taken {
    Bounds bounds;
    std::size_t part;
  };
  TrianglesAtCorners trees(same_point_m);
  std::vector<Taken> taken;
  for (const std::size_t index : scene::matching_parts(model, target)) {
    Mesh& mesh = model.parts[index].mesh;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      std::array<glm::vec3, 3> corners;
      Bounds bounds;
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::vec4 corner(mesh.positions[mesh.indices[i + k]], 1.0f);
        corners[k] = glm::vec3(pose[std::size_t(model.parts[index].node)] * corner);
        bounds.add(corners[k]);
      }
      trees.add(corners);
      taken.push_back({bounds, index});
    }
    mesh.indices.clear();
  }
  std::map<std::size_t, Taken> whole;
  for (std::size_t i = 0; i < taken.size(); ++i) {
    const auto [known, is_new] = whole.try_emplace(trees.root(i), taken[i]);
    if (!is_new) known->second.bounds.add(taken[i].bounds);
  }
  std::vector<MapTree> result;
  for (const auto& [root, tree] : whole)
    result.push_back({glm::vec3(glm::vec2(tree.bounds.centre()), tree.bounds.min.z), tree.bounds.size().z,
                      model.parts[tree.part].object});
  std::erase_if(model.parts, [](const scene::Part& part) { return part.mesh.indices.empty(); });
  return result;
}

std::string_view plant_kind_of(std::string_view name, std::string_view usual) {
  std::string lower(name);
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  for (const Genus& genus : genera)
    if (lower.find(genus.word) != std::string::npos) return genus.kind;
  return usual;
}

}  // namespace parvis::kerbside
