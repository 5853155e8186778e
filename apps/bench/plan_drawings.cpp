// Drawings: what other programs read of ours, and we of given ones.
#include <sys/wait.h>

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/test_data.h"
#include "bench/parts.h"
#include "formats/drawings/drawing_reader.h"
#include "planning/design/design_nodes.h"
#include "planning/plan_drawing/plan_files.h"

namespace parvis::bench {
namespace {

/// The largest error of the readers that script/dxf_readers_agree finds, two at least; nothing where there
/// are fewer. Fails where one of them cannot read the file.
std::optional<double> readers_error_mm(const std::filesystem::path& dxf,
                                       const std::filesystem::path& points) {
  const std::string command = fmt::format(
      "'{}' '{}' '{}' 2>&1", (std::filesystem::current_path() / "script" / "dxf_readers_agree").string(),
      dxf.string(), points.string());
  std::FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) return std::nullopt;
  double error_mm = 0.0;
  int readers = 0;
  std::string output;
  std::array<char, 512> line{};
  while (std::fgets(line.data(), int(line.size()), pipe)) {
    output += line.data();
    std::sscanf(line.data(), "dxf_readers_agree_mm %lf of %d readers", &error_mm, &readers);
  }
  constexpr int none = 77;  // the script's status where no reader is installed
  const int status = pclose(pipe);
  if (readers == 0 && (!WIFEXITED(status) || WEXITSTATUS(status) != none))
    fail("a reader cannot read the drawing: {}", output);
  return readers > 1 ? std::optional(error_mm) : std::nullopt;
}

void measure_export(const BenchSetup& setup, Report& report) {
  const stage::Simulation simulation = setup.simulation(std::filesystem::path("scenes/planned_square.xp"));
  plan_drawing::ScenePlan plan = plan_drawing::plan_of(
      simulation.scene, design::placed_objects(simulation.scene, simulation.live(), "", true));
  double largest_mm = 0.0, largest_aside_mm = 0.0;
  for (const glm::dvec3& origin :
       {glm::dvec3(1043000, 6298000, 0), glm::dvec3(0)}) {  // on the map; LibreCAD's
    plan.origin = origin;
    std::vector<glm::dvec3> points;
    for (const plan_drawing::PlanLine& line : plan.lines)
      for (const glm::dvec3& point : line.points) points.push_back(origin + point);
    for (const design::PlacedObject& object : plan.placed)
      for (const glm::dvec2& corner : object.outline)
        if (!object.is_round && object.kind != "ground")
          points.push_back(origin + glm::dvec3(corner, object.position.z));
    const std::size_t step = 1 + points.size() / 1500;
    const std::filesystem::path dxf = setup.folder / "plan.dxf", listed = setup.folder / "points.csv";
    must(plan_drawing::write_plan_dxf(dxf, plan));
    for (const bool is_aside : {false, true}) {
      std::string text;
      for (std::size_t i = 0; i < points.size(); i += step)  // one point aside: LibreCAD's page is moved
        text += fmt::format("{:.9f},{:.9f},{:.9f}\n", points[i].x + (is_aside && i == step ? 0.005 : 0.0),
                            points[i].y, points[i].z);
      must(write_file(listed, text));
      const std::optional<double> error_mm = readers_error_mm(dxf, listed);
      if (!error_mm) return report.skip("dxf_readers_agree_mm", "no two readers of DXF are here");
      (is_aside ? largest_aside_mm : largest_mm) =
          std::max(is_aside ? largest_aside_mm : largest_mm, *error_mm);
    }
  }
  report.add("dxf_readers_agree_mm", largest_mm);
  report.add("dxf_readers_agree_mm_of_a_point_5_mm_aside", largest_aside_mm);
}

void measure_given(Report& report) {
  const auto folder = shared_data("plan", std::filesystem::current_path());
  if (!folder) return report.skip("given_drawings_mm", "the drawings ../shared/data/plan are not here");
  const nlohmann::json cases = nlohmann::json::parse(std::ifstream(*folder / "expected.json"));
  double largest_mm = 0.0, in_its_unit_mm = 0.0;
  for (const nlohmann::json& file : cases["files"]) {
    const double metres_per_unit = file["metres_per_unit"];
    Errors warnings;
    const auto drawing = formats::read_drawing(
        *folder / file["file"].get<std::string>(),
        file["insunits"].is_null() ? std::optional(metres_per_unit) : std::nullopt, warnings);
    if (!drawing) fail("{}", to_string(drawing.errors()));
    const auto note = [&](const nlohmann::json& at) {
      const glm::dvec2 point(at[0].get<double>(), at[1].get<double>());
      double nearest = 1e9, in_its_unit = 1e9;
      const auto compare = [&](const glm::dvec3& found) {
        nearest = std::min(nearest, glm::distance(glm::dvec2(found), point));
        in_its_unit = std::min(in_its_unit, glm::distance(glm::dvec2(found) / metres_per_unit, point));
      };
      for (const formats::DrawingLine& line : drawing->lines)
        for (const glm::dvec3& corner : line.points) compare(corner);
      for (const formats::PlacedBlock& block : drawing->blocks) compare(block.position);
      largest_mm = std::max(largest_mm, 1e3 * nearest),
      in_its_unit_mm = std::max(in_its_unit_mm, 1e3 * in_its_unit);
    };
    for (const auto& [name, tree] : file["trees"].items()) note(tree["centre"]);
    for (const auto& [name, bench] : file["benches"].items())
      for (const nlohmann::json& corner : bench["corners"]) note(corner);
    for (const char* const corners : {"building_corners", "kerb_3_corners", "frame_corners"})
      for (const nlohmann::json& corner : file[corners]) note(corner);
  }
  report.add("given_drawings_mm", largest_mm);
  report.add("given_drawings_mm_in_their_own_unit", in_its_unit_mm);
}

}  // namespace

void measure_plan_drawings(const BenchSetup& setup, Report& report) {
  measure_export(setup, report);
  measure_given(report);
}

}  // namespace parvis::bench
