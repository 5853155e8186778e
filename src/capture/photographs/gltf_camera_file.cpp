// Perspective cameras of glTF 2.0 (section 3.10), text or binary. Only the JSON is looked at.
#include <cmath>
#include <cstring>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>

#include "base/json_guard.h"
#include "capture/photographs/camera_files.h"

namespace parvis::photographs {
namespace {
using Json = nlohmann::json;

constexpr int max_node_depth = 200;

/// The JSON of a .gltf, or the first chunk of a .glb; empty where that is cut short.
std::string_view json_text(std::string_view bytes) {
  if (!bytes.starts_with("glTF")) return bytes;
  constexpr std::size_t header = 12, chunk_header = 8;
  std::uint32_t length = 0;
  if (bytes.size() < header + chunk_header) return {};
  std::memcpy(&length, bytes.data() + header, sizeof length);
  return length > bytes.size() - header - chunk_header ? std::string_view()
                                                       : bytes.substr(header + chunk_header, length);
}

/// Reads `count` numbers of a member into `out`; false where it is there and is something else.
bool read_numbers(const Json& node, const char* member, double* out, std::size_t count) {
  if (!node.contains(member)) return true;
  const Json& list = node[member];
  if (!list.is_array() || list.size() != count) return false;
  for (std::size_t i = 0; i < count; ++i) {
    if (!list[i].is_number()) return false;
    out[i] = list[i].get<double>();
  }
  return true;
}

bool read_transform(const Json& node, glm::dmat4& parent_from_node) {
  if (node.contains("matrix")) return read_numbers(node, "matrix", &parent_from_node[0].x, 16);
  double t[3] = {}, r[4] = {0, 0, 0, 1}, s[3] = {1, 1, 1};
  if (!read_numbers(node, "translation", t, 3) || !read_numbers(node, "rotation", r, 4) ||
      !read_numbers(node, "scale", s, 3))
    return false;
  parent_from_node = glm::mat4_cast(glm::dquat(r[3], r[0], r[1], r[2]));
  for (int axis = 0; axis < 3; ++axis) parent_from_node[axis] *= s[axis];
  parent_from_node[3] = glm::dvec4(t[0], t[1], t[2], 1.0);
  return true;
}

/// Reads the cameras at and below one node.
class CameraWalk {
 public:
  CameraWalk(const Json& file, std::vector<ViewOfPicture>& views) : file_(file), views_(views) {}

  bool visit(const Json& index, const glm::dmat4& world_from_parent, int depth) {
    const Json& nodes = file_["nodes"];
    if (!index.is_number_unsigned() || index.get<std::size_t>() >= nodes.size() || depth > max_node_depth)
      return false;
    if (++visited_ > nodes.size()) return false;  // a node below itself, or below two
    const Json& node = nodes[index.get<std::size_t>()];
    glm::dmat4 parent_from_node(1.0);
    if (!node.is_object() || !read_transform(node, parent_from_node)) return false;
    const glm::dmat4 world_from_node = world_from_parent * parent_from_node;
    if (node.contains("camera") && !add_view(node, world_from_node)) return false;
    for (const Json& child : node.value("children", Json::array()))
      if (!visit(child, world_from_node, depth + 1)) return false;
    return true;
  }

 private:
  bool add_view(const Json& node, const glm::dmat4& world_from_node) {
    const auto given = file_.find("cameras");
    if (given == file_.end()) return false;
    const Json& cameras = *given;
    const Json& index = node["camera"];
    if (!index.is_number_unsigned() || index.get<std::size_t>() >= cameras.size()) return false;
    const Json& camera = cameras[index.get<std::size_t>()];
    if (!camera.is_object()) return false;
    if (!camera.contains("perspective")) return true;  // orthographic: no photograph
    ViewOfPicture view;
    view.world_from_camera = world_from_node;
    for (int axis = 0; axis < 3; ++axis)
      view.world_from_camera[axis] = glm::normalize(view.world_from_camera[axis]);
    if (!camera["perspective"].is_object() || !read_numbers_of_fov(camera["perspective"], view.fov))
      return false;
    view.name = node.contains("name") && node["name"].is_string() ? node["name"].get<std::string>() : "";
    views_.push_back(std::move(view));
    return true;
  }
  static bool read_numbers_of_fov(const Json& perspective, double& fov) {
    if (!perspective.contains("yfov") || !perspective["yfov"].is_number()) return false;
    fov = perspective["yfov"].get<double>();
    return true;
  }

  const Json& file_;
  std::vector<ViewOfPicture>& views_;
  std::size_t visited_ = 0;
};

}  // namespace

Result<std::vector<ViewOfPicture>> parse_gltf_cameras(std::string_view bytes, const std::string& name) {
  if (Status depth = check_json_depth(json_text(bytes), name); !depth) return depth.errors();
  const Json file = Json::parse(json_text(bytes), nullptr, false);
  const Error damaged = error("{}: expected glTF 2.0 with nodes and cameras", name);
  if (!file.is_object() || !file.contains("nodes") || !file["nodes"].is_array()) return damaged;
  std::vector<ViewOfPicture> views;
  CameraWalk walk(file, views);
  glm::dmat4 z_up(0.0);  // (x, y, z) of a world with y up becomes (x, -z, y)
  z_up[0][0] = z_up[1][2] = z_up[3][3] = 1.0;
  z_up[2][1] = -1.0;
  const Json scenes = file.value("scenes", Json::array());
  if (!scenes.is_array()) return damaged;
  for (const Json& scene : scenes) {
    if (!scene.is_object() || !scene.value("nodes", Json::array()).is_array()) return damaged;
    for (const Json& root : scene.value("nodes", Json::array()))
      if (!walk.visit(root, z_up, 0)) return damaged;
    break;  // the first scene: the same cameras would come again
  }
  return views;
}

}  // namespace parvis::photographs
