#include "planning/plan_drawing/scene_plan.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>

#include "base/files.h"
#include "base/test_data.h"
#include "base/test_folder.h"
#include "formats/drawings/drawing_reader.h"
#include "life/vegetation/scene_plant.h"
#include "planning/plan_drawing/plan_files.h"
#include "planning/plan_drawing/plan_lines.h"
#include "scene/data/test_scene.h"

namespace parvis::plan_drawing {
namespace {

/// A house of 10 x 6 m, a bench of 0.45 m, a car that moves, on level ground.
scene::Scene small_place() {
  scene::Scene scene;
  const auto add = [&](const std::string& name, Mesh mesh) -> scene::Object& {
    scene::Object object;
    object.name = name;
    object.model = scene::model_of(std::move(mesh), scene::matt(glm::vec3(0.5f)));
    return scene.objects.emplace_back(std::move(object));
  };
  auto ground = scene::model_of(scene::ground(40.0f), scene::matt(glm::vec3(0.5f)));
  ground->parts[0].object = "TINRelief";
  scene::Object land;
  land.name = "land", land.model = ground;
  scene.objects.push_back(land);
  add("house", scene::box({0, 0, 0}, {10, 6, 8}));
  add("bench", scene::box({-5, -5, 0}, {-3.2f, -4.5f, 0.45f}));
  add("car", scene::box({12, -9, 0}, {16, -7, 1.5f})).is_dynamic = true;
  scene.origin = {1043000, 6298000, 0};
  return scene;
}

design::PlacedObject placed_bench() {
  design::PlacedObject bench;
  bench.name = "bench_7", bench.design = "stone", bench.kind = "bench_stone",
  bench.label = "Bench, \"stone\"";
  bench.position = {3, -4, 0}, bench.heading_deg = 30.0, bench.size_m = {1.8, 0.5, 0.45};
  bench.outline = design::rectangle_outline({3, -4}, {1.8, 0.5}, 30.0);
  return bench;
}

const PlanLine* line_of(const ScenePlan& plan, PlanLayer layer) {
  const auto found = std::ranges::find(plan.lines, layer, &PlanLine::layer);
  return found == plan.lines.end() ? nullptr : &*found;
}

TEST(ScenePlan, WallsAreCutAndLowThingsOutlined) {
  const ScenePlan plan = plan_of(small_place(), {});
  ASSERT_EQ(plan.lines.size(), 2u);
  const PlanLine* const house = line_of(plan, PlanLayer::wall);
  ASSERT_TRUE(house);
  EXPECT_TRUE(house->is_closed());
  ASSERT_EQ(house->points.size(), 5u) << "points on straight lines are left out";
  for (const glm::dvec3& point : house->points) {
    EXPECT_TRUE((std::abs(point.x) < 1e-4 || std::abs(point.x - 10) < 1e-4) &&
                (std::abs(point.y) < 1e-4 || std::abs(point.y - 6) < 1e-4));
    EXPECT_NEAR(point.z, 1.0, 1e-4);
  }
  const PlanLine* const bench = line_of(plan, PlanLayer::thing);
  ASSERT_TRUE(bench);
  EXPECT_EQ(bench->points.size(), 5u);
  EXPECT_NE(plan.left_out.at(1).find("1 things that move"), std::string::npos);
}

TEST(ScenePlan, ObjectsOfDesignsTakeThePlaceOfThoseOfTheScene) {
  design::PlacedObject bench = placed_bench();
  bench.name = "bench";
  const ScenePlan plan = plan_of(small_place(), {bench});
  EXPECT_FALSE(line_of(plan, PlanLayer::thing)) << "it is drawn once, as an object";
  EXPECT_EQ(plan.placed.size(), 1u);
  EXPECT_EQ(plan.middle(), glm::dvec2(3, -4));
}

TEST(ScenePlan, ATreeOfADesignIsOneTree) {
  vegetation::PlantRecipe recipe;
  recipe.kind = vegetation::find_kind("orange");
  recipe.height_m = 3.0f;
  scene::Scene scene = small_place();
  auto shape = vegetation::shared_plant(scene.data<vegetation::PlantCache>(), recipe);
  ASSERT_TRUE(shape) << to_string(shape.errors());
  for (const float x : {2.0f, 9.0f}) {
    vegetation::ScenePlant plant;
    plant.shape = *shape;
    plant.world_from_plant[3] = {x, 3, 0, 1};
    scene.data<vegetation::ScenePlants>().add(plant, -1);
  }
  design::PlacedObject placed;
  placed.name = "orange_1", placed.kind = "tree_orange", placed.position = {2, 3, 0};
  const ScenePlan plan = plan_of(scene, {placed});
  ASSERT_EQ(plan.trees.size(), 1u) << "the one that no design has";
  EXPECT_NEAR(plan.trees.front().position.x, 9.0, 1e-6);
  EXPECT_EQ(plan_of(scene, {}).trees.size(), 2u);
}

TEST(PlanLines, RingsAndOpenLinesOfSegmentsInAnyOrder) {
  const std::vector<Segment> segments{{{{0, 0, 0}, {1, 0, 0}}},      {{{1, 1, 0}, {0, 0, 0}}},
                                      {{{1, 0, 0}, {1, 1, 0}}},      {{{5, 0, 0}, {6, 0, 0}}},
                                      {{{7, 0, 0}, {6, 0.0004, 0}}}, {{{6, 0, 0}, {5, 0, 0}}}};
  const std::vector<std::vector<glm::dvec3>> lines = joined(segments);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].size(), 2u) << "5 to 7 in one piece: the double one counts once";
  EXPECT_EQ(lines[1].size(), 4u);
  EXPECT_EQ(lines[1].front(), lines[1].back());
}

