// The planner's tool in the paper's city: what an insertion and a drag take and show, how exactly things
// stand, undo, replay and kills.
#include <epoxy/gl.h>

#include <cmath>

#include "bench/own_program.h"
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

constexpr const char* two_designs = R"(
include(file="paper.xp")
design(name="stone") {
  placed(kind=bench_stone, name=stone_1, position="9 3 0", heading_deg=180)
  placed(kind=bench_stone, name=stone_2, position="12 3 0", heading_deg=180)
  placed(kind=bench_stone, name=stone_3, position="15 3 0", heading_deg=180)
  placed(kind=umbrella, name=umbrella_1, position="10.5 4.5 0", heading_deg=0)
  placed(kind=umbrella, name=umbrella_2, position="13.5 4.5 0", heading_deg=0)
}
design(name="trees", visible=0) {
  placed(kind=tree_orange, name=orange_1, position="10 4 0", heading_deg=0)
  placed(kind=tree_orange, name=orange_2, position="14 4 0", heading_deg=70)
  placed(kind=bench_wood, name=wood_1, position="12 3 0", heading_deg=180)
  placed(kind=planter, name=planter_1, position="8 4 0", heading_deg=0)
  placed(kind=lamp, name=lamp_1, position="16 4 0", heading_deg=0)
}
scenario(name="with trees") {
  override(of=stone, visible=0)
  override(of=trees, visible=1)
}
)";

/// Scenarios that show two designs, chosen on a walk whose rate the window holds: from the choice to its
/// picture.
void measure_switches(const BenchSetup& setup, Report& report) {
  must(write_file(setup.city() / "two_designs.xp", two_designs));
  const auto stage = stage_of(setup.simulation(setup.city() / "two_designs.xp"));
  int step = 0;
  const auto walk_ms = [&](bool keeps_rate) {
    const double ms = milliseconds([&] {
      stage->simulation().advance(0.1);
      stage->draw(eye_at({middle.x + 0.14 * (step++ % 40), middle.y, 0.0}), width, height);
      stage->display(0);
      glFinish();
    });
    if (keeps_rate) stage->follow_clock(ms);
    return ms;
  };
  for (const bool keeps_rate : {false, true}) {  // the resolution that a held rate leaves stays lowered
    stage->hold_rate(keeps_rate ? 15.0 : 0.0);
    for (int i = 0; i < (keeps_rate ? 40 : 3); ++i) walk_ms(keeps_rate);
    std::vector<double> switches, frames;
    for (int i = 0; i < (setup.is_quick ? 6 : 24); ++i) {
      const double choice_ms =
          milliseconds([&] { must(stage->choose_scenario(i % 2 == 0 ? "with trees" : "")); });
      switches.push_back(choice_ms + walk_ms(keeps_rate));
      for (int k = 0; k < 3; ++k) frames.push_back(walk_ms(keeps_rate));
    }
    if (!keeps_rate) {
      report.add("scenario_switch_ms_of_whole_pictures", median(switches));
    } else {
      report.add("scenario_switch_ms", median(switches));
      report.add("scenario_switch_ms_beyond_an_ordinary_one", median(switches).value - median(frames).value);
    }
  }
}

struct SceneEdge {
  glm::vec3 from, to;
};

