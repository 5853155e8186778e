// parvis facade: photographs of a real place become layered, view-dependent surfaces, stage by stage.
#include "facade_stages.h"

namespace parvis {

void add_facade(CLI::App& app, Chosen& chosen) {
  CLI::App* command = app.add_subcommand("facade", "From photographs of a place to surfaces to walk along");
  command->require_subcommand(1);
  command->footer("Example: parvis facade calibrate photographs/ -o courtyard");
  for (const FacadeStage& stage : facade_stages)
    stage.add(*command->add_subcommand(stage.name, stage.help), chosen);
}

}  // namespace parvis