TEST(PlanFiles, DxfIsInMapCoordinatesAndReadBack) {
  const TestFolder folder;
  const design::Measurement ruler{"ruler", "stone", design::Quantity::distance, {{-8, 0, 0}, {-8, 6, 0}}};
  const ScenePlan plan = plan_of(small_place(), {placed_bench()}, {ruler});
  ASSERT_TRUE(write_plan_dxf(folder.path() / "plan.dxf", plan));
  Errors warnings;
  const auto drawing = formats::read_drawing(folder.path() / "plan.dxf", std::nullopt, warnings);
  ASSERT_TRUE(drawing) << to_string(drawing.errors());
  ASSERT_EQ(drawing->blocks.size(), 1u);
  const formats::PlacedBlock& bench = drawing->blocks[0];
  EXPECT_EQ(bench.position, glm::dvec3(1043003, 6297996, 0));
  EXPECT_NEAR(bench.heading_deg, 30.0, 1e-6);
  ASSERT_TRUE(bench.size_m);
  EXPECT_NEAR(bench.size_m->x, 1.8, 1e-6);
  EXPECT_NEAR(bench.size_m->y, 0.5, 1e-6);
  EXPECT_EQ(drawing->layers[std::size_t(bench.layer)].name, "DESIGN_stone");
  ASSERT_EQ(drawing->texts.size(), 1u);
  EXPECT_EQ(drawing->texts[0].text, "6.00 m");
  EXPECT_LT(glm::distance(drawing->texts[0].position, glm::dvec3(1042992, 6298003, 0)), 0.001);
  EXPECT_EQ(drawing->layers[std::size_t(drawing->texts[0].layer)].name, "MEASURES_stone");
  double nearest = 1e9;
  for (const formats::DrawingLine& line : drawing->lines)
    for (const glm::dvec3& point : line.points)
      nearest = std::min(nearest, glm::distance(glm::dvec2(point), glm::dvec2(1043010, 6298006)));
  EXPECT_LT(nearest, 0.001) << "the corner of the house";
}

TEST(PlanFiles, OtherProgramsReadTheDxfToAMillimetre) {
  const TestFolder folder;
  ScenePlan plan = plan_of(small_place(), {placed_bench()});
  plan.lines.push_back(
      {.layer = PlanLayer::road, .points = {{-20, -12, 0.5}, {0, -12.25, 1.25}, {22, -12, 3.75}}});
  const std::string script = (source_folder() / "script" / "dxf_readers_agree").string();
  // On the map, and about zero, where LibreCAD can print at a scale at which a millimetre counts.
  for (const glm::dvec3& origin : {glm::dvec3(1043000, 6298000, 0), glm::dvec3(0)}) {
    plan.origin = origin;
    ASSERT_TRUE(write_plan_dxf(folder.path() / "plan.dxf", plan));
    std::string points;
    const auto note = [&](const glm::dvec3& point) {
      const glm::dvec3 on_map = origin + point;
      points += fmt::format("{},{},{}\n", on_map.x, on_map.y, on_map.z);
    };
    for (const PlanLine& line : plan.lines)
      for (const glm::dvec3& point : line.points) note(point);
    for (const glm::dvec2 corner : plan.placed[0].outline) note({corner, 0.0});
    folder.write("points.csv", points);
    constexpr int skipped = 77;  // the script's
    const int status =
        std::system(fmt::format("'{}' '{}' '{}'", script, (folder.path() / "plan.dxf").string(),
                                (folder.path() / "points.csv").string())
                        .c_str());
    if (WIFEXITED(status) && WEXITSTATUS(status) == skipped) GTEST_SKIP() << "no other reader of DXF is here";
    EXPECT_EQ(status, 0);
  }
}

