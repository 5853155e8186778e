#include "places/paper_city/paper_city.h"

#include <array>
#include <string>
#include <vector>

#include "base/files.h"
#include "base/image_io.h"
#include "formats/gltf/gltf_writer.h"
#include "places/paper_city/car.h"
#include "places/paper_city/city_buildings.h"
#include "places/paper_city/figure_script.h"
#include "places/paper_city/ground.h"
#include "places/paper_city/mirror_bodies.h"
#include "places/paper_city/night_lights.h"
#include "places/paper_city/paper_script.h"
#include "places/paper_city/street_furniture.h"
#include "places/paper_city/walker.h"
#include "synthesis/sky_picture.h"
#include "synthesis/tree.h"
#include "synthesis/writing_jobs.h"

namespace parvis::city {
namespace {
namespace fs = std::filesystem;
using scene::write_gltf;

constexpr int sky_width_px = 2048;

/// Everything that is written, as jobs that do not depend on each other, the longest first.
std::vector<synthesis::WritingJob> writing_jobs(std::uint64_t seed) {
  std::vector<synthesis::WritingJob> jobs;
  jobs.push_back(
      [=](const fs::path& folder) { return write_gltf(folder / "city.glb", make_city_model(seed)); });
  jobs.push_back([=](const fs::path& folder) {
    return write_image(folder / "sky.hdr", synthesis::sky_picture(sky_width_px, to_sun(), seed));
  });
  for (int species = 0; species < tree_species; ++species)
    jobs.push_back([=](const fs::path& folder) {
      const scene::Model tree = synthesis::make_tree(species, seed);
      return write_gltf(folder / (tree.name + ".glb"), tree);
    });
  std::vector<std::string> vehicle_files, parking_files;
  for (scene::Model& car : city_cars()) {
    vehicle_files.push_back(car.name + ".glb");
    if (!car.name.starts_with("bus")) parking_files.push_back(vehicle_files.back());
    jobs.push_back([car = std::move(car)](const fs::path& folder) {
      return write_gltf(folder / (car.name + ".glb"), car);
    });
  }
  std::vector<std::string> walker_files;
  for (scene::Model& walker : city_walkers()) {
    walker_files.push_back(walker.name + ".glb");
    jobs.push_back([walker = std::move(walker)](const fs::path& folder) {
      return write_gltf(folder / (walker.name + ".glb"), walker);
    });
  }
  for (scene::Model& body : std::array{make_ball(), make_whale()})
    jobs.push_back([body = std::move(body)](const fs::path& folder) {
      return write_gltf(folder / (body.name + ".glb"), body);
    });
  jobs.push_back(
      [=](const fs::path& folder) { return write_file(folder / "people.xp", people_script(walker_files)); });
  jobs.push_back(
      [=](const fs::path& folder) { return write_gltf(folder / "lit_windows.glb", make_lit_windows(seed)); });
  jobs.push_back(
      [](const fs::path& folder) { return write_gltf(folder / "street_lamp.glb", make_street_lamp()); });
  jobs.push_back([=](const fs::path& folder) { return write_file(folder / "night.xp", night_script(seed)); });
  jobs.push_back([](const fs::path& folder) { return write_file(folder / "figures.xp", figure_script()); });
  jobs.push_back(
      [=](const fs::path& folder) { return write_file(folder / "paper_day.xp", day_script(parking_files)); });
  jobs.push_back([=](const fs::path& folder) {
    return write_file(folder / "paper.xp", paper_script(vehicle_files, seed));
  });
  return jobs;
}

}  // namespace

scene::Model make_city_model(std::uint64_t seed) {
  const StreetPlan plan = make_street_plan(seed);
  CityMesh mesh;
  add_buildings(mesh, plan, seed);
  add_ground(mesh, plan);
  scene::Model model;
  model.name = "city";
  add_city_materials(model, seed);
  mesh.move_into(model);
  return model;
}

Status write_paper_city(const fs::path& folder, std::uint64_t seed) {
  return synthesis::write_together(writing_jobs(seed), folder);
}

}  // namespace parvis::city
