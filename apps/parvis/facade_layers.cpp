// parvis facade layers, fill, pack, report, figures: from a calibrated place with a model to a scene.
#include <algorithm>
#include <memory>

#include "base/image_io.h"
#include "base/known_names.h"
#include "base/path_inside.h"
#include "capture/facades/held_out.h"
#include "capture/facades/place_figures.h"
#include "capture/facades/place_report.h"
#include "capture/facades/rephotography.h"
#include "facade_place.h"
#include "facade_stages.h"
#include "graphics/reference/metrics.h"

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
  return Ok{};
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

/// A row for each method and photograph that was left out, and for each method's means.
Status judge_left_out(const std::vector<photographs::Photograph>& left_out, const facades::PlaceSource& used,
                      const facades::PlaceLayers& place, const facades::PackedFacade& facade) {
  const std::vector<facades::PreparedPhoto> prepared = facades::prepared_as_layers(used.photographs, place);
  struct Row {
    std::string method;
    int count = 0;  ///< photographs that show the model by it
    double psnr_db = 0.0, psnr_cc_db = 0.0, ssim = 0.0, covered_percent = 0.0;
  };
  std::vector<Row> means;
  const auto print = [](const std::string& name, const Row& row) {
    if (row.count == 0) {
      fmt::print("{:<24} {:<26} shows nothing of the model\n", name, row.method);
      return;
    }
    fmt::print("{:<24} {:<26} {:>8.2f} {:>14.2f} {:>6.3f} {:>10.1f}\n", name, row.method, row.psnr_db,
               row.psnr_cc_db, row.ssim, row.covered_percent);
  };
  fmt::print("{:<24} {:<26} {:>8} {:>14} {:>6} {:>10}\n", "left out", "method", "PSNR dB", "with its light",
             "SSIM", "covered %");
  for (const photographs::Photograph& photo : left_out) {
    const Result<facades::View> view = facades::view_of(photo);
    if (!view) return view.errors();
    const Result<Image8> truth = read_image8(photo.file);
    if (!truth) return truth.errors();
    const Image8 model = facades::model_mask(place.model, *view);
    const std::vector<facades::MethodView> shown = facades::views_of_methods(place, facade, prepared, *view);
    means.resize(shown.size());
    for (std::size_t m = 0; m < shown.size(); ++m) {
      const facades::Rephotography judged = facades::rephotography(shown[m].picture, *truth, model);
      Image8 covered = model;
      for (std::size_t i = 0; i < covered.pixels.size(); ++i)
        if (shown[m].picture.pixels[4 * i + 3] == 0) covered.pixels[i] = 0;
      const Result<reference::Difference> difference = reference::compare(shown[m].picture, *truth, covered);
      const Row row{shown[m].method,   judged.covered_percent > 0.0,        judged.psnr_db,
                    judged.psnr_cc_db, difference ? difference->ssim : 0.0, judged.covered_percent};
      print(photo.name, row);
      Row& mean = means[m];
      mean.method = row.method;
      if (row.count == 0) continue;
      const double share = 1.0 / ++mean.count;
      mean.psnr_db += share * (row.psnr_db - mean.psnr_db);
      mean.psnr_cc_db += share * (row.psnr_cc_db - mean.psnr_cc_db);
      mean.ssim += share * (row.ssim - mean.ssim);
      mean.covered_percent += share * (row.covered_percent - mean.covered_percent);
    }
  }
  if (left_out.size() > 1)
    for (const Row& row : means) print("mean", row);
  return Ok{};
}

Status report(const PlaceArguments& arguments) {
  PlaceArguments all = arguments;
  all.left_out.clear();
  Result<facades::PlaceSource> source = open_place(all);
  if (!source) return source.errors();
  std::vector<photographs::Photograph> left_out;
  std::vector<std::string> names;
  for (const photographs::Photograph& photo : source->photographs) names.push_back(photo.name);
  for (const std::string& name : arguments.left_out) {
    const auto found = std::ranges::find(source->photographs, name, &photographs::Photograph::name);
    if (found == source->photographs.end())
      return error("{}: there is no photograph \"{}\" to leave out{}", arguments.folder.string(), name,
                   names_that_exist(name, names));
    left_out.push_back(*found);
    source->photographs.erase(found);
  }
  const Result<facades::PlaceLayers> place = open_layers(*source, arguments.settings);
  if (!place) return place.errors();
  const Result<std::filesystem::path> inside = path_inside(arguments.folder, "report");
  if (!inside) return inside.errors();
  const std::filesystem::path& folder = *inside;
  const facades::PackedFacade facade = facades::packed_facade(*place);
  if (Status status = facades::write_report(folder, *place, facade); !status) return status;
  if (!left_out.empty())
    if (Status status = judge_left_out(left_out, *source, *place, facade); !status) return status;
  fmt::print("written to {}\n", (folder / "index.html").string());
  return Ok{};
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
  return Ok{};
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
