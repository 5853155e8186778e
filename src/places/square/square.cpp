#include "places/square/square.h"

#include <string>
#include <vector>

#include "base/files.h"
#include "base/image_io.h"
#include "formats/gltf/gltf_writer.h"
#include "places/paper_city/car.h"
#include "places/paper_city/night_lights.h"
#include "places/paper_city/paper_script.h"
#include "places/square/coarse_square.h"
#include "places/square/fountain.h"
#include "places/square/houses.h"
#include "places/square/square_ground.h"
#include "places/square/square_script.h"
#include "synthesis/sky_picture.h"
#include "synthesis/writing_jobs.h"

namespace parvis::square {
namespace {
namespace fs = std::filesystem;

constexpr int sky_width_px = 2048;

}  // namespace

scene::Model make_square(std::uint64_t seed) {
  scene::Model model;
  model.name = model.nodes[0].name = "square";
  ReliefMesh mesh;
  add_houses(mesh, plan_houses(seed), seed);
  add_square_ground(mesh);
  add_square_materials(model, seed);
  mesh.move_into(model);
  return model;
}

Status write_square(const fs::path& folder, std::uint64_t seed) {
  std::vector<synthesis::WritingJob> jobs;
  jobs.push_back([=](const fs::path& to) { return scene::write_gltf(to / "square.glb", make_square(seed)); });
  jobs.push_back([=](const fs::path& to) {
    return write_image(to / "sky.hdr", synthesis::sky_picture(sky_width_px, city::to_sun(), seed));
  });
  jobs.push_back([](const fs::path& to) { return scene::write_gltf(to / "fountain.glb", make_fountain()); });
  jobs.push_back(
      [](const fs::path& to) { return scene::write_gltf(to / "street_lamp.glb", city::make_street_lamp()); });
  std::vector<std::string> vehicle_files;
  for (scene::Model& car : city::city_cars()) {
    if (car.name.starts_with("bus")) continue;
    vehicle_files.push_back(car.name + ".glb");
    jobs.push_back([car = std::move(car)](const fs::path& to) {
      return scene::write_gltf(to / (car.name + ".glb"), car);
    });
  }
  jobs.push_back(
      [=](const fs::path& to) { return scene::write_gltf(to / "coarse.glb", make_coarse_square(seed)); });
  jobs.push_back([](const fs::path& to) { return write_file(to / "photographs.xp", photographs_script()); });
  jobs.push_back([](const fs::path& to) { return write_file(to / "place.xp", place_script()); });
  jobs.push_back([](const fs::path& to) { return write_file(to / "light.xp", light_script()); });
  jobs.push_back([=](const fs::path& to) { return write_file(to / "life.xp", life_script(vehicle_files)); });
  jobs.push_back([](const fs::path& to) { return write_file(to / "square.xp", square_script()); });
  return synthesis::write_together(jobs, folder);
}

}  // namespace parvis::square
