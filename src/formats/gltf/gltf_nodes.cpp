#include "formats/gltf/gltf_nodes.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "formats/gltf/gltf_transform.h"
#include "formats/gltf/gltf_values.h"

namespace parvis::scene {
namespace {

using Json = GltfFile::Json;

constexpr std::size_t max_warnings = 20;  // of a graph that is no tree: a hostile file has millions

/// The transform of a node; of one that shears, that of a second node below it as well.
struct NodeTransform {
  ModelNode node;
  std::optional<ModelNode> lower = std::nullopt;
};

void check_finite(const ModelNode& node, const std::string& name) {
  for (int i = 0; i < 3; ++i)
    if (!std::isfinite(node.translation[i]) || !std::isfinite(node.scale[i]) ||
        !std::isfinite(node.rotation[i]))
      gltf_fail("the transform of node \"{}\" is not finite", name);
}

NodeTransform read_node(const Json& source, FileAccount& account) {
  NodeTransform read;
  ModelNode& node = read.node;
  node.name = source.value("name", "");
  if (source.contains("matrix")) {
    glm::dmat4 matrix(1.0);
    const Json& values = source["matrix"];
    if (!values.is_array() || values.size() != 16)
      gltf_fail("a node's matrix has {} numbers; expected 16", values.size());
    for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = values[std::size_t(i)].get<double>();
    if (!decompose(matrix, node)) {
      read.lower = ModelNode{.name = node.name};
      node.name.clear();
      decompose(matrix, node, *read.lower);
      check_finite(*read.lower, read.lower->name);
      account.used("matrices that shear");
    }
  } else {
    node.translation = gltf_vector<3>(source, "translation", glm::dvec3(0.0));
    node.scale = gltf_vector<3>(source, "scale", glm::dvec3(1.0));
    const glm::dvec4 q = gltf_vector<4>(source, "rotation", glm::dvec4(0, 0, 0, 1));
    const double length = glm::length(q);
    if (length > 0.0) node.rotation = glm::dquat(q.w, q.x, q.y, q.z) / length;
  }
  check_finite(node, source.value("name", ""));
  return read;
}

class TreeReader {
 public:
  TreeReader(const GltfFile& file, Model& model, FileAccount& account, Errors& warnings)
      : file_(file), model_(model), account_(account), warnings_(warnings) {
    nodes_.of_gltf.assign(file.list("nodes").size(), no_index);
    nodes_.gltf_of.assign(model.nodes.size(), no_index);
    nodes_.is_hidden.assign(model.nodes.size(), 0);
  }

  GltfNodes read() {
    const Json& scenes = file_.list("scenes");
    if (scenes.empty()) {
      read_all();
    } else {
      const int scene = std::max(file_.index(file_.json(), "scene", "scenes"), 0);
      for (const Json& root : scenes[std::size_t(scene)].value("nodes", Json::array()))
        if (const std::size_t node = node_index(root); !is_read(node)) read_tree(node);
    }
    count();
    return std::move(nodes_);
  }

 private:
  bool is_read(std::size_t gltf_node) const { return nodes_.of_gltf[gltf_node] != no_index; }

  std::size_t node_index(const Json& value) const {
    if (!value.is_number_unsigned() || value.get<std::size_t>() >= nodes_.of_gltf.size())
      gltf_fail("node {} is out of range; there are {}", value.dump(), nodes_.of_gltf.size());
    return value.get<std::size_t>();
  }

  /// Reads all nodes from the roots on; nodes that no root leads to form circles.
  void read_all() {
    std::vector<std::uint8_t> is_child(nodes_.of_gltf.size(), 0);
    for (const Json& node : file_.list("nodes"))
      for (const Json& child : node.value("children", Json::array())) is_child[node_index(child)] = 1;
    for (std::size_t i = 0; i < is_child.size(); ++i)
      if (!is_child[i]) read_tree(i);
    for (std::size_t i = 0; i < is_child.size(); ++i)
      if (!is_read(i)) read_tree(i);
  }

  /// A node and all below it, without recursion: a hostile tree may be deep.
  void read_tree(std::size_t root) {
    std::vector<std::pair<std::size_t, int>> open{{root, 0}};
    while (!open.empty()) {
      const auto [gltf_node, parent] = open.back();
      open.pop_back();
      if (is_read(gltf_node)) {
        leave_out(gltf_node, parent);
        continue;
      }
      const Json& source = file_.list("nodes")[gltf_node];
      const NodeTransform read = read_node(source, account_);
      const Json& visibility = gltf_extension(source, "KHR_node_visibility");
      const bool is_hidden = nodes_.is_hidden[std::size_t(parent)] != 0 || !visibility.value("visible", true);
      const int upper = append(read.node, parent, is_hidden);
      const int node = read.lower ? append(*read.lower, upper, is_hidden) : upper;
      nodes_.of_gltf[gltf_node] = node;
      nodes_.gltf_of[std::size_t(node)] = int(gltf_node);
      for (const Json& child : source.value("children", Json::array()))
        open.emplace_back(node_index(child), node);
    }
  }

  int append(ModelNode node, int parent, bool is_hidden) {
    node.parent = parent;
    model_.nodes.push_back(std::move(node));
    nodes_.gltf_of.push_back(no_index);
    nodes_.is_hidden.push_back(is_hidden);
    return int(model_.nodes.size()) - 1;
  }

  /// The node of the file above one; 0: the scene.
  int above(int node) const {
    do node = model_.nodes[std::size_t(node)].parent;
    while (node != 0 && nodes_.gltf_of[std::size_t(node)] == no_index);
    return node;
  }

  void count() {
    for (std::size_t i = 0; i < nodes_.of_gltf.size(); ++i)
      if (!is_read(i))
        account_.unneeded("nodes", "no scene shows them",
                          file_.list("nodes")[i].value("name", fmt::format("node {}", i)));
    for (std::size_t i = 1; i < model_.nodes.size(); ++i)
      if (nodes_.gltf_of[i] == no_index)
        continue;
      else if (nodes_.is_hidden[i] != 0)
        account_.unneeded("nodes", "the file hides them", model_.nodes[i].name);
      else
        account_.used("nodes");
    const std::size_t scenes = file_.list("scenes").size();
    if (scenes > 1)
      account_.left_out("scenes", "the first, or the one that the file names, is read", "", scenes - 1);
  }

  void leave_out(std::size_t gltf_node, int parent) {
    if (++left_out_ > max_warnings) return;
    const int present = nodes_.of_gltf[gltf_node];
    int ancestor = parent;
    while (ancestor > present) ancestor = above(ancestor);
    const auto gltf_of = [&](int node) { return nodes_.gltf_of[std::size_t(node)]; };
    const std::string first_parent =
        above(present) == 0 ? "the scene" : fmt::format("node {}", gltf_of(above(present)));
    const std::string reason =
        ancestor == present
            ? fmt::format("node {} is its own ancestor through node {}", gltf_node, gltf_of(parent))
            : fmt::format("node {} has two parents, {} and node {}", gltf_node, first_parent,
                          gltf_of(parent));
    warnings_.push_back(
        {reason + "; glTF asks for a tree: the second link is left out", {file_.path().string(), 0, 0}});
  }

  const GltfFile& file_;
  Model& model_;
  FileAccount& account_;
  Errors& warnings_;
  GltfNodes nodes_;
  std::size_t left_out_ = 0;
};

}  // namespace

GltfNodes read_nodes(const GltfFile& file, Model& model, FileAccount& account, Errors& warnings) {
  return TreeReader(file, model, account, warnings).read();
}

}  // namespace parvis::scene