TEST(PlanFiles, CsvHasALinePerObject) {
  const TestFolder folder;
  design::PlacedObject bench = placed_bench();
  bench.name = "the \"long\" bench, oak";
  ScenePlan plan = plan_of(small_place(), {bench});
  plan.trees.push_back({"lime", {1, 2, 0.5}, 2.0, 9.0});
  plan.measured.push_back(
      PlanMeasure::of({"ramp", "stone", design::Quantity::slope, {{0, 0, 0}, {10, 0, 0.5}}}));
  ASSERT_TRUE(write_plan_csv(folder.path() / "plan.csv", plan));
  EXPECT_EQ(*read_file(folder.path() / "plan.csv"),
            "kind,name,x,y,z,heading_deg,width_m,depth_m,height_m,design,value,unit\r\n"
            "bench_stone,\"the \"\"long\"\" bench, "
            "oak\",1043003.000,6297996.000,0.000,30.00,1.800,0.500,0.450,stone,,\r\n"
            "tree,lime,1043001.000,6298002.000,0.500,0.00,4.000,4.000,9.000,,,\r\n"
            "slope,ramp,1043000.000,6298000.000,0.000,,,,,stone,0.0500,1\r\n");
}

/// The middles of the first dark strokes left and right of a pixel, in pixels.
std::optional<glm::dvec2> strokes_beside(const std::string& pgm, int width, int row, int from) {
  const auto is_dark = [&](int x) {
    const std::size_t start = pgm.size() - std::size_t(width) * (pgm.size() / std::size_t(width));
    return static_cast<unsigned char>(pgm[start + std::size_t(row) * std::size_t(width) + std::size_t(x)]) <
           100;
  };
  glm::dvec2 middles(0.0);
  for (const int step : {-1, 1}) {
    int first = from;
    while (first > 0 && first + 1 < width && !is_dark(first)) first += step;
    int last = first;
    while (last > 0 && last + 1 < width && is_dark(last)) last += step;
    if (first == last) return std::nullopt;
    middles[step < 0 ? 0 : 1] = 0.5 * (first + last - step) + 0.5;
  }
  return middles;
}

TEST(PlanFiles, PdfIsTrueToScale) {
  if (std::system("pdftoppm -v 2> /dev/null") != 0)
    GTEST_SKIP() << "skipped: pdftoppm (poppler-utils) is not here";
  const TestFolder folder;
  const ScenePlan plan = plan_of(small_place(), {});
  constexpr double dpi = 508.0, px_per_mm = dpi / 25.4;
  constexpr int width = 8400;  // of A3
  for (const double scale : {50.0, 100.0, 500.0}) {
    Sheet sheet;
    sheet.scale = scale, sheet.centre = glm::dvec2(5, 3);
    ASSERT_TRUE(write_plan_pdf(folder.path() / "plan.pdf", plan, sheet));
    const std::string page = (folder.path() / "page").string();
    ASSERT_EQ(std::system(fmt::format("pdftoppm -r {} -gray -singlefile '{}' '{}'", dpi,
                                      (folder.path() / "plan.pdf").string(), page)
                              .c_str()),
              0);
    const Result<std::string> pixels = read_file(page + ".pgm");
    ASSERT_TRUE(pixels);
    // The house is 10 m wide about the middle of the frame, which lies at 176 mm, 148.5 mm; beside the grid's
    // cross.
    const auto walls = strokes_beside(*pixels, width, int((148.5 + 4.0) * px_per_mm), int(171.0 * px_per_mm));
    ASSERT_TRUE(walls);
    const double expected_mm = 10'000.0 / scale, measured_mm = (walls->y - walls->x) / px_per_mm;
    std::printf("1:%g: 10 m are %.3f mm, expected %.3f mm\n", scale, measured_mm, expected_mm);
    EXPECT_NEAR(measured_mm, expected_mm, 1.0 / px_per_mm) << "to a pixel";
    EXPECT_NEAR(0.5 * (walls->x + walls->y) / px_per_mm, 176.0, 1.0 / px_per_mm);
  }
}

TEST(PlanFiles, PdfIsRefusedWhereItWouldShowNothing) {
  const TestFolder folder;
  const ScenePlan plan = plan_of(small_place(), {});
  const auto message = [&](const auto& change) {
    Sheet sheet;
    change(sheet);
    const Status status = write_plan_pdf(folder.path() / "plan.pdf", plan, sheet);
    return status ? std::string() : to_string(status.errors());
  };
  EXPECT_NE(message([](Sheet& sheet) { sheet.paper = "A9"; }).find("expected A4"), std::string::npos);
  EXPECT_NE(message([](Sheet& sheet) { sheet.scale = 0.0; }).find("expected 1:5"), std::string::npos);
  EXPECT_NE(message([](Sheet& sheet) { sheet.centre = glm::dvec2(5000, 0); }).find("another centre"),
            std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "plan.pdf")) << "nothing half written";
  EXPECT_EQ(message([](Sheet&) {}), "");
  EXPECT_GT(std::filesystem::file_size(folder.path() / "plan.pdf"), 1000u);
}

}  // namespace
}  // namespace parvis::plan_drawing
