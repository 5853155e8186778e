// parvis facade layers, fill, pack, report: from a calibrated place with a model to a scene.
#include <memory>

#include "capture/facades/place_report.h"
#include "facade_place.h"
#include "facade_stages.h"

namespace parvis {
namespace {

Status write_layers(const PlaceArguments& arguments, bool fills) {
  const Result<facades::PlaceSource> source = open_place(arguments);
  if (!source) return source.errors();
  const facades::PlaceSettings settings{.fills = fills};
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
  const Result<facades::PlaceLayers> place = open_layers(*source);
  if (!place) return place.errors();
  const std::filesystem::path folder = arguments.folder / "report";
  if (Status status = facades::write_report(folder, *place, facades::packed_facade(*place)); !status)
    return status;
  fmt::print("written to {}\n", (folder / "index.html").string());
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
  stage.add_option("--accept", arguments->accepted,
                   "Proposals to accept: PHOTOGRAPH or PHOTOGRAPH:LAYER, * for all; may repeat");
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

void add_facade_report(CLI::App& stage, Chosen& chosen) {
  const auto arguments = std::make_shared<PlaceArguments>();
  arguments->add(stage);
  stage.footer("Example: parvis facade report courtyard");
  stage.callback([arguments, &chosen] { chosen = [arguments] { return report(*arguments); }; });
}

}  // namespace parvis
