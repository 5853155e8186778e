#include "bench/facades/hidden_texture.h"

#include <fmt/format.h>

#include <cmath>

#include "base/image_io.h"
#include "graphics/reference/tracer.h"
#include "graphics/shading/tone_curve.h"
#include "places/paper_city/city_buildings.h"
#include "places/paper_city/paper_city.h"
#include "places/paper_city/paper_script.h"
#include "places/paper_city/sky_picture.h"

namespace parvis::bench {
namespace {

constexpr std::uint64_t seed = 1;
constexpr int width = 480, height = 360;
constexpr float camera_distance_m = 10.0f, camera_step_m = 2.0f, field_of_view = 0.9f;  // vertical
constexpr float board_distance_m = 3.0f, board_width_m = 2.4f, board_height_m = 2.6f;
constexpr int cameras_each_way = 2;

/// Metres along a house's front, from it toward the street, and up.
struct StreetFront {
  city::Frame frame;
  float width_m = 0.0f, low_m = 0.0f, high_m = 0.0f;

  glm::vec3 point(float along, float toward, float up) const { return frame.point(along, -toward, up); }
  glm::vec3 middle(float along_more, float toward) const {
    return point(0.5f * width_m + along_more, toward, 0.5f * (low_m + high_m));
  }
};

facades::NamedMesh rectangle(const std::string& name, glm::vec3 corner, glm::vec3 along, glm::vec3 up) {
  facades::NamedMesh named{name, {}};
  named.mesh.positions = {corner, corner + along, corner + along + up, corner + up};
  named.mesh.indices = {0, 1, 2, 0, 2, 3};
  named.mesh.normals.assign(4, glm::normalize(glm::cross(along, up)));
  named.mesh.uvs.assign(4, glm::vec2(0.0f));
  return named;
}

facades::NamedMesh front_of(const StreetFront& front) {
  return rectangle(hidden_surface, front.point(0, 0, front.low_m), front.width_m * front.frame.along,
                   {0, 0, front.high_m - front.low_m});
}
facades::NamedMesh board_before(const StreetFront& front) {
  const glm::vec3 middle = front.middle(0.0f, board_distance_m);
  return rectangle("board",
                   middle - 0.5f * board_width_m * front.frame.along - glm::vec3(0, 0, 0.5f * board_height_m),
                   board_width_m * front.frame.along, {0, 0, board_height_m});
}

/// Of a plain colour; it casts no shadow, so that the truth is what it hides.
scene::Object board_object(const facades::NamedMesh& board) {
  auto model = std::make_shared<scene::Model>();
  scene::Material material;
  material.base_colour = glm::vec3(0.5f, 0.1f, 0.05f), material.is_double_sided = true;
  model->materials.push_back(material);
  scene::Part part;
  part.mesh = board.mesh, part.casts_shadow = false;
  model->parts.push_back(std::move(part));
  scene::Object object;
  object.name = board.name, object.model = model;
  return object;
}

scene::Scene city_scene() {
  scene::Scene scene;
  scene::Object object;
  object.name = "city", object.model = std::make_shared<scene::Model>(city::make_city_model(seed));
  scene.objects.push_back(std::move(object));
  scene.sun.direction_to_sun = city::to_sun();
  scene.sky.picture = shading::without_sun(city::sky_picture(256, city::to_sun(), seed));
  return scene;
}

Camera camera_before(const StreetFront& front, int step) {
  Camera camera;
  const glm::vec3 eye = front.middle(camera_step_m * float(step), camera_distance_m);
  camera.world_from_camera = look_at(eye, front.middle(0.0f, 0.0f));
  camera.vertical_fov = field_of_view;
  return camera;
}

Image8 traced(const scene::Scene& scene, const Camera& camera) {
  const reference::RayScene rays(scene);
  reference::TraceOptions options;
  options.samples_per_pixel = 4;
  const shading::SkyLight sky = shading::make_sky_light(scene.sky.picture, 1.0f, 0.0f);
  return shading::tone_mapped_picture(
      reference::trace_picture(rays, scene, sky, camera, width, height, options).radiance, scene.exposure);
}

Result<PhotographedHouse> photographed(const StreetFront& front, const std::filesystem::path& folder,
                                       const std::string& name, scene::Scene& city) {
  PhotographedHouse house;
  house.meshes = {front_of(front), board_before(front)};
  for (int step = -cameras_each_way; step <= cameras_each_way; ++step) {
    const Camera camera = camera_before(front, step);
    house.truths.push_back(traced(city, camera));
    city.objects.push_back(board_object(house.meshes.back()));
    const Image8 picture = traced(city, camera);
    city.objects.pop_back();
    photographs::Photograph photo = photographs::photograph_of(
        camera, fmt::format("{}_{}.png", name, house.photographs.size()), width, height);
    photo.file = folder / photo.name;
    if (Status status = write_image(photo.file, picture); !status) return status.errors();
    house.photographs.push_back(std::move(photo));
  }
  return house;
}

}  // namespace

Result<std::vector<PhotographedHouse>> photographed_houses(std::size_t count,
                                                           const std::filesystem::path& folder) {
  scene::Scene city = city_scene();
  const city::StreetPlan plan = city::make_street_plan(seed);
  std::vector<PhotographedHouse> houses;
  for (const city::Building& building : city::plan_buildings(plan, seed)) {
    if (houses.size() == count) break;
    if (building.faces.size() != 1 || !building.plot.has_left_neighbour) continue;
    const city::Face& face = building.faces[0];
    const StreetFront front{face.frame, face.width_m, building.ground_m, building.eaves_m()};
    Result<PhotographedHouse> house =
        photographed(front, folder, fmt::format("house_{}", houses.size()), city);
    if (!house) return house.errors();
    houses.push_back(*std::move(house));
  }
  if (houses.size() < count) return error("the city has only {} houses of one street front", houses.size());
  return houses;
}

}  // namespace parvis::bench
