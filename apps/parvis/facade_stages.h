// The stages of `parvis facade`, each in a file of its own: from photographs to a place that can be walked
// through.
#pragma once

#include "commands.h"

namespace parvis {

void add_facade_calibrate(CLI::App& stage, Chosen& chosen);
void add_facade_panorama(CLI::App& stage, Chosen& chosen);
void add_facade_model(CLI::App& stage, Chosen& chosen);
void add_facade_layers(CLI::App& stage, Chosen& chosen);
void add_facade_fill(CLI::App& stage, Chosen& chosen);
void add_facade_pack(CLI::App& stage, Chosen& chosen);
void add_facade_light(CLI::App& stage, Chosen& chosen);
void add_facade_report(CLI::App& stage, Chosen& chosen);
void add_facade_figures(CLI::App& stage, Chosen& chosen);
void add_facade_export(CLI::App& stage, Chosen& chosen);
void add_facade_walk(CLI::App& stage, Chosen& chosen);

/// A stage with its place in the help.
struct FacadeStage {
  const char* name;
  const char* help;
  void (*add)(CLI::App& stage, Chosen& chosen);  ///< adds options, footer and callback
};

inline constexpr FacadeStage facade_stages[] = {
    {"calibrate", "Find the cameras of photographs, and points of the place", add_facade_calibrate},
    {"panorama", "Make a panorama, or photographs from one spot, six calibrated photographs",
     add_facade_panorama},
    {"model", "Propose a coarse model: ground, walls and roofs as named planes", add_facade_model},
    {"layers", "Cut every photograph into layers, as PSD files for an image editor", add_facade_layers},
    {"fill", "Propose what photographs do not see of their layers; accept or refuse it", add_facade_fill},
    {"pack", "Compress the layers, with edits and fillings, into a file and a scene", add_facade_pack},
    {"light", "Find sun and sky of the photographs, for what is inserted", add_facade_light},
    {"report", "Write a page: layers, coverage, proposals, memory", add_facade_report},
    {"figures", "Draw what the stages do with a photograph, as the thesis shows it", add_facade_figures},
    {"export", "Write a packed place as glTF with one texture, for other programs", add_facade_export},
    {"walk", "All of it: from photographs to a scene to walk through", add_facade_walk},
};

}  // namespace parvis
