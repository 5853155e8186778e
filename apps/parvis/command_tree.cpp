// parvis tree: a real tree from photographs.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>

#include "base/files.h"
#include "base/image_io.h"
#include "base/kept_parts.h"
#include "base/path_inside.h"
#include "capture/trees/billboard_textures.h"
#include "capture/trees/block_table.h"
#include "capture/trees/capture_folder.h"
#include "capture/trees/consistent_views.h"
#include "capture/trees/judge.h"
#include "capture/trees/matte_folder.h"
#include "capture/trees/measure.h"
#include "capture/trees/organs.h"
#include "capture/trees/reconstruction.h"
#include "capture/trees/sample_trees.h"
#include "capture/trees/shown_tree.h"
#include "capture/trees/synthetic_capture.h"
#include "capture/trees/texture_codes.h"
#include "capture/trees/tree_file.h"
#include "commands.h"
#include "formats/gltf/gltf_writer.h"
#include "graphics/gl/context.h"
#include "interruption.h"
#include "stage/output_names.h"
#include "strict_numbers.h"
#include "tree_products.h"

namespace parvis {
namespace {

/// The steps that a command has done, kept beside its output until that is written.
KeptParts checkpoint_of(const std::filesystem::path& output) {
  return KeptParts(stage::file_beside(output, ".steps"));
}

struct SynthesizeArguments {
  std::string name;
  std::filesystem::path folder;
  int views = 22, held_out = 0;
  std::string size = "800x800";
  trees::CaptureOptions capture;
  trees::CaptureLight light;
  std::uint64_t seed = 1;
};

struct ReconstructArguments {
  std::filesystem::path capture, output;
  trees::ReconstructionOptions options;
};

struct TextureArguments {
  std::filesystem::path capture, volume, output;
  trees::TextureOptions options;
  bool keeps_inconsistent = false, has_trunk = false;
};

struct FileArguments {
  std::filesystem::path file, capture, pictures;
};

struct PackArguments {
  std::filesystem::path file, output;
  std::size_t codes = 16384;
};

const std::map<std::string, trees::OpacityMethod> opacity_methods{
    {"projection", trees::OpacityMethod::projection},
    {"sirt", trees::OpacityMethod::sirt},
    {"multiplicative", trees::OpacityMethod::multiplicative}};
const std::map<std::string, trees::MatteMethod> matte_methods{{"clusters", trees::MatteMethod::clusters},
                                                              {"laplacian", trees::MatteMethod::laplacian}};
const std::map<std::string, trees::TextureMethod> texture_methods{
    {"optimised", trees::TextureMethod::optimised},
    {"age_importance", trees::TextureMethod::age_importance},
    {"naive", trees::TextureMethod::naive},
    {"random_texels", trees::TextureMethod::random_texels}};

/// An option of which the values have names. (CLI11's own transformation prints numbers as bytes in its
/// help.)
template <class Value>
void add_choice(CLI::App& command, const char* option, Value& value,
                const std::map<std::string, Value>& values, const char* help) {
  std::vector<std::string> names;
  for (const auto& [name, ignored] : values) names.push_back(name);
  const auto choose = [&value, &values](const std::string& name) { value = values.at(name); };
  command.add_option_function<std::string>(option, choose, help)
      ->check(CLI::IsMember(names, CLI::ignore_case));
}

/// The measures of a tree, a row each; where it is a model, those of volumes are left out.
std::string measure_rows(const trees::TreeMeasures& m) {
  std::string rows =
      fmt::format("height {:.2f} m\ncrown base {:.2f} m\ncrown width {:.2f} m\ncrown volume {:.1f} m3\n",
                  m.height_m, m.crown_base_m, m.crown_width_m, m.crown_volume_m3);
  if (m.projected_area_m2 > 0.0f) rows += fmt::format("projected area {:.1f} m2\n", m.projected_area_m2);
  rows += fmt::format("trunk diameter {:.2f} m\n", m.trunk_diameter_m);
  if (m.leaf_area_density_per_m.empty()) return rows;
  rows += "leaf area density per tenth of the height, from below (1/m):";
  for (const float density : m.leaf_area_density_per_m) rows += fmt::format(" {:.2f}", density);
  return rows + "\n";
}

/// The tree that was photographed, and its measures as `parvis tree measure` prints them.
Status write_truth(const std::filesystem::path& folder, const scene::Model& model) {
  const Result<std::filesystem::path> mesh = path_inside(folder, "truth.glb"),
                                      rows = path_inside(folder, "truth.txt");
  if (!mesh) return mesh.errors();
  if (!rows) return rows.errors();
  if (Status status = scene::write_gltf(*mesh, model); !status) return status;
  return write_file(*rows, measure_rows(trees::measured(model)));
}

Status synthesize(SynthesizeArguments arguments) {
  if (Status status = parse_size(arguments.size, arguments.capture.width, arguments.capture.height); !status)
    return status;
  if (arguments.capture.width < 16 || arguments.capture.height < 16 || arguments.capture.width > 8192 ||
      arguments.capture.height > 8192)
    return error("--size {}: expected WIDTHxHEIGHT from 16x16 to 8192x8192", arguments.size);
  const Result<scene::Model> model = trees::make_sample_tree(arguments.name, arguments.seed);
  if (!model) return model.errors();
  const scene::Scene scene = trees::capture_scene(*model, arguments.light);
  const Bounds bounds = scene::bounds(*model);
  const KeptParts checkpoint = checkpoint_of(arguments.folder);
  const auto write = [&](const std::filesystem::path& folder, const std::vector<Camera>& cameras,
                         const std::string& name) -> Status {
    const Result<std::vector<trees::TreeView>> views =
        trees::photograph_tree(scene, cameras, name, arguments.capture, checkpoint);
    return views ? trees::write_capture(folder, *views) : Status(views.errors());
  };
  if (Status status =
          write(arguments.folder, trees::capture_cameras(bounds, arguments.views), arguments.name);
      !status)
    return status;
  if (arguments.held_out > 0) {
    arguments.capture.seed += 76;
    const Result<std::filesystem::path> held_out = path_inside(arguments.folder, "held_out");
    if (!held_out) return held_out.errors();
    if (Status status =
            write(*held_out, trees::held_out_cameras(bounds, arguments.held_out, arguments.seed + 4),
                  arguments.name + "_held_out");
        !status)
      return status;
  }
  if (Status status = write_truth(arguments.folder, *model); !status) return status;
  checkpoint.remove();
  return Ok{};
}

Status mattes(const trees::MatteFolder& folder) {
  const Result<trees::MatteCounts> counts = trees::write_mattes(folder);
  if (!counts) return counts.errors();
  fmt::print("{}: {} mattes made{}, {} were up to date, {} are not as made and were kept\n",
             folder.output.string(), counts->made,
             counts->doubtful > 0 ? fmt::format(" ({} cannot be right)", counts->doubtful) : "",
             counts->up_to_date, counts->foreign);
  return Ok{};
}

Status reconstruct(ReconstructArguments arguments) {
  const Result<std::vector<trees::TreeView>> views = trees::read_capture(arguments.capture);
  if (!views) return views.errors();
  const Result<machines::Processes> processes = machines::Processes::join();
  if (!processes) return processes.errors();
  arguments.options.processes = *processes;
  const KeptParts checkpoint = checkpoint_of(arguments.output);
  arguments.options.checkpoint = checkpoint.folder();
  arguments.options.is_interrupted = &interruption();
  const Result<trees::Reconstruction> made = trees::reconstruct(*views, arguments.options);
  if (!made) return made.errors();
  processes->leave();
  if (!processes->is_first()) return Ok{};  // all have the same cells
  for (const std::string& row : made->notes) fmt::print("{}\n", row);
  const Result<std::size_t> bytes = trees::write_volume(arguments.output, made->volume);
  if (!bytes) return bytes.errors();
  checkpoint.remove();
  fmt::print("{}: {} cells, {:.2f} MB, {} process{}\n", arguments.output.string(), made->volume.grid.size(),
             double(*bytes) * 1e-6, processes->count(), processes->are_several() ? "es" : "");
  return Ok{};
}

/// The sun that was found in the textures, for people.
std::string light_row(const trees::CapturedLight& light) {
  const float azimuth = glm::degrees(std::atan2(light.to_sun.x, light.to_sun.y));
  return fmt::format(
      "light of the photographs: sun at azimuth {:.0f}, height {:.0f} degrees, {:.2f} of the light",
      azimuth < 0.0f ? azimuth + 360.0f : azimuth, glm::degrees(std::asin(light.to_sun.z)),
      light.sun / std::max(light.sun + light.sky, 1e-6f));
}

Status texture(const TextureArguments& arguments) {
  Result<std::vector<trees::TreeView>> views = trees::read_capture(arguments.capture);
  if (!views) return views.errors();
  for (const std::string& note : trees::leave_out_inconsistent(*views, arguments.keeps_inconsistent))
    fmt::print("{}\n", note);
  Result<trees::TreeVolume> volume = trees::read_volume(arguments.volume);
  if (!volume) return volume.errors();
  std::optional<trees::TrunkShape> trunk;
  if (arguments.has_trunk) {
    const trees::Organs organs = trees::organs_of(*volume);
    Result<trees::TrunkShape> found = trees::trunk_shape(organs, *views);
    if (!found) return found.errors();
    trees::erase_trunk(*views, *volume, organs);
    trunk = *std::move(found), *volume = trees::without(*volume, organs, trees::Organ::trunk);
  }
  const KeptParts checkpoint = checkpoint_of(arguments.output);
  Result<trees::BillboardTree> tree = trees::textured(*volume, *views, arguments.options, checkpoint);
  if (!tree) return tree.errors();
  tree->trunk = std::move(trunk);
  const Result<std::size_t> bytes = trees::write_tree(arguments.output, *tree);
  if (!bytes) return bytes.errors();
  checkpoint.remove();
  fmt::print("{}: {} billboards, {:.2f} MB\n", arguments.output.string(), tree->grid.size(),
             double(*bytes) * 1e-6);
  fmt::print("{}\n", light_row(tree->light));
  return Ok{};
}

/// Prints how much the thesis's packing would save; with codes, the tree by vector quantisation.
Status pack(const PackArguments& arguments) {
  Result<trees::BillboardTree> tree = trees::read_tree(arguments.file);
  if (!tree) return tree.errors();
  const trees::Packing packing = trees::packed_disjoint_alphas(*tree);
  const double raw = 4e-6 * double(packing.textures) * tree->texels_per_side * tree->texels_per_side;
  std::error_code code;
  fmt::print(
      "{} textures, {} after packing disjoint alphas: {:.1f} MB become {:.1f} MB ({:.0f} %); this file "
      "{:.2f} MB\n",
      packing.textures, packing.packed, raw, raw * packing.ratio(), 100.0 * packing.ratio(),
      1e-6 * double(std::filesystem::file_size(arguments.file, code)));
  if (arguments.output.empty()) return Ok{};
  const Result<trees::Quantisation> done = trees::quantise_textures(*tree, arguments.codes);
  if (!done) return done.errors();
  const Result<std::size_t> bytes = trees::write_tree(arguments.output, *tree);
  if (!bytes) return bytes.errors();
  fmt::print("{}: {} blocks of 4 x 4 texels share {} codes, {:.2f} MB; texels differ by {:.4f} ({:.1f} dB)\n",
             arguments.output.string(), done->blocks, done->codes, 1e-6 * double(*bytes), done->rmse,
             done->psnr_db());
  return Ok{};
}

Status measure(const FileArguments& arguments) {
  const Result<trees::TreeVolume> volume = trees::read_volume(arguments.file);
  if (!volume) return volume.errors();
  fmt::print("{}", measure_rows(trees::measured(*volume)));
  return Ok{};
}

/// Compares what the renderer draws, in the light of the photographs, with views of the real tree.
Status report(const FileArguments& arguments) {
  Result<trees::BillboardTree> tree = trees::read_tree(arguments.file);
  if (!tree) return tree.errors();
  const Result<std::vector<trees::TreeView>> views = trees::read_capture(arguments.capture);
  if (!views) return views.errors();
  const Result<gl::Context> context = gl::Context::create_headless();
  if (!context) return context.errors();
  const scene::Scene light = trees::scene_in_light_of(tree->light);
  fmt::print("{}\n", light_row(tree->light));
  Result<trees::ShownTree> shown = trees::ShownTree::create(
      std::make_shared<const trees::TreeLevels>(trees::levels_of(*std::move(tree))), light);
  if (!shown) return shown.errors();
  trees::ViewErrors mean;
  for (const trees::TreeView& view : *views) {
    const Result<ImageF> picture = shown->picture(view.camera);
    if (!picture) return picture.errors();
    const Result<trees::ViewErrors> errors = trees::judged(*picture, view);
    if (!errors) return errors.errors();
    fmt::print("{}: PSNR {:.2f} dB, SSIM {:.3f}, FLIP {:.3f}, alpha RMSE {:.4f}, silhouette IoU {:.3f}\n",
               view.name, errors->psnr_db, errors->ssim, errors->flip, errors->alpha_rmse,
               errors->silhouette_iou);
    mean += *errors;
    if (!arguments.pictures.empty()) {
      std::error_code code;
      std::filesystem::create_directories(arguments.pictures, code);
      const std::string name = std::filesystem::path(view.name).stem().string() + ".png";
      if (Status status = write_image(arguments.pictures / name, trees::over_white(*picture)); !status)
        return status;
    }
  }
  mean /= double(views->size());
  fmt::print(
      "mean of {} views: PSNR {:.2f} dB, SSIM {:.3f}, FLIP {:.3f}, alpha RMSE {:.4f}, silhouette IoU "
      "{:.3f}\n",
      views->size(), mean.psnr_db, mean.ssim, mean.flip, mean.alpha_rmse, mean.silhouette_iou);
  return Ok{};
}

void add_synthesize(CLI::App& tree, Chosen& chosen) {
  CLI::App* command =
      tree.add_subcommand("synthesize", "Photographs a procedural tree: a capture with truth");
  const auto arguments = std::make_shared<SynthesizeArguments>();
  command->add_option("name", arguments->name, "orange, oak, pine or winter")->required();
  command->add_option("-o,--output", arguments->folder, "The folder to write")->required();
  command->add_option("--views", arguments->views, "Photographs in a ring")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  command->add_option("--held-out", arguments->held_out, "Further views, into OUTPUT/held_out")
      ->check(CLI::Range(0, 1000));
  command->add_option("--size", arguments->size, "WIDTHxHEIGHT in pixels")->capture_default_str();
  command->add_option("--samples", arguments->capture.samples_per_pixel, "Paths per pixel")
      ->capture_default_str()
      ->check(CLI::Range(1, 4096));
  command
      ->add_option("--sun", arguments->light.sun_azimuth_deg,
                   "Azimuth of the sun, degrees clockwise from north")
      ->capture_default_str();
  command->add_option("--seed", arguments->seed, "Another seed gives another tree")->capture_default_str();
  command->footer(
      "Interrupted, it goes on when the same command is given again.\n"
      "Example: parvis tree synthesize oak --views 22 --held-out 8 -o out/oak");
  command->callback([arguments, &chosen] { chosen = [arguments] { return synthesize(*arguments); }; });
}

void add_matte(CLI::App& tree, Chosen& chosen) {
  CLI::App* command = tree.add_subcommand("matte", "Alpha and pure foreground of photographs");
  const auto arguments = std::make_shared<trees::MatteFolder>();
  command->add_option("photographs", arguments->photographs, "A folder of .png and .jpg pictures")
      ->required();
  command->add_option("-o,--output", arguments->output, "The folder for the RGBA pictures")->required();
  command->add_option(
      "--zones", arguments->zones,
      "A folder of small pictures of the same names, .png: background painted red, tree green; photographs "
      "without one have a matte already, a plain background, or the sky behind them");
  add_choice(*command, "--method", arguments->method, matte_methods,
             "clusters (the thesis), or laplacian: alpha flows along what looks alike");
  command->footer("Example: parvis tree matte photographs --zones zones -o capture");
  command->callback([arguments, &chosen] { chosen = [arguments] { return mattes(*arguments); }; });
}

void add_reconstruct(CLI::App& tree, Chosen& chosen) {
  CLI::App* command = tree.add_subcommand(
      "reconstruct", "Estimates opacity and colour of a grid's cells from RGBA photographs");
  const auto arguments = std::make_shared<ReconstructArguments>();
  command->add_option("capture", arguments->capture, "Folder of RGBA pictures with a COLMAP model")
      ->required();
  command->add_option("-o,--output", arguments->output, "The volume (.volume)")->required();
  add_choice(*command, "--method", arguments->options.opacity.method, opacity_methods,
             "projection (the thesis), sirt or multiplicative");
  command->add_option("--level", arguments->options.grid.level, "Divisions of the grid for opacity")
      ->capture_default_str()
      ->check(CLI::Range(1, 9));
  command->add_option("--iterations", arguments->options.opacity.iterations, "Of the opacity estimate")
      ->capture_default_str()
      ->check(CLI::Range(0, 1000));
  command
      ->add_option("--coarse-epochs", arguments->options.coarse_epochs,
                   "Passes over the photographs that fit colours and opacity together; 0: none")
      ->capture_default_str()
      ->check(CLI::Range(0, 1000));
  command
      ->add_option("--fine-epochs", arguments->options.fine_epochs,
                   "Passes over the photographs at one level more; 0: none")
      ->capture_default_str()
      ->check(CLI::Range(0, 1000));
  command
      ->add_option("--cutoff", arguments->options.cutoff,
                   "Transparency above which a cell is empty (default: by held-out error)")
      ->check(CLI::Range(0.0f, 1.0f));
  command->add_flag("--keep-inconsistent", arguments->options.keeps_inconsistent,
                    "Use a photograph whose silhouette contradicts all others, which is left out else");
  command->footer(
      "Interrupted, it goes on when the same command is given again.\n"
      "Example: parvis tree reconstruct out/oak -o out/oak.volume");
  command->callback([arguments, &chosen] { chosen = [arguments] { return reconstruct(*arguments); }; });
}

void add_texture(CLI::App& tree, Chosen& chosen) {
  CLI::App* command = tree.add_subcommand("texture", "Makes the billboards' textures");
  const auto arguments = std::make_shared<TextureArguments>();
  command->add_option("capture", arguments->capture, "Folder of RGBA pictures with a COLMAP model")
      ->required();
  command->add_option("volume", arguments->volume, "From parvis tree reconstruct")->required();
  command->add_option("-o,--output", arguments->output, "The tree (.tree)")->required();
  add_choice(*command, "--method", arguments->options.method, texture_methods,
             "optimised, age_importance (the thesis), naive, random_texels");
  command
      ->add_option("--texels", arguments->options.texels_per_side,
                   "Texels along a billboard's side; 0: as fine as the photographs, below 6 MB")
      ->capture_default_str()
      ->check(CLI::IsMember({0, 4, 8, 12, 16}));
  command
      ->add_option("--parents", arguments->options.parent_levels,
                   "Levels by which billboards are coarser than the volume")
      ->capture_default_str()
      ->check(CLI::Range(0, 4));
  command->add_flag("--trunk", arguments->has_trunk,
                    "The trunk as geometry within the tree, in place of its billboards");
  command->add_flag("--keep-inconsistent", arguments->keeps_inconsistent,
                    "Use a photograph whose silhouette contradicts all others, which is left out else");
  command->footer(
      "Interrupted, it goes on when the same command is given again.\n"
      "Example: parvis tree texture out/oak out/oak.volume -o out/oak.tree");
  command->callback([arguments, &chosen] { chosen = [arguments] { return texture(*arguments); }; });
}

void add_pack(CLI::App& tree, Chosen& chosen) {
  CLI::App* command = tree.add_subcommand(
      "pack",
      "What the thesis's packing of disjoint alphas saves; with -o, a smaller tree by vector quantisation");
  const auto arguments = std::make_shared<PackArguments>();
  command->add_option("file", arguments->file, "The tree (.tree, or such a .glb)")->required();
  CLI::Option* output =
      command->add_option("-o,--output", arguments->output, "The smaller tree (.tree, .glb)");
  command
      ->add_option("--codes", arguments->codes,
                   "Blocks of 4 x 4 texels that all textures share, at most so many")
      ->capture_default_str()
      ->check(CLI::Range(std::size_t(1), trees::BlockTable::max_blocks))
      ->needs(output);
  command->footer("Example: parvis tree pack out/oak.tree --codes 16384 -o out/oak_small.tree");
  command->callback([arguments, &chosen] { chosen = [arguments] { return pack(*arguments); }; });
}

void add_on_file(CLI::App& tree, Chosen& chosen, const char* name, const char* help, const char* file,
                 const char* example, Status (*act)(const FileArguments&), bool takes_capture) {
  CLI::App* command = tree.add_subcommand(name, help);
  const auto arguments = std::make_shared<FileArguments>();
  command->add_option("file", arguments->file, file)->required();
  if (takes_capture) {
    command
        ->add_option("capture", arguments->capture,
                     "Folder of the views to compare with, such as CAPTURE/held_out")
        ->required();
    command->add_option("--pictures", arguments->pictures,
                        "Also write what the tree shows, over white, into this folder");
  }
  command->footer(example);
  command->callback([arguments, act, &chosen] { chosen = [arguments, act] { return act(*arguments); }; });
}

}  // namespace

void add_tree(CLI::App& app, Chosen& chosen) {
  CLI::App* tree =
      app.add_subcommand("tree", "A real tree from photographs: billboards that can be walked round");
  tree->require_subcommand(1);
  add_synthesize(*tree, chosen);
  add_matte(*tree, chosen);
  add_reconstruct(*tree, chosen);
  add_texture(*tree, chosen);
  add_pack(*tree, chosen);
  add_on_file(*tree, chosen, "measure", "Height, crown, trunk and leaf area density", "The volume (.volume)",
              "Example: parvis tree measure out/oak.volume", measure, false);
  add_on_file(*tree, chosen, "report", "Compares a tree with views of the real one", "The tree (.tree)",
              "Example: parvis tree report out/oak.tree out/oak/held_out --pictures out/pictures", report,
              true);
  add_tree_products(*tree, chosen);
  tree->footer(
      "Example: parvis tree synthesize oak -o out/oak, then parvis tree reconstruct out/oak -o "
      "out/oak.volume");
}

}  // namespace parvis
