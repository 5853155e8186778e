// parvis facade walk: every stage, from a folder of photographs to a scene to walk through.
#include <memory>

#include "capture/facades/coarse_model_file.h"
#include "capture/photographs/calibrate.h"
#include "facade_place.h"
#include "facade_stages.h"

namespace parvis {
namespace {

struct Arguments {
  photographs::CalibrationJob job;
  PlaceArguments place;
};

Status walk(Arguments& arguments) {
  arguments.place.folder = arguments.job.folder;
  const Result<photographs::LoadedSet> loaded = photographs::calibrate(arguments.job);
  if (!loaded) return loaded.errors();
  fmt::print("{}", photographs::calibration_report(loaded->set));
  fmt::print(stderr, "{}", to_string(loaded->problems));
  const std::filesystem::path file = arguments.job.folder / "model.glb";
  std::error_code code;
  // A model that is there may have been corrected: it is kept.
  if (arguments.place.model.empty() && !std::filesystem::exists(file, code)) {
    const Result<facades::CoarseModel> model = facades::propose_coarse_model(loaded->set);
    if (!model) return model.errors();
    fmt::print(stderr, "{}", to_string(model->notes));
    if (Status status = facades::write_coarse_model(file, *model); !status) return status;
  }
  return finish_place(arguments.place, true);
}

}  // namespace

void add_facade_walk(CLI::App& stage, Chosen& chosen) {
  const auto arguments = std::make_shared<Arguments>();
  stage.add_option("photographs", arguments->job.pictures, "Folder of the photographs")
      ->required()
      ->check(CLI::ExistingDirectory);
  stage.add_option("-o,--output", arguments->job.folder, "Folder to write to; it keeps what is finished")
      ->required();
  stage.add_option("--cameras", arguments->job.cameras,
                   "Cameras that are known; see parvis facade calibrate");
  stage.add_option("--model", arguments->place.model, "A model of the place, in place of a proposed one")
      ->check(CLI::ExistingFile);
  stage.footer("Example: parvis facade walk photographs/ -o courtyard && parvis view courtyard/place.xp");
  stage.callback([arguments, &chosen] { chosen = [arguments] { return walk(*arguments); }; });
}

}  // namespace parvis
