#include "city/paper_city.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "base/files.h"
#include "base/image_io.h"
#include "base/parallel.h"
#include "city/car.h"
#include "city/city_buildings.h"
#include "city/figure_script.h"
#include "city/ground.h"
#include "city/mirror_bodies.h"
#include "city/paper_script.h"
#include "city/sky_picture.h"
#include "city/street_furniture.h"
#include "city/tree.h"
#include "city/walker.h"
#include "scene/gltf_writer.h"

namespace parvis::city {
namespace {
namespace fs = std::filesystem;
using scene::write_gltf;

constexpr int sky_width_px = 2048;

using Job = std::function<Status(const fs::path& folder)>;

/// Everything that is written, as jobs that do not depend on each other, the longest first.
std::vector<Job> writing_jobs(std::uint64_t seed) {
  std::vector<Job> jobs;
  jobs.push_back(
      [=](const fs::path& folder) { return write_gltf(folder / "city.glb", make_city_model(seed)); });
  jobs.push_back([=](const fs::path& folder) {
    return write_image(folder / "sky.hdr", sky_picture(sky_width_px, to_sun(), seed));
  });
  for (int species = 0; species < tree_species; ++species)
    jobs.push_back([=](const fs::path& folder) {
      const scene::Model tree = make_tree(species, seed);
      return write_gltf(folder / (tree.name + ".glb"), tree);
    });
  std::vector<std::string> vehicle_files;
  for (scene::Model& car : city_cars()) {
    vehicle_files.push_back(car.name + ".glb");
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
  jobs.push_back([](const fs::path& folder) { return write_file(folder / "figures.xp", figure_script()); });
  jobs.push_back([=](const fs::path& folder) {
    return write_file(folder / "paper.xp", paper_script(vehicle_files, seed));
  });
  return jobs;
}

Status run_all(const std::vector<Job>& jobs, const fs::path& folder) {
  std::vector<Errors> failures(jobs.size());
  parallel_for(jobs.size(), [&](std::size_t i) {
    const Status status = jobs[i](folder);
    if (!status) failures[i] = status.errors();
  });
  Errors all;
  for (const Errors& some : failures) all.insert(all.end(), some.begin(), some.end());
  if (!all.empty()) return all;
  return Done{};
}

Status make_folder(const fs::path& folder) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (code || !fs::is_directory(folder, code))
    return error("{}: the folder cannot be made ({}); choose one that can be written", folder.string(),
                 code.message());
  return Done{};
}

/// Moves every file of `from` into `to`, over files of the same name.
Status move_files(const fs::path& from, const fs::path& to) {
  std::error_code code;
  for (const fs::directory_entry& entry : fs::directory_iterator(from, code)) {
    fs::rename(entry.path(), to / entry.path().filename(), code);
    if (code)
      return error("{}: cannot be written ({})", (to / entry.path().filename()).string(), code.message());
  }
  return Done{};
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
  std::error_code code;
  const bool is_new = !fs::exists(folder, code);
  const fs::path unfinished = folder / ".unfinished";
  Status status = make_folder(unfinished);
  if (status) status = run_all(writing_jobs(seed), unfinished);
  if (status) status = move_files(unfinished, folder);
  fs::remove_all(unfinished, code);
  if (!status && is_new) fs::remove(folder, code);
  return status;
}

}  // namespace parvis::city
