// The stages of `parvis facade`, each in a file of its own: from photographs to a place that can be walked
// through.
#pragma once

#include "commands.h"

namespace parvis {

void add_facade_calibrate(CLI::App& stage, Chosen& chosen);
void add_facade_model(CLI::App& stage, Chosen& chosen);

/// A stage with its place in the help.
struct FacadeStage {
  const char* name;
  const char* help;
  void (*add)(CLI::App& stage, Chosen& chosen);  ///< adds options, footer and callback
};

inline constexpr FacadeStage facade_stages[] = {
    {"calibrate", "Find the cameras of photographs, and points of the place", add_facade_calibrate},
    {"model", "Propose a coarse model: ground, walls and roofs as named planes", add_facade_model},
};

}  // namespace parvis
