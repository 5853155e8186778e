#include "capture/facades/facade_gltf.h"

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

#include "base/json_guard.h"
#include "capture/facades/baked_texture.h"
#include "capture/facades/placed_facade.h"
#include "formats/gltf/gltf_own_data.h"

namespace parvis::facades {
namespace {

using Json = nlohmann::json;

constexpr const char* layers_extension = "PARVIS_layered_photographs";
constexpr int extension_version = 1;

/// The lists of a facade that are views of the file, by their names there.
template <class Facade, class Visit>
void visit_lists(Facade& facade, Visit&& visit) {
  visit("blocks", facade.blocks), visit("candidates", facade.candidates), visit("corners", facade.corners);
  visit("depths", facade.depths), visit("fallback", facade.fallback), visit("layers", facade.layers);
  visit("lists", facade.lists), visit("surface_of_triangle", facade.surface_of_triangle);
  visit("tiles", facade.tiles);
}

Json json_of(const PackedPhoto& photo) {
  const View& view = photo.view;
  Json json{{"name", photo.name},
            {"size", {view.width, view.height}},
            {"focal", {view.fx, view.fy}},
            {"principal_point", {view.cx, view.cy}},
            {"centre", {view.centre.x, view.centre.y, view.centre.z}},
            {"balance_scale", photo.balance.scale},
            {"balance_offset", photo.balance.offset}};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      json["camera_from_facade"].push_back(view.camera_from_world[column][row]);
  return json;
}

/// `count` numbers of an entry. Throws what nlohmann's reader throws where they are not there.
std::vector<double> numbers(const Json& json, const char* name, std::size_t count) {
  const auto found = json.at(name).get<std::vector<double>>();
  if (found.size() != count) throw std::out_of_range(name);
  return found;
}

PackedPhoto photo_of(const Json& json) {
  PackedPhoto photo;
  photo.name = json.at("name").get<std::string>();
  const auto size = json.at("size").get<std::array<int, 2>>();
  const std::vector<double> focal = numbers(json, "focal", 2), middle = numbers(json, "principal_point", 2),
                            centre = numbers(json, "centre", 3),
                            rotation = numbers(json, "camera_from_facade", 9);
  photo.view.width = size[0], photo.view.height = size[1];
  photo.view.fx = focal[0], photo.view.fy = focal[1], photo.view.cx = middle[0], photo.view.cy = middle[1];
  photo.view.centre = {centre[0], centre[1], centre[2]};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      photo.view.camera_from_world[column][row] = rotation[std::size_t(3 * row + column)];
  std::ranges::copy(numbers(json, "balance_scale", 3), photo.balance.scale.begin());
  std::ranges::copy(numbers(json, "balance_offset", 3), photo.balance.offset.begin());
  return photo;
}

scene::Model model_with(const PackedFacade& facade, BakedTexture baked, const std::string& name) {
  scene::Model model;
  model.name = name;
  model.textures.push_back(
      {"photographs", std::move(baked.picture), true, scene::Wrap::clamp, scene::Wrap::clamp});
  // Light that was recorded: it shines by itself, and nothing lights it again.
  scene::Material material;
  material.name = "photographs";
  material.base_colour = glm::vec3(0.0f), material.metallic = 1.0f, material.roughness = 1.0f;
  material.emission = glm::vec3(1.0f), material.emission_texture = 0, material.is_double_sided = true;
  model.materials.push_back(material);
  const Mesh mesh = mesh_of(facade);
  for (std::size_t first = 0, last = 0; first < facade.triangle_count(); first = last) {
    const std::uint32_t surface = facade.surface_of_triangle[first];
    scene::Part part;
    part.object = facade.surfaces[surface], part.node = int(model.nodes.size());
    part.is_backdrop = part.object == backdrop_name, part.casts_shadow = !part.is_backdrop;
    for (; last < facade.triangle_count() && facade.surface_of_triangle[last] == surface; ++last)
      for (std::size_t i = 3 * last; i < 3 * last + 3; ++i) {
        part.mesh.indices.push_back(std::uint32_t(part.mesh.positions.size()));
        part.mesh.positions.push_back(mesh.positions[i]), part.mesh.normals.push_back(mesh.normals[i]);
        part.mesh.uvs.push_back(baked.uvs[i]);
      }
    model.nodes.push_back({.name = part.object, .parent = 0});
    model.parts.push_back(std::move(part));
  }
  return model;
}

/// A list out of the bytes of its view; an empty one where there is none.
template <class T>
bool take(const scene::GltfOwnData& own, const char* name, std::vector<T>& list) {
  for (const auto& [known, bytes] : own.views) {
    if (known != name) continue;
    if (bytes.size() % sizeof(T) != 0) return false;
    list.resize(bytes.size() / sizeof(T));
    std::memcpy(list.data(), bytes.data(), bytes.size());
  }
  return true;
}

}  // namespace

Status write_facade_gltf(const std::filesystem::path& file, const PackedFacade& facade, int max_side) {
  if (Status status = check_facade(facade, file); !status) return status;
  Json json{{"version", extension_version}, {"surfaces", facade.surfaces}, {"photographs", Json::array()}};
  for (const PackedPhoto& photo : facade.photos) json["photographs"].push_back(json_of(photo));
  json["tile_inner"] = tile_inner, json["tile_border"] = tile_border, json["tile_levels"] = tile_levels;
  json["depth_cell"] = depth_cell;
  scene::GltfOwnData own{layers_extension, json.dump(-1, ' ', false, Json::error_handler_t::replace), {}};
  visit_lists(facade, [&](const char* name, const auto& list) {
    own.views.emplace_back(
        name, std::string(reinterpret_cast<const char*>(list.data()), list.size() * sizeof(list[0])));
  });
  return scene::write_gltf(file, model_with(facade, baked_texture(facade, max_side), file.stem().string()),
                           own);
}

Result<PackedFacade> read_facade_gltf(const std::filesystem::path& file) {
  const Result<scene::GltfOwnData> own = scene::read_gltf_own_data(file, layers_extension);
  if (!own) return own.errors();
  PackedFacade facade;
  try {
    const Json json = Json::parse(own->json);
    if (json.at("version") != extension_version || json.at("tile_inner") != tile_inner ||
        json.at("tile_border") != tile_border || json.at("tile_levels") != tile_levels ||
        json.at("depth_cell") != depth_cell)
      return error("{}: its {} is of another version; export the place again (parvis facade export)",
                   file.string(), layers_extension);
    facade.surfaces = json.at("surfaces").get<std::vector<std::string>>();
    if (json.at("photographs").size() > max_facade_photos)
      return error("{}: it names {} photographs; at most {} are read", file.string(),
                   json.at("photographs").size(), max_facade_photos);
    for (const Json& photo : json.at("photographs")) facade.photos.push_back(photo_of(photo));
  } catch (const Json::exception& problem) {
    return error("{}: its {} is not as it should be ({})", file.string(), layers_extension,
                 json_reason(problem.what()));
  } catch (const std::out_of_range& problem) {
    return error("{}: its {} has another number of values in \"{}\" than expected", file.string(),
                 layers_extension, problem.what());
  }
  bool are_whole = true;
  visit_lists(facade, [&](const char* name, auto& list) { are_whole &= take(*own, name, list); });
  if (!are_whole) return error("{}: a view of its {} is cut off", file.string(), layers_extension);
  if (Status status = check_facade(facade, file); !status) return status.errors();
  return facade;
}

}  // namespace parvis::facades
