#include "places/kitchen/kitchen.h"

#include "base/files.h"
#include "base/image_io.h"
#include "formats/gltf/gltf_writer.h"
#include "places/kitchen/kitchen_glass.h"
#include "places/kitchen/kitchen_light.h"
#include "places/kitchen/kitchen_materials.h"
#include "places/kitchen/kitchen_mirrors.h"
#include "places/kitchen/kitchen_room.h"
#include "places/kitchen/kitchen_script.h"
#include "places/kitchen/kitchen_things.h"
#include "synthesis/writing_jobs.h"

namespace parvis::kitchen {
namespace {
namespace fs = std::filesystem;

constexpr int light_width_px = 512;

}  // namespace

scene::Model make_kitchen(std::uint64_t seed) {
  scene::Model model;
  model.name = "kitchen";
  add_kitchen_materials(model, seed);
  add_room(model);
  add_fruit(model);
  add_crockery(model);
  for (const KitchenMirror& mirror : kitchen_mirrors())
    if (mirror.shade_m > 0.0f) add_shade(model, mirror.foot, mirror.shade_m);
  return model;
}

Status write_kitchen(const fs::path& folder, std::uint64_t seed) {
  std::vector<synthesis::WritingJob> jobs;
  jobs.push_back(
      [=](const fs::path& to) { return scene::write_gltf(to / "kitchen.glb", make_kitchen(seed)); });
  jobs.push_back(
      [](const fs::path& to) { return write_image(to / "light.hdr", room_light_picture(light_width_px)); });
  std::vector<KitchenMirror> mirrors = kitchen_mirrors();
  jobs.push_back([script = kitchen_script(mirrors)](const fs::path& to) {
    return write_file(to / "kitchen.xp", script);
  });
  std::vector<KitchenMirror> glass = kitchen_glass();
  jobs.push_back([script = kitchen_glass_script(mirrors, glass)](const fs::path& to) {
    return write_file(to / "glass.xp", script);
  });
  mirrors.insert(mirrors.end(), std::make_move_iterator(glass.begin()), std::make_move_iterator(glass.end()));
  for (KitchenMirror& mirror : mirrors)
    jobs.push_back([model = std::move(mirror.model)](const fs::path& to) {
      return scene::write_gltf(to / (model.name + ".glb"), model);
    });
  return synthesis::write_together(jobs, folder);
}

}  // namespace parvis::kitchen
