// What the stages of parvis facade after the model have in common: a folder, its model, its layers.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "capture/facades/place_folder.h"

namespace parvis {

struct PlaceArguments {
  std::filesystem::path folder, model;
  std::vector<std::string> left_out;
  facades::PlaceSettings settings;

  /// FOLDER and the choices.
  void add(CLI::App& stage) {
    stage.add_option("folder", folder, "Folder of calibrated photographs")
        ->required()
        ->check(CLI::ExistingDirectory);
    add_choices(stage);
  }
  /// --model, --leave-out, --flatten-shadows and --carry-edits: for a stage that knows the folder.
  void add_choices(CLI::App& stage) {
    stage
        .add_option(
            "--model", model,
            "The place's model, in any format that scenes read; FOLDER/model.glb where it is not given")
        ->check(CLI::ExistingFile);
    stage.add_option("--leave-out", left_out, "A photograph that is not used, by its name; may repeat");
    stage.add_flag("--flatten-shadows", settings.flattens_shadows,
                   "Take out cast shadows that moved with the sun between photographs");
    stage.add_flag("--carry-edits", settings.carries_edits,
                   "Paint what was painted in one photograph's picture into the others that show the place");
  }
};

/// Help of a stage's option `--scan`.
inline constexpr const char* scan_help =
    "A scan of the place, in any format that scenes read, instead of a proposed model; what photographs "
    "contradict each other about at its borders is cut off";
/// Writes the scan, with its borders trimmed by the folder's photographs, as glTF. Notes are written to
/// standard error.
Status write_trimmed_scan(const std::filesystem::path& folder, const std::filesystem::path& scan,
                          const std::filesystem::path& output);

/// The folder's photographs and model. Notes are written to standard error.
Result<facades::PlaceSource> open_place(const PlaceArguments& arguments);
/// Its layers, filled, with choices and edits. Warnings are written to standard error.
Result<facades::PlaceLayers> open_layers(const facades::PlaceSource& source,
                                         const facades::PlaceSettings& settings);
/// Layers, pictures if asked for, pack and scene, with a line for each on standard output.
Status finish_place(const PlaceArguments& arguments, bool writes_pictures);

}  // namespace parvis
