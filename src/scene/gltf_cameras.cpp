#include "scene/gltf_cameras.h"

#include <nlohmann/json.hpp>

#include "base/files.h"

namespace parvis::scene {
namespace {

using Json = nlohmann::json;

Json camera_json(const TakenPicture& picture) {
  const double aspect = double(picture.width) / double(picture.height);
  return {{"name", picture.name},
          {"type", "perspective"},
          {"perspective",
           {{"yfov", picture.camera.vertical_fov},
            {"aspectRatio", aspect},
            {"znear", picture.camera.near_m},
            {"zfar", picture.camera.far_m}}}};
}

Json node_json(const TakenPicture& picture, std::size_t camera) {
  Json matrix = Json::array();
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) matrix.push_back(picture.camera.world_from_camera[column][row]);
  return {{"name", picture.name}, {"camera", camera}, {"matrix", matrix}};
}

}  // namespace

Status write_gltf_cameras(const std::filesystem::path& file, const std::vector<TakenPicture>& pictures) {
  Json json{{"asset", {{"version", "2.0"}, {"generator", "Parvis"}}}, {"scene", 0}};
  constexpr float half = 0.70710678f;  // a quarter turn about x: (x, y, z) becomes (x, z, -y)
  Json root{{"name", "world, z up"}, {"rotation", {-half, 0.0f, 0.0f, half}}};
  json["nodes"] = Json::array({root});
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    json["cameras"].push_back(camera_json(pictures[i]));
    json["nodes"].push_back(node_json(pictures[i], i));
    json["nodes"][0]["children"].push_back(i + 1);
  }
  json["scenes"] = Json::array({{{"nodes", {0}}}});
  return write_file(file, json.dump(1) + "\n");
}

}  // namespace parvis::scene
