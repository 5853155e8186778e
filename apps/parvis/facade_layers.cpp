// parvis facade layers, fill, pack, report, figures: from a calibrated place with a model to a scene.
#include <memory>

#include "base/known_names.h"
#include "base/path_inside.h"
#include "capture/facades/place_figures.h"
#include "capture/facades/place_report.h"
#include "facade_place.h"
#include "facade_stages.h"

namespace parvis {
namespace {

Status write_layers(const PlaceArguments& arguments, bool fills) {
  const Result<facades::PlaceSource> source = open_place(arguments);
  if (!source) return source.errors();
  facades::PlaceSettings settings = arguments.settings;
  settings.fills = fills;
  const Result<facades::PlaceLayers> place = open_layers(*source, settings);
  if (!place) return place.errors();
  for (std::size_t i = 0; i < place->names.size(); ++i) {
    const auto count = [&](facades::Filling state) {
      return std::ranges::count(place->filled[i].states, state);
    };
    fmt::print(
        "{:<24} {:>4} layers in {:>3} visibility layers, {:>4} proposals, {:>4} accepted, {:>4} refused\n",
        place->names[i], place->layered[i].layers.size(), place->visibility[i].layers.size(),
        count(facades::Filling::proposal), count(facades::Filling::accepted),
        count(facades::Filling::refused));
  }
  if (Status status = facades::write_layered_pictures(*source, *place); !status) return status;
  fmt::print("written to {}\n", (arguments.folder / "layers").string());
  return Done{};
}

struct FillArguments {
  PlaceArguments place;
  std::vector<std::string> accepted, refused;
};

/// "PHOTOGRAPH", or "PHOTOGRAPH:LAYER"; "*" for all.
facades::FillingChoice choice_of(const std::string& text, facades::Filling state) {
  const std::size_t colon = text.find(':');
  return {text.substr(0, colon), colon == std::string::npos ? "*" : text.substr(colon + 1), state};
}

Status fill(const FillArguments& arguments) {
  std::vector<facades::FillingChoice> choices;
  for (const std::string& text : arguments.accepted)
    choices.push_back(choice_of(text, facades::Filling::accepted));
  for (const std::string& text : arguments.refused)
    choices.push_back(choice_of(text, facades::Filling::refused));
  if (!choices.empty())
    if (Status status = facades::write_choices(arguments.place.folder, choices); !status) return status;
  return write_layers(arguments.place, true);
}

Status report(const PlaceArguments& arguments) {
  const Result<facades::PlaceSource> source = open_place(arguments);
  if (!source) return source.errors();
  const Result<facades::PlaceLayers> place = open_layers(*source, arguments.settings);
  if (!place) return place.errors();
  const Result<std::filesystem::path> inside = path_inside(arguments.folder, "report");
  if (!inside) return inside.errors();
  const std::filesystem::path& folder = *inside;
  if (Status status = facades::write_report(folder, *place, facades::packed_facade(*place)); !status)
    return status;
  fmt::print("written to {}\n", (folder / "index.html").string());
  return Done{};
}

struct FigureArguments {
  PlaceArguments place;
  std::string photograph;
  std::filesystem::path output;
};

Status draw_figures(const FigureArguments& arguments) {
  const Result<facades::PlaceSource> source = open_place(arguments.place);
  if (!source) return source.errors();
  const Result<facades::PlaceLayers> place = open_layers(*source, arguments.place.settings);
  if (!place) return place.errors();
  const auto named = std::ranges::find(place->names, arguments.photograph);
  if (!arguments.photograph.empty() && named == place->names.end())
    return error("{}: there is no photograph \"{}\"{}", arguments.place.folder.string(), arguments.photograph,
                 names_that_exist(arguments.photograph, place->names));
  const std::size_t photo = arguments.photograph.empty() ? facades::richest_photograph(*place)
                                                         : std::size_t(named - place->names.begin());
  const Result<std::filesystem::path> output =
      arguments.output.empty() ? path_inside(arguments.place.folder, "figures") : arguments.output;
  if (!output) return output.errors();
  const std::filesystem::path& folder = *output;
  if (Status status = facades::write_figures(folder, *place, facades::packed_facade(*place), photo); !status)
    return status;
  const facades::Coverage coverage = facades::coverage_of(*place);
  fmt::print(
      "of photograph {}; three photographs see {:.1f} % of the common view, their layers hold {:.1f} %\n",
      place->names[photo], coverage.seen_percent, coverage.layered_percent);
  fmt::print("written to {}\n", folder.string());
  return Done{};
}

}  // namespace

void add_facade_layers(CLI::App& stage, Chosen& chosen) {
  const auto arguments = std::make_shared<PlaceArguments>();
  arguments->add(stage);
  stage.footer("Example: parvis facade layers courtyard");
  stage.callback([arguments, &chosen] { chosen = [arguments] { return write_layers(*arguments, false); }; });
}

void add_facade_fill(CLI::App& stage, Chosen& chosen) {
  const auto arguments = std::make_shared<FillArguments>();
  arguments->place.add(stage);
  stage.add_option(
      "--accept", arguments->accepted,
      "Proposals to accept: PHOTOGRAPH or PHOTOGRAPH:LAYER, surfaces:NAME for the colours of what no "
      "photograph shows, * for all; may repeat");
  stage.add_option("--refuse", arguments->refused, "Proposals to refuse, named the same way; may repeat");
  stage.footer("Example: parvis facade fill courtyard --accept '*' --refuse '0004.jpg:L01-002 wall_3'");
  stage.callback([arguments, &chosen] { chosen = [arguments] { return fill(*arguments); }; });
}

void add_facade_pack(CLI::App& stage, Chosen& chosen) {
  const auto arguments = std::make_shared<PlaceArguments>();
  arguments->add(stage);
  stage.footer("Example: parvis facade pack courtyard");
  stage.callback([arguments, &chosen] { chosen = [arguments] { return finish_place(*arguments, false); }; });
}

void add_facade_figures(CLI::App& stage, Chosen& chosen) {
  const auto arguments = std::make_shared<FigureArguments>();
  arguments->place.add(stage);
  stage.add_option("--photograph", arguments->photograph,
                   "Whose layers are shown; where it is not given the one with the most layers");
  stage.add_option("-o,--output", arguments->output,
                   "Folder to write to; FOLDER/figures where it is not given");
  stage.footer("Example: parvis facade figures courtyard --photograph 0004.jpg");
  stage.callback([arguments, &chosen] { chosen = [arguments] { return draw_figures(*arguments); }; });
}

void add_facade_report(CLI::App& stage, Chosen& chosen) {
  const auto arguments = std::make_shared<PlaceArguments>();
  arguments->add(stage);
  stage.footer("Example: parvis facade report courtyard");
  stage.callback([arguments, &chosen] { chosen = [arguments] { return report(*arguments); }; });
}

}  // namespace parvis
