// The planner's tool in the paper's city: what an insertion and a drag take and show, how exactly things
// stand, undo, replay and kills.
#include <epoxy/gl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>

#include "bench/parts.h"
#include "planning/design/preview.h"
#include "planning/design/scene_surfaces.h"
#include "planning/design/test_random_commands.h"

namespace parvis::bench {
namespace {

constexpr int width = 1280, height = 720;
constexpr glm::dvec2 middle(12.4, 3.05);

/// A session on a running scene that outlives it.
struct Table {
  stage::Simulation& simulation;
  design::SceneSurfaces surfaces{simulation.scene};
  design::Session session = must(design::Session::open(
      simulation.scene, simulation.live(), "",
      [this](glm::dvec2 at, const design::Names& without) { return surfaces.resting_height(at, without); }));
};

Camera eye_at(glm::dvec3 place) {
  Camera camera;
  camera.world_from_camera =
      look_at(glm::vec3(place) + glm::vec3(-5, -7, 1.7f), glm::vec3(place) + glm::vec3(0, 0, 0.5f));
  return camera;
}

/// A mask of the pixels in which the picks of an object alone differ from the rest.
Image8 mask_of(stage::Stage& stage, const Camera& camera, int object) {
  const render::ObjectPicture picked = stage.renderer().pick(camera, width, height, false);
  Image8 mask(width, height, 1);
  for (std::size_t i = 0; i < mask.pixels.size(); ++i)
    mask.pixels[i] = picked.pixels[i] == std::uint32_t(object + 1) ? 255 : 0;
  return mask;
}

int object_named(const scene::Scene& scene, const std::string& name) {
  const auto found = std::ranges::find(scene.objects, name, &scene::Object::name);
  if (found == scene.objects.end()) fail("nothing is called {}", name);
  return int(found - scene.objects.begin());
}

/// Drags a bench about a place of the street, its picture drawn whole before and after.
void measure_drag(stage::Stage& stage, Table& table, bool is_quick, Report& report) {
  const int repetitions = is_quick ? 12 : 50;
  const design::Kind* const kind = design::find_kind(stage.scene(), "bench_stone");
  if (!kind) fail("the catalogue has no stone bench");
  const double ground = table.surfaces.resting_height(middle);
  const Camera camera = eye_at({middle, ground});
  design::Preview preview(stage.scene(), table.simulation.live());
  const auto hold_at = [&](glm::dvec2 at) {
    const design::Command insert = design::Insert{"bench_stone", glm::dvec3(at, design::rests)};
    must(preview.show(must(design::changes_of(table.session.view(), insert)), table.session.design()));
    stage.draw_held(camera, width, height, preview.what_stays(), preview.scene());
    stage.display(0);
    glFinish();
  };
  for (int i = 0; i < 3; ++i) hold_at(middle);  // the picture below is drawn and kept
  std::vector<double> drags_ms;
  for (int i = 0; i < repetitions; ++i)
    drags_ms.push_back(milliseconds([&] { hold_at(middle + 0.02 * glm::dvec2(i, i % 5)); }));
  const Median drag = median(drags_ms);
  report.add("drag_fps", Median{1e3 / drag.value, 1e3 / drag.high, 1e3 / drag.low});
  const double whole_ms =
      milliseconds([&] { stage.draw(camera, width, height), stage.display(0), glFinish(); });
  report.add("drag_fps_of_whole_pictures", 1e3 / whole_ms);
  for (int i = 0; i < 3; ++i) hold_at(middle);
  const Image8 held = stage.picture();
  hold_at(middle + glm::dvec2(0.03, 0.0));
  const Image8 beside = stage.picture();
  must(
      table.session.run(fmt::format("insert bench_stone {},{} name bench_of_the_bench", middle.x, middle.y)));
  must(stage.simulation().live().refresh(stage.simulation().scene).empty()
           ? Status(Ok{})
           : Status(error("it cannot be built")));
  stage.draw(camera, width, height);
  const Image8 whole = stage.whole_picture();
  const Image8 mask = mask_of(stage, camera, object_named(stage.scene(), "bench_of_the_bench"));
  report.add("drag_picture_flip", flip_between(held, whole, mask));
  report.add("drag_picture_flip_3_cm_beside", flip_between(beside, whole, mask));
}

void measure_insertion(stage::Stage& stage, Table& table, bool is_quick, Report& report) {
  const Camera camera = eye_at({middle, table.surfaces.resting_height(middle)});
  design::Preview preview(stage.scene(), table.simulation.live());
  std::vector<double> held_ms, whole_ms;
  for (int i = 0; i < (is_quick ? 8 : 50); ++i) {
    const std::string name = fmt::format("bollard_{}_of_the_bench", i);
    // As the window does: what was placed is shown over the picture that is kept; its shadow follows.
    const auto show = [&] {
      const scene::Node* node = stage.simulation().live().find(name);
      must(preview.show(node ? design::Changes{{*node, *node, {}}} : design::Changes{},
                        table.session.design()));
      stage.draw_held(camera, width, height, preview.what_stays(), preview.scene());
      stage.display(0);
      glFinish();
    };
    for (int k = 0; k < 3; ++k) show();
    const glm::dvec2 at = middle + glm::dvec2(0.3 * (i % 10), 1.0 + 0.3 * (i / 10));
    held_ms.push_back(milliseconds([&] {
      must(table.session.run(fmt::format("insert bollard {},{} name {}", at.x, at.y, name)));
      show();
    }));
    if (i % 4 == 0)
      whole_ms.push_back(
          milliseconds([&] { stage.draw(camera, width, height), stage.display(0), glFinish(); }));
  }
  report.add("insert_to_picture_ms", median(held_ms));
  report.add("insert_to_whole_picture_ms", median(whole_ms));
}

/// Where the sides of a bollard are, by rays from four directions at half its height, against what was typed.
void measure_precision(Table& table, Report& report) {
  double largest_mm = 0.0, rounded_mm = 0.0;
  Random random(11);
  for (int i = 0; i < 40; ++i) {
    const glm::dvec2 typed(std::round(1e4 * random.uniform(-40.0f, 40.0f)) * 1e-4,
                           std::round(1e4 * random.uniform(-40.0f, 40.0f)) * 1e-4);
    const std::string name = fmt::format("bollard_{}_typed", i);
    if (!table.session.run(fmt::format("insert bollard {:.4f},{:.4f},40 name {}", typed.x, typed.y, name)))
      continue;
    const auto side = [&](glm::dvec2 from) {
      const glm::vec3 direction(glm::normalize(-from), 0.0f);
      const auto hit = table.surfaces.first_along({glm::vec3(typed + from, 40.3f), direction});
      if (!hit) fail("no ray hits {}", name);
      return glm::dvec2(hit->position);
    };
    const glm::dvec2 found(0.5 * (side({2, 0}).x + side({-2, 0}).x),
                           0.5 * (side({0, 2}).y + side({0, -2}).y));
    largest_mm = std::max(largest_mm, 1e3 * glm::distance(found, typed));
    rounded_mm = std::max(rounded_mm, 1e3 * glm::distance(found, glm::round(typed * 1e2) * 1e-2));
  }
  report.add("plan_precision_mm", largest_mm);
  report.add("plan_precision_mm_to_the_centimetre", rounded_mm);
}

/// Undone to nothing, done again, and replayed from the journal: the same scripts.
void measure_replay(const BenchSetup& setup, Report& report) {
  const std::filesystem::path script = setup.folder / "replay.xp", journal = setup.folder / "replay.journal";
  must(write_file(script, "camera(name=eye)\n"));
  stage::Simulation simulation = setup.simulation(script);
  Table table{simulation};
  must(table.session.keep_journal(journal));
  const std::string empty = table.session.script();
  Random random(7);
  for (int i = 0; i < (setup.is_quick ? 1'000 : 10'000); ++i)
    static_cast<void>(table.session.run(design::random_command(random, table.session)).ok());
  const std::string made = table.session.script();
  int steps = 0;
  while (table.session.undo()) ++steps;
  const bool is_undone = table.session.script() == empty;
  for (int i = 0; i < steps; ++i) must(table.session.redo());
  const bool is_redone = table.session.script() == made;
  stage::Simulation again = setup.simulation(script);
  Table other{again};
  must(other.session.keep_journal(journal));
  const bool is_replayed = other.session.script() == made;
  report.add("undo_replay_identical", is_undone && is_redone && is_replayed ? 1.0 : 0.0);
  must(other.session.undo());
  report.add("undo_replay_identical_of_one_step_less", other.session.script() == made ? 1.0 : 0.0);
}

/// Commands that had returned when the program was killed, and that are not there when it is opened again.
void measure_kills(const BenchSetup& setup, Report& report) {
  const std::filesystem::path script = setup.folder / "kills.xp", journal = setup.folder / "kills.journal";
  must(write_file(script, "camera(name=eye)\n"));
  Random moments(3);
  int lost = 0, lost_without_journal = 0;
  for (int kills = 0; kills < (setup.is_quick ? 20 : 200); ++kills) {
    std::filesystem::remove(journal);
    int pipes[2];
    if (pipe(pipes) != 0) fail("no pipe can be made");
    const pid_t child = fork();
    if (child == 0) {
      stage::Simulation simulation = setup.simulation(script);
      Table table{simulation};
      if (!table.session.keep_journal(journal)) _exit(1);
      for (int i = 0;; ++i)
        if (!table.session.run(fmt::format("insert bin {},{}", i % 100, i / 100)) ||
            write(pipes[1], "x", 1) != 1)
          _exit(1);
    }
    close(pipes[1]);
    const int wanted = 1 + moments.index(200);
    int acknowledged = 0;
    char byte = 0;
    while (acknowledged < wanted && read(pipes[0], &byte, 1) == 1) ++acknowledged;
    kill(child, SIGKILL);
    while (read(pipes[0], &byte, 1) == 1) ++acknowledged;
    close(pipes[0]);
    waitpid(child, nullptr, 0);
    stage::Simulation simulation = setup.simulation(script);
    Table table{simulation};
    lost_without_journal += acknowledged - int(table.session.objects().size());
    must(table.session.keep_journal(journal));
    lost += std::max(0, acknowledged - int(table.session.objects().size()));
  }
  report.add("kill_loses_commands", lost);
  report.add("kill_loses_commands_without_journal", lost_without_journal);
}

}  // namespace

void measure_plan(const BenchSetup& setup, Report& report) {
  const std::unique_ptr<stage::Stage> stage = stage_of(setup.simulation(setup.city() / "paper.xp"));
  Table table{stage->simulation()};
  measure_drag(*stage, table, setup.is_quick, report);
  measure_insertion(*stage, table, setup.is_quick, report);
  measure_precision(table, report);
}

void measure_plan_files(const BenchSetup& setup, Report& report) {
  measure_replay(setup, report);
  measure_kills(setup, report);
}

}  // namespace parvis::bench
