// The planner's tool in the paper's city: what an insertion and a drag take and show, how exactly things
// stand, undo, replay and kills.
#include <epoxy/gl.h>

#include <cmath>
#include <glm/gtc/type_ptr.hpp>

#include "base/test_data.h"
#include "bench/own_program.h"
#include "bench/parts.h"
#include "life/vegetation/scene_plant.h"
#include "planning/design/preview.h"
#include "planning/design/scene_surfaces.h"
#include "planning/design/test_random_commands.h"

namespace parvis::bench {
namespace {

constexpr int width = 1280, height = 720;
constexpr double window_rate = 15.0;  // which a window holds on a software renderer
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

/// Draws a frame of a walk, 14 cm on, and lets the stage hold its rate.
double walk_ms(stage::Stage& stage, glm::dvec3 from, int step) {
  const double ms = milliseconds([&] {
    stage.simulation().advance(0.1);
    stage.draw(eye_at(from + glm::dvec3(0.14 * (step % 40), 0.0, 0.0)), width, height);
    stage.display(0);
    glFinish();
  });
  stage.follow_clock(ms);
  return ms;
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

/// Fails where two pictures are equal but for a few pixels.
void expect_change(const Image8& before, const Image8& after, const char* what) {
  constexpr int visible = 6, few = 60;  // of 255; channels
  int changed = 0;
  for (std::size_t i = 0; i < before.pixels.size(); ++i)
    changed += std::abs(int(before.pixels[i]) - int(after.pixels[i])) > visible;
  if (changed < few) fail("{} is not in its picture", what);
}

/// A place of the planner's, and what its hands took there; the slower of two places counts.
struct Hands {
  Median drag, insertion, shadow;
  double whole_fps = 0.0, whole_ms = 0.0, flip = 0.0, flip_aside = 0.0;
};

/// Drags a bench about a place after a walk there, its picture drawn whole before and after.
void measure_drag(stage::Stage& stage, Table& table, glm::dvec2 place, bool is_quick, Hands& hands) {
  const int repetitions = is_quick ? 12 : 50, walked = 10;
  const design::Kind* const kind = design::find_kind(stage.scene(), "bench_stone");
  if (!kind) fail("the catalogue has no stone bench");
  const double ground = table.surfaces.resting_height(place);
  const Camera camera = eye_at({place, ground});
  design::Preview preview(stage.scene(), table.simulation.live());
  const auto hold_at = [&](glm::dvec2 at) {
    const design::Command insert = design::Insert{"bench_stone", glm::dvec3(at, design::rests)};
    must(preview.show(must(design::changes_of(table.session.view(), insert)), table.session.design()));
    stage.draw_held(camera, width, height, preview.what_stays(), preview.scene());
    stage.display(0);
    glFinish();
  };
  stage.hold_rate(window_rate);
  for (int i = 0; i < walked; ++i) walk_ms(stage, {place, ground}, i);
  for (int i = 0; i < 3; ++i) hold_at(place);  // the picture below is drawn and kept
  std::vector<double> drags_ms;
  for (int i = 0; i < repetitions; ++i)
    drags_ms.push_back(milliseconds([&] { hold_at(place + 0.02 * glm::dvec2(i, i % 5)); }));
  const Median drag = median(drags_ms);
  hands.drag = Median{1e3 / drag.value, 1e3 / drag.high, 1e3 / drag.low};
  hold_at(place);
  const Image8 held = stage.picture();
  hold_at(place + glm::dvec2(1.5, 0.5)), hold_at(place);
  if (stage.picture().pixels != held.pixels) fail("what is dragged leaves a trail");
  stage.hold_rate(0.0);
  hands.whole_fps =
      1e3 / milliseconds([&] { stage.draw(camera, width, height), stage.display(0), glFinish(); });
  for (int i = 0; i < 3; ++i) hold_at(place);
  hold_at(place + glm::dvec2(0.03, 0.0));
  const Image8 beside = stage.picture();
  must(table.session.run(fmt::format("insert bench_stone {},{} name bench_of_the_bench", place.x, place.y)));
  must(stage.simulation().live().refresh(stage.simulation().scene).empty()
           ? Status(Ok{})
           : Status(error("it cannot be built")));
  stage.draw(camera, width, height);
  const Image8 whole = stage.whole_picture();
  const Image8 mask = mask_of(stage, camera, object_named(stage.scene(), "bench_of_the_bench"));
  hands.flip = flip_between(held, whole, mask);
  hands.flip_aside = flip_between(beside, whole, mask);
}

/// Inserts bollards, journal and all, and waits for their pictures: over the one that is kept, and with their
/// shadows, as they follow at a rate that is held.
void measure_insertion(stage::Stage& stage, Table& table, glm::dvec2 place, bool is_quick, Hands& hands) {
  const Camera camera = eye_at({place, table.surfaces.resting_height(place)});
  design::Preview preview(stage.scene(), table.simulation.live());
  std::vector<double> held_ms, whole_ms, shadow_ms;
  for (int i = 0; i < (is_quick ? 8 : 50); ++i) {
    stage.hold_rate(window_rate);
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
    const Image8 before = i == 0 ? stage.picture() : Image8();
    const glm::dvec2 at = place + glm::dvec2(0.3 * (i % 10), 1.0 + 0.3 * (i / 10));
    const double command_ms = milliseconds(
        [&] { must(table.session.run(fmt::format("insert bollard {},{} name {}", at.x, at.y, name))); });
    held_ms.push_back(command_ms + milliseconds(show));
    if (i == 0) expect_change(before, stage.picture(), "what was inserted");
    const auto whole = [&] { stage.draw(camera, width, height), stage.display(0), glFinish(); };
    shadow_ms.push_back(command_ms + milliseconds(whole));
    stage.hold_rate(0.0);
    if (i % 4 == 0) whole_ms.push_back(command_ms + milliseconds(whole));
  }
  hands.insertion = median(held_ms), hands.shadow = median(shadow_ms);
  hands.whole_ms = median(whole_ms).value;
}

/// The paper's city and The Hague: of each key the worse one.
void measure_hands(const BenchSetup& setup, Report& report) {
  std::vector<Hands> places;
  const auto measure = [&](const std::filesystem::path& scene, glm::dvec2 place,
                           const std::vector<std::filesystem::path>& data) {
    const std::unique_ptr<stage::Stage> stage = stage_of(setup.simulation(scene, data));
    Table table{stage->simulation()};
    must(table.session.keep_journal(setup.folder / "hands.journal"));
    measure_drag(*stage, table, place, setup.is_quick, places.emplace_back());
    measure_insertion(*stage, table, place, setup.is_quick, places.back());
    report.note(
        fmt::format("{}: insertion {:.1f} ms, with its shadow {:.0f} ms, drag {:.1f} fps, FLIP {:.4f}",
                    scene.filename().string(), places.back().insertion.value, places.back().shadow.value,
                    places.back().drag.value, places.back().flip));
    std::filesystem::remove(setup.folder / "hands.journal");
  };
  measure(setup.city() / "paper.xp", middle, {});
  if (const auto shared = shared_data("cities/DenHaag_01.city.json", std::filesystem::current_path())) {
    measure("scenes/denhaag.xp", {22.8, -106.8},
            {shared->parent_path().parent_path()});  // in its long street
  } else {
    report.note("The Hague is not here: ../shared/data is absent");
  }
  const auto worst = [&](auto of) { return *std::ranges::max_element(places, {}, of); };
  const Hands &inserted = worst([](const Hands&h) { return h.insertion.value; }),
              &dragged = worst([](const Hands&h) { return -h.drag.value; }),
              &shown = worst([](const Hands&h) { return h.flip; });
  report.add("insert_to_picture_ms", inserted.insertion);
  report.add("insert_to_whole_picture_ms", inserted.whole_ms);
  report.add("insert_to_shadow_ms", worst([](const Hands& h) { return h.shadow.value; }).shadow);
  report.add("drag_fps", dragged.drag);
  report.add("drag_fps_of_whole_pictures", dragged.whole_fps);
  report.add("drag_picture_flip", shown.flip);
  report.add("drag_picture_flip_3_cm_beside", shown.flip_aside);
}

/// Where the faces of stone benches of random place, heading and size are, by rays at them, against what was
/// typed; half of them about the middle of the city, half at its edge.
void measure_precision(Table& table, Report& report) {
  constexpr double base_m = 40.0, from_m = 9.0;
  double largest_mm = 0.0, rounded_mm = 0.0;
  Random random(11);
  const auto typed = [&](double low, double high) {
    return std::round(1e4 * double(random.uniform(float(low), float(high)))) * 1e-4;
  };
  for (int i = 0; i < 40; ++i) {
    const glm::dvec2 cell(20.0 * (i % 5) + (i < 20 ? -40.0 : 460.0), 20.0 * (i / 5));
    const glm::dvec2 at = cell + glm::dvec2(typed(-4, 4), typed(-4, 4));
    const glm::dvec3 size(typed(0.6, 7.9), typed(0.31, 1.19), typed(0.36, 0.59));
    const double heading_deg = typed(0, 360), heading = glm::radians(heading_deg);
    const std::string name = fmt::format("bench_{}_typed", i);
    must(table.session.run(
        fmt::format("insert bench_stone {:.4f},{:.4f},{} heading {:.4f} width {:.4f} depth {:.4f} height "
                    "{:.4f} name {}",
                    at.x, at.y, base_m, heading_deg, size.x, size.y, size.z, name)));
    const glm::dvec3 ahead(std::sin(heading), std::cos(heading), 0.0), right(ahead.y, -ahead.x, 0.0),
        seat(at, base_m + size.z - 0.03);
    const auto distance_to = [&](const glm::dvec3& from, const glm::dvec3& towards) {
      const auto hit = table.surfaces.first_along({glm::vec3(from), glm::vec3(towards)});
      if (!hit) fail("no ray hits {}", name);
      return glm::dot(hit->position - from, towards);
    };
    const auto note = [&](const glm::dvec3& face, const glm::dvec3& outward, const glm::dvec2& moved) {
      const double error_m = from_m - distance_to(face + from_m * outward, -outward);
      largest_mm = std::max(largest_mm, 1e3 * std::abs(error_m));
      rounded_mm = std::max(rounded_mm, 1e3 * std::abs(error_m + glm::dot(glm::dvec3(moved, 0.0), outward)));
    };
    const glm::dvec2 moved = at - glm::round(at * 1e2) * 1e-2;
    for (const double sign : {-1.0, 1.0}) {
      note(seat + sign * 0.5 * size.x * right, sign * right, moved);
      for (const double along : {-0.4, 0.4})  // a bench that is turned a little shows it here
        note(seat + sign * 0.5 * size.y * ahead + along * size.x * right, sign * ahead, moved);
    }
    note(glm::dvec3(at, base_m + size.z), {0, 0, 1}, moved);
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
/// picture; the slower of there and back counts.
void measure_switches(const BenchSetup& setup, Report& report) {
  must(write_file(setup.city() / "two_designs.xp", two_designs));
  const auto stage = stage_of(setup.simulation(setup.city() / "two_designs.xp"));
  const auto is_shown = [&](const char* name) {
    return stage->scene().objects[std::size_t(object_named(stage->scene(), name))].is_visible;
  };
  int step = 0;
  for (const bool keeps_rate : {false, true}) {  // the resolution that a held rate leaves stays lowered
    stage->hold_rate(keeps_rate ? window_rate : 0.0);
    for (int i = 0; i < (keeps_rate ? 40 : 3); ++i) walk_ms(*stage, {middle, 0.0}, step++);
    std::array<std::vector<double>, 2> switches;
    std::vector<double> frames;
    for (int i = 0; i < (setup.is_quick ? 6 : keeps_rate ? 100 : 12); ++i) {
      const bool to_trees = i % 2 == 0;
      const double choice_ms =
          milliseconds([&] { must(stage->choose_scenario(to_trees ? "with trees" : "")); });
      if (is_shown("wood_1") != to_trees || is_shown("stone_1") == to_trees) fail("nothing was switched");
      const Camera camera = eye_at(glm::dvec3(middle, 0.0) + glm::dvec3(0.14 * (step % 40), 0.0, 0.0));
      switches[std::size_t(to_trees)].push_back(choice_ms + walk_ms(*stage, {middle, 0.0}, step++));
      const int shown = object_named(stage->scene(), to_trees ? "wood_1" : "stone_1");
      if (i < 2 && std::ranges::count(mask_of(*stage, camera, shown).pixels, 255) < 50)
        fail("the other design is not drawn");
      for (int k = 0; k < 3; ++k) frames.push_back(walk_ms(*stage, {middle, 0.0}, step++));
    }
    const Median there = median(switches[1]), back = median(switches[0]);
    const Median& slower = there.value > back.value ? there : back;
    report.add(keeps_rate ? "scenario_switch_ms" : "scenario_switch_ms_of_whole_pictures", slower);
    if (keeps_rate)
      report.add("scenario_switch_ms_beyond_an_ordinary_one", slower.value - median(frames).value);
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
  long seen = 0, missing = 0, missing_aside = 0;
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
    const auto has_ink = [&](glm::vec2 point) {
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
          if (is_ink(int(point.x) + dx, int(point.y) + dy, 150)) return true;
      return false;
    };
    const auto is_inside = [](glm::vec2 at) {
      return at.x >= 2 && at.y >= 2 && at.x <= width - 3 && at.y <= height - 3;
    };
    for (std::size_t i = 0; i < shown.size(); ++i) {
      if (!is_inside(shown[i]) || !is_inside(aside[i])) continue;
      ++seen, missing += !has_ink(shown[i]), missing_aside += !has_ink(aside[i]);
    }
  }
  report.add("sketch_edge_px", largest_px);
  report.add("sketch_edge_px_of_boxes_5_cm_aside", largest_aside_px);
  const double percent = 100.0 / double(std::max(seen, 1L));
  report.add("sketch_edges_without_ink_percent", percent * double(missing));
  report.add("sketch_edges_without_ink_percent_of_boxes_5_cm_aside", percent * double(missing_aside));
}

/// The design as its script and as the objects and plants that are shown.
std::string state_of(const Table& table) {
  std::vector<std::string> shown;
  const auto add = [&](const std::string& name, const glm::mat4& placed) {
    const float* numbers = glm::value_ptr(placed);
    shown.push_back(fmt::format("{} {}", name, fmt::join(numbers, numbers + 16, " ")));
  };
  for (const scene::Object& object : table.simulation.scene.objects)
    if (object.is_visible) add(object.name, object.world_from_model);
  for (const vegetation::ScenePlant& plant : vegetation::scene_plants(table.simulation.scene))
    if (plant.is_visible) add(plant.shape->kind().name, plant.world_from_plant);
  std::ranges::sort(shown);
  return fmt::format("{}{}", table.session.script(), fmt::join(shown, "\n"));
}

/// Undone to nothing, done again, and replayed from the journal: the same design.
void measure_replay(const BenchSetup& setup, Report& report) {
  const std::filesystem::path script = setup.folder / "replay.xp", journal = setup.folder / "replay.journal";
  must(write_file(script, "camera(name=eye)\n"));
  std::string empty, made;
  bool is_undone = false, is_redone = false;
  {  // what holds the journal is gone before it is opened again
    stage::Simulation simulation = setup.simulation(script);
    Table table{simulation};
    must(table.session.keep_journal(journal));
    empty = state_of(table);
    const int commands = setup.is_quick ? 1'000 : 10'000;
    Random random(7);
    int done = 0;
    for (int i = 0; i < commands; ++i)
      done += table.session.run(design::random_command(random, table.session)).ok() ? 1 : 0;
    if (done < commands / 2) fail("of {} commands {} alone were done", commands, done);
    made = state_of(table);
    int steps = 0;
    while (table.session.undo()) ++steps;
    is_undone = state_of(table) == empty;
    for (int i = 0; i < steps; ++i) must(table.session.redo());
    is_redone = state_of(table) == made;
  }
  stage::Simulation again = setup.simulation(script);
  Table other{again};
  must(other.session.keep_journal(journal));
  const bool is_replayed = state_of(other) == made;
  must(other.session.undo());
  const bool is_made_with_one_step_less = state_of(other) == made;
  while (other.session.undo()) {
  }
  const bool is_undone_after_opening = state_of(other) == empty;
  report.add("undo_replay_identical",
             is_undone && is_redone && is_replayed && is_undone_after_opening ? 1.0 : 0.0);
  report.add("undo_replay_identical_of_one_step_less", is_made_with_one_step_less ? 1.0 : 0.0);
}

/// Kills after which the design that is opened is not as it was after the last command that had returned, or
/// after the one that was under way. Every second kill goes on with the journal of the one before.
void measure_kills(const BenchSetup& setup, Report& report) {
  const std::filesystem::path script = setup.folder / "kills.xp", journal = setup.folder / "kills.journal",
                              before = setup.folder / "before.journal";
  must(write_file(script, "camera(name=eye)\n"));
  Random moments(3);
  int lost = 0, lost_without_journal = 0;
  for (int kills = 0; kills < (setup.is_quick ? 20 : 200); ++kills) {
    std::filesystem::remove(before);
    if (kills % 2 == 0)
      std::filesystem::remove(journal);
    else
      std::filesystem::copy_file(journal, before);
    const auto work = [&](Table& table, Random& random) {
      static_cast<void>(table.session.run(design::random_command(random, table.session)).ok());
    };
    const int wanted = 1 + moments.index(200);
    const int acknowledged = acknowledged_before_kill(wanted, [&](const auto& acknowledge) {
      stage::Simulation simulation = setup.simulation(script);
      Table table{simulation};
      Random random(std::uint64_t(kills) + 1);
      if (!table.session.keep_journal(journal)) return;
      do work(table, random);
      while (acknowledge());
    });
    if (acknowledged < wanted) fail("the program to be killed ended by itself");
    stage::Simulation killed = setup.simulation(script), whole = setup.simulation(script);
    Table restored{killed}, expected{whole};
    const std::string without_journal = state_of(restored);
    must(restored.session.keep_journal(journal));
    must(expected.session.keep_journal(before));
    Random random(std::uint64_t(kills) + 1);
    for (int i = 0; i < acknowledged; ++i) work(expected, random);
    const std::string last = state_of(expected);
    work(expected, random);
    const auto is_lost = [&](const std::string& state) {
      return state != last && state != state_of(expected);
    };
    lost += is_lost(state_of(restored)), lost_without_journal += is_lost(without_journal);
  }
  report.add("kill_loses_commands", lost);
  report.add("kill_loses_commands_without_journal", lost_without_journal);
}

}  // namespace

void measure_plan(const BenchSetup& setup, Report& report) {
  measure_hands(setup, report);
  measure_switches(setup, report);
}

void measure_plan_precision(const BenchSetup& setup, Report& report) {
  stage::Simulation simulation = setup.simulation(setup.city() / "paper.xp");
  Table table{simulation};
  measure_precision(table, report);
}

void measure_sketch(const BenchSetup& setup, Report& report) { compare_lines(setup, report); }

void measure_plan_files(const BenchSetup& setup, Report& report) {
  measure_replay(setup, report);
  measure_kills(setup, report);
}

}  // namespace parvis::bench
