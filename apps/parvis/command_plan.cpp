// parvis plan: a scene as a plan, for offices: PDF at a true scale, DXF, CSV.
#include "commands.h"
#include "planning/plan_drawing/plan_files.h"
#include "scene_arguments.h"

namespace parvis {
namespace {

struct Arguments : SceneArguments {
  std::filesystem::path pdf, dxf, csv;
  plan_drawing::Sheet sheet;
  std::string centre;
};

Status read_centre(const std::string& text, plan_drawing::Sheet& sheet) {
  if (text.empty()) return Done{};
  const std::vector<double> numbers = scene::parse_numbers(text);
  if (numbers.size() != 2) return error("--centre {}: expected two numbers, as 12.5,-3", text);
  sheet.centre = glm::dvec2(numbers[0], numbers[1]);
  return Done{};
}

Status write_plan(Arguments arguments) {
  if (arguments.pdf.empty() && arguments.dxf.empty() && arguments.csv.empty())
    return error("nothing to write; give --pdf, --dxf or --csv with a file");
  if (Status status = read_centre(arguments.centre, arguments.sheet); !status) return status;
  if (Status status = arguments.expect_one_scenario(); !status) return status;
  const Result<house::Play> play = arguments.open_play();
  if (!play) return play.errors();
  const plan_drawing::ScenePlan plan = plan_drawing::plan_of(play->scene, {});
  if (arguments.sheet.title.empty()) arguments.sheet.title = arguments.scene.stem().string();
  if (!arguments.pdf.empty())
    if (Status status = plan_drawing::write_plan_pdf(arguments.pdf, plan, arguments.sheet); !status)
      return status;
  if (!arguments.dxf.empty())
    if (Status status = plan_drawing::write_plan_dxf(arguments.dxf, plan); !status) return status;
  if (!arguments.csv.empty())
    if (Status status = plan_drawing::write_plan_csv(arguments.csv, plan); !status) return status;
  fmt::print("{} lines, {} trees, {} placed objects\n", plan.lines.size(), plan.trees.size(),
             plan.placed.size());
  for (const std::string& note : plan.left_out) fmt::print("not on the plan: {}\n", note);
  return Done{};
}

}  // namespace

void add_plan(CLI::App& app, Chosen& chosen) {
  CLI::App* command = app.add_subcommand("plan", "A scene as a plan: PDF at a true scale, DXF, CSV");
  const auto arguments = std::make_shared<Arguments>();
  arguments->add_scene(*command);
  arguments->add_state(*command);
  command->add_option("--pdf", arguments->pdf, "A sheet with title block, legend, scale bar and north");
  command->add_option("--dxf", arguments->dxf,
                      "A drawing in metres, in map coordinates where there are some");
  command->add_option("--csv", arguments->csv, "A table of trees and placed objects");
  command->add_option("--scale", arguments->sheet.scale, "Of the sheet, 1 : SCALE")->capture_default_str();
  command->add_option("--paper", arguments->sheet.paper, "A4, A3, A2, A1 or A0, landscape")
      ->capture_default_str();
  command->add_option("--centre", arguments->centre, "Middle of the sheet, metres: X,Y in the scene's frame");
  command->add_option("--title", arguments->sheet.title, "Of the title block (default: the scene's name)");
  command->add_option("--subtitle", arguments->sheet.subtitle, "Its second line: project, state, author");
  command->footer(
      "Example: parvis plan out/paper/paper.xp --pdf plan.pdf --scale 500 --dxf plan.dxf --csv plan.csv");
  command->callback([arguments, &chosen] { chosen = [arguments] { return write_plan(*arguments); }; });
}

}  // namespace parvis
