#include "graphics/light/bench/lit_object_bench.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "base/files.h"
#include "base/random.h"
#include "bench/scratch_folder.h"
#include "formats/gltf/gltf_writer.h"
#include "house/stage/stage.h"
#include "places/paper_city/paper_city.h"
#include "scene/data/vertex_irradiance.h"

namespace parvis::bench {
namespace {

constexpr const char* crown_name = "crown";
constexpr double frame_s = 1.0 / 30.0;
// From the middle of the crossing to under a street's trees and beside a facade.
constexpr glm::vec3 before_m{0.0f, 0.0f, 0.0f}, after_m{6.0f, 20.0f, 0.0f};

/// 2,500 leaves of four vertices about a point six metres up, four metres across.
scene::Model crown() {
  constexpr int leaves = 2500;
  constexpr float radius_m = 2.0f, leaf_m = 0.12f;
  scene::Model model;
  scene::Part part;
  Random random(9);
  const auto any = [&] {
    const float x = random.uniform(-1.0f, 1.0f), y = random.uniform(-1.0f, 1.0f);
    return glm::vec3(x, y, random.uniform(-1.0f, 1.0f));
  };
  for (int leaf = 0; leaf < leaves; ++leaf) {
    const glm::vec3 middle = glm::vec3(0.0f, 0.0f, 6.0f) + radius_m * any();
    const glm::vec3 normal = glm::normalize(any() + 1e-4f);
    const glm::vec3 right = glm::normalize(
        glm::cross(normal, std::abs(normal.z) < 0.9f ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0)));
    const glm::vec3 up = glm::cross(normal, right);
    const auto first = std::uint32_t(part.mesh.positions.size());
    for (const glm::vec2 corner : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
      part.mesh.positions.push_back(middle + leaf_m * (corner.x * right + corner.y * up));
      part.mesh.normals.push_back(normal);
      part.mesh.uvs.emplace_back(0.5f * corner + 0.5f);
    }
    for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) part.mesh.indices.push_back(first + corner);
  }
  model.parts.push_back(std::move(part));
  model.materials.emplace_back();
  return model;
}

/// The city with the crown.
Result<house::Play> open_city(const BenchSetup& setup, const ScratchFolder& folder, const char* how_lit) {
  const auto script = folder.path / "lit.xp";
  const std::string text = fmt::format(
      "include(file=\"paper_day.xp\")\nlitVirtualObject({}) {{ object(name=\"{}\", file=\"crown.glb\", "
      "grab=1) }}\n",
      how_lit, crown_name);
  if (Status status = write_file(script, text); !status) return status.errors();
  return house::open_play(setup.house, script, {});
}

Result<std::size_t> crown_of(const house::Play& play) {
  for (std::size_t o = 0; o < play.scene.objects.size(); ++o)
    if (play.scene.objects[o].name == crown_name) return o;
  return error("the scene has no object \"{}\"", crown_name);
}

std::vector<glm::vec3> light_of(const house::Play& play, std::size_t object) {
  std::vector<glm::vec3> all;
  for (const auto& part : play.scene.data<scene::VertexIrradiance>().of(object)->parts)
    all.insert(all.end(), part.front.begin(), part.front.end());
  return all;
}

void move(house::Play& play, std::size_t object, glm::vec3 to) {
  play.scene.objects[object].world_from_model = glm::translate(glm::mat4(1.0f), to);
}

double rmse_percent(const std::vector<glm::vec3>& shown, const std::vector<glm::vec3>& truth) {
  double off = 0.0, mean = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double difference = double(shown[i].y - truth[i].y);
    off += difference * difference, mean += double(truth[i].y);
  }
  return 100.0 * std::sqrt(off * double(truth.size())) / mean;
}

}  // namespace

Status measure_lit_object(const BenchSetup& setup, Report& report) {
  constexpr int max_frames = 300;
  const ScratchFolder folder;
  if (Status written = city::write_paper_city(folder.path, 1); !written) return written.errors();
  if (Status written = scene::write_gltf(folder.path / "crown.glb", crown()); !written)
    return written.errors();
  auto shipped = open_city(setup, folder, "");
  if (!shipped) return shipped.errors();
  auto exact = open_city(setup, folder, "rays=4096, budget_ms=0");
  if (!exact) return exact.errors();
  const Result<std::size_t> object = crown_of(*shipped);
  if (!object) return object.errors();

  for (house::Play* play : {&*shipped, &*exact}) {
    move(*play, *object, before_m);
    play->advance(frame_s);
    play->settle();
  }
  const std::vector<glm::vec3> old = light_of(*shipped, *object);
  for (house::Play* play : {&*shipped, &*exact}) move(*play, *object, after_m);
  exact->advance(frame_s);
  const std::vector<glm::vec3> truth = light_of(*exact, *object);

  const double first_ms = milliseconds([&] { shipped->advance(frame_s); });
  const double first = rmse_percent(light_of(*shipped, *object), truth);
  std::vector<double> refining_ms;
  int frames = 1;
  double off = first;
  for (; frames < max_frames && off > 2.0; ++frames) {
    refining_ms.push_back(milliseconds([&] { shipped->advance(frame_s); }));
    off = rmse_percent(light_of(*shipped, *object), truth);
  }
  report.add("relight_shipped_first_frame_rmse_percent", first);
  report.add_control("relight_shipped_old_light_rmse_percent", rmse_percent(old, truth), up_to(2.0));
  report.add("relight_shipped_first_frame_ms", first_ms);
  report.add("relight_shipped_later_frame_ms", median(refining_ms).value);
  report.add("relight_shipped_frames_to_2_percent", frames);
  report.add("relight_shipped_last_rmse_percent", off, up_to(2.0));
  report.note(
      fmt::format("{} vertices; the first frame after a jump shows light without rays to the sky; "
                  "control: the light of the old place; against 4,096 rays per vertex",
                  truth.size()));
  return Done{};
}

}  // namespace parvis::bench
