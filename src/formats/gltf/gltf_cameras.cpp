#include "formats/gltf/gltf_cameras.h"

#include "base/files.h"
#include "formats/gltf/gltf_transform.h"

namespace parvis::scene {

using Json = nlohmann::json;

Json gltf_camera(const std::string& name, const Camera& camera) {
  return {{"name", name},
          {"type", "perspective"},
          {"perspective", {{"yfov", camera.vertical_fov}, {"znear", camera.near_m}, {"zfar", camera.far_m}}}};
}

Json gltf_camera_node(const std::string& name, const Camera& camera, std::size_t index) {
  return {{"name", name}, {"camera", index}, {"matrix", gltf_matrix(camera.world_from_camera)}};
}

Status write_gltf_cameras(const std::filesystem::path& file, const std::vector<TakenPicture>& pictures) {
  Json json{{"asset", {{"version", "2.0"}, {"generator", "Parvis"}}}, {"scene", 0}};
  Json root{{"name", "world, z up"}, {"matrix", gltf_matrix(glm::transpose(z_up_from_y_up()))}};
  json["nodes"] = Json::array({root});
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const TakenPicture& picture = pictures[i];
    json["cameras"].push_back(gltf_camera(picture.name, picture.camera));
    json["cameras"].back()["perspective"]["aspectRatio"] = double(picture.width) / double(picture.height);
    json["nodes"].push_back(gltf_camera_node(picture.name, picture.camera, i));
    json["nodes"][0]["children"].push_back(i + 1);
  }
  json["scenes"] = Json::array({{{"nodes", {0}}}});
  return write_file(file, json.dump(1) + "\n");
}

}  // namespace parvis::scene