/// Boxes of random sizes on a slab, as OBJ, and their edges.
std::vector<SceneEdge> write_boxes(const std::filesystem::path& file) {
  Random random(5);
  std::string obj;
  std::vector<SceneEdge> edges;
  int first = 1;
  for (int i = 0; i < 40; ++i) {
    const bool is_slab = i == 0;
    const glm::vec3 low = is_slab
                              ? glm::vec3(-40, -40, -1)
                              : glm::vec3(random.uniform(-18.0f, 18.0f), random.uniform(2.0f, 34.0f), 0.0f);
    const glm::vec3 size = is_slab ? glm::vec3(80, 80, 1)
                                   : glm::vec3(random.uniform(0.4f, 4.0f), random.uniform(0.4f, 4.0f),
                                               random.uniform(0.4f, 6.0f));
    const auto corner = [&](int c) { return low + size * glm::vec3(c & 1, (c >> 1) & 1, c >> 2); };
    for (int c = 0; c < 8; ++c) obj += fmt::format("v {} {} {}\n", corner(c).x, corner(c).y, corner(c).z);
    for (const auto& face :
         {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
      obj +=
          fmt::format("f {} {} {} {}\n", first + face[0], first + face[1], first + face[2], first + face[3]);
    first += 8;
    for (int axis = 0; axis < 3; ++axis)
      for (int c = 0; c < 8; ++c)
        if ((c >> axis & 1) == 0) edges.push_back({corner(c), corner(c | 1 << axis)});
  }
  must(write_file(file, obj));
  return edges;
}

/// How far ink lies from edges that the eye sees, by the ray tracer, and which of these have no ink.
void compare_lines(const BenchSetup& setup, Report& report) {
  const std::vector<SceneEdge> edges = write_boxes(setup.folder / "boxes.obj");
  const std::filesystem::path script = setup.folder / "boxes.xp";
  must(write_file(script, "dayLight()\nmodel(name=boxes, file=\"boxes.obj\", up=z)\nrealism(level=0)\n"));
  const auto stage = stage_of(setup.simulation(script));
  design::SceneSurfaces surfaces{stage->scene()};
  double largest_px = 0.0, largest_aside_px = 0.0;
  long seen = 0, missing = 0;
  for (const glm::vec3 eye : {glm::vec3(0, -6, 1.7f), glm::vec3(-16, -4, 8), glm::vec3(14, -5, 3)}) {
    Camera camera;
    camera.world_from_camera = look_at(eye, {0, 16, 1});
    stage->draw(camera, width, height);
    const Image8 sketch = stage->picture();
    const glm::mat4 clip = camera.clip_from_camera(float(width) / float(height)) * camera.camera_from_world();
    std::vector<glm::vec2> shown, aside;
    for (const SceneEdge& edge : edges) {
      const int steps = int(glm::distance(edge.from, edge.to) / 0.001f);
      for (int i = 0; i <= steps; ++i) {
        const glm::vec3 place = glm::mix(edge.from, edge.to, float(i) / float(steps));
        const auto pixel_of = [&](glm::vec3 p) {
          const glm::vec4 c = clip * glm::vec4(p, 1.0f);
          return c.w > 0.1f ? (glm::vec2(c.x, -c.y) / c.w * 0.5f + 0.5f) * glm::vec2(width, height)
                            : glm::vec2(-1e6f);
        };
        const glm::vec2 pixel = pixel_of(place);
        if (pixel.x < -9 || pixel.y < -9 || pixel.x > width + 9 || pixel.y > height + 9) continue;
        if (!shown.empty() && glm::distance(shown.back(), pixel) < 0.25f) continue;
        const auto hit = surfaces.first_along({eye, glm::normalize(place - eye)});
        if (hit && glm::distance(eye, glm::vec3(hit->position)) < glm::distance(eye, place) - 0.02f) continue;
        shown.push_back(pixel), aside.push_back(pixel_of(place + glm::vec3(0.05f, 0.0f, 0.05f)));
      }
    }
    const auto is_ink = [&](int x, int y, int level) { return sketch.at(x, y)[0] < level; };
    const auto nearest_px = [&](const std::vector<glm::vec2>& points, glm::vec2 at) {
      float nearest = 1e9f;
      for (const glm::vec2 point : points) nearest = std::min(nearest, glm::distance(point, at));
      return double(nearest);
    };
    for (int y = 2; y < height - 2; ++y)
      for (int x = 2; x < width - 2; ++x)
        if (is_ink(x, y, 110)) {  // most of the pixel
          const glm::vec2 at(float(x) + 0.5f, float(y) + 0.5f);
          largest_px = std::max(largest_px, nearest_px(shown, at));
          largest_aside_px = std::max(largest_aside_px, nearest_px(aside, at));
        }
    for (const glm::vec2 point : shown) {
      if (point.x < 2 || point.y < 2 || point.x > width - 3 || point.y > height - 3) continue;
      bool has_ink = false;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) has_ink |= is_ink(int(point.x) + dx, int(point.y) + dy, 150);
      ++seen, missing += !has_ink;
    }
  }
  report.add("sketch_edge_px", largest_px);
  report.add("sketch_edge_px_of_boxes_5_cm_aside", largest_aside_px);
  report.add("sketch_edges_without_ink_percent", 100.0 * double(missing) / double(std::max(seen, 1L)));
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
    const int acknowledged = acknowledged_before_kill(1 + moments.index(200), [&](const auto& acknowledge) {
      stage::Simulation simulation = setup.simulation(script);
      Table table{simulation};
      if (!table.session.keep_journal(journal)) return;
      for (int i = 0; table.session.run(fmt::format("insert bin {},{}", i % 100, i / 100)); ++i)
        if (!acknowledge()) return;
    });
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
  measure_switches(setup, report);
}

void measure_sketch(const BenchSetup& setup, Report& report) { compare_lines(setup, report); }

void measure_plan_files(const BenchSetup& setup, Report& report) {
  measure_replay(setup, report);
  measure_kills(setup, report);
}

}  // namespace parvis::bench
