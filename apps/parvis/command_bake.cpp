// parvis bake: what takes long and stays the same is baked once and kept beside the scene.
#include "commands.h"
#include "graphics/gl/context.h"
#include "graphics/render/bake_steps.h"
#include "machines/processes.h"
#include "scene_arguments.h"
#include "stage/baking.h"

namespace parvis {
namespace {

struct BakeArguments : SceneArguments {
  std::filesystem::path plan;
};

Status bake(BakeArguments arguments) {
  if (!arguments.plan.empty())
    if (Status status = arguments.expect_one_scenario(); !status) return status;
  const Result<machines::Processes> processes = machines::Processes::join();
  if (!processes) return processes.errors();
  const Result<gl::Context> context = gl::Context::create_headless();
  if (!context) return context.errors();
  std::vector<std::string> states = arguments.scenarios;
  if (states.empty()) states = {"base"};
  stage::Baking baking(rooms::all_registries(), *processes);
  for (std::size_t i = 0; i < states.size(); ++i) {
    arguments.scenarios = {states[i]};
    const Result<stage::Simulation> simulation = arguments.open_simulation();
    if (!simulation) return simulation.errors();
    if (Status status = baking.bake(simulation->scene, arguments.plan); !status) return status;
    if (i + 1 == states.size()) baking.forget_other_states(simulation->scene);
  }
  processes->leave();
  return Ok{};
}

std::string names_of_steps() {
  std::vector<std::string> names;
  for (const render::BakeStep& step : rooms::all_registries().get<render::BakeSteps>().all())
    names.push_back(step.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

void add_bake(CLI::App& app, Chosen& chosen) {
  CLI::App* command = app.add_subcommand(
      "bake", fmt::format("Bakes what takes long and stays the same, and keeps it beside the scene: {}",
                          names_of_steps()));
  const auto arguments = std::make_shared<BakeArguments>();
  arguments->add_scene(*command);
  arguments->add_state(*command);
  command->add_option(
      "--plan", arguments->plan,
      "Also write where the reference maps are, seen from above (.png): discs; rings where as many "
      "are spread evenly over all roads");
  command->footer(
      "Example: parvis bake out/paper/paper.xp --plan places.png\n"
      "NAME.baked beside the script holds the results; view and render read them. Interrupted work resumes "
      "when "
      "the same command is given again. Deletes the results of all states that are not listed with "
      "--scenario.\n"
      "Started by mpirun, several processes or machines divide the work: the same results, sooner.");
  command->callback([arguments, &chosen] { chosen = [arguments] { return bake(*arguments); }; });
}

}  // namespace parvis
