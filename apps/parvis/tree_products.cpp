#include "tree_products.h"

#include <filesystem>
#include <memory>

#include "capture/trees/capture_folder.h"
#include "capture/trees/consistent_views.h"
#include "capture/trees/figures.h"
#include "capture/trees/new_individual.h"
#include "capture/trees/organs.h"
#include "capture/trees/tree_file.h"
#include "formats/gltf/gltf_writer.h"

namespace parvis {
namespace {

namespace fs = std::filesystem;

struct OrgansArguments {
  fs::path volume, capture, trunk, rest;
};

Status organs(const OrgansArguments& arguments) {
  const Result<trees::TreeVolume> volume = trees::read_volume(arguments.volume);
  if (!volume) return volume.errors();
  const trees::Organs found = trees::organs_of(*volume);
  using enum trees::Organ;
  fmt::print("of the opacity {:.1f} % trunk, {:.1f} % branches, {:.1f} % leaves\n",
             100.0f * found.share(*volume, trunk), 100.0f * found.share(*volume, branch),
             100.0f * found.share(*volume, leaf));
  if (!found.trunk.rings.empty())
    fmt::print("trunk: {} rings to {:.2f} m above the foot, radius {:.2f} m below, {:.2f} m above\n",
               found.trunk.rings.size(),
               found.trunk.rings.back().centre.z - found.trunk.rings.front().centre.z,
               found.trunk.rings.front().radius_m, found.trunk.rings.back().radius_m);
  if (!arguments.trunk.empty()) {
    if (arguments.capture.empty())
      return error("--trunk: the bark is taken from photographs: name the capture with --capture");
    Result<std::vector<trees::TreeView>> views = trees::read_capture(arguments.capture);
    if (!views) return views.errors();
    for (const std::string& note : trees::leave_out_inconsistent(*views, false)) fmt::print("{}\n", note);
    const Result<trees::TrunkShape> trunk = trees::trunk_shape(found, *views);
    if (!trunk) return trunk.errors();
    if (Status status = scene::write_gltf(arguments.trunk, trees::model_of(*trunk)); !status) return status;
  }
  if (arguments.rest.empty()) return Ok{};
  const Result<std::size_t> bytes =
      trees::write_volume(arguments.rest, trees::without(*volume, found, trunk));
  if (!bytes) return bytes.errors();
  return Ok{};
}

struct TreeToTree {
  fs::path from, to;
  std::uint64_t seed = 1;
};

Status write(const fs::path& to, const trees::BillboardTree& tree) {
  const Result<std::size_t> bytes = trees::write_tree(to, tree);
  if (!bytes) return bytes.errors();
  fmt::print("{}: {} billboards, {:.2f} MB\n", to.string(), tree.grid.size(), double(*bytes) * 1e-6);
  return Ok{};
}

Status vary(const TreeToTree& arguments) {
  const Result<trees::BillboardTree> tree = trees::read_tree(arguments.from);
  if (!tree) return tree.errors();
  return write(arguments.to, trees::new_individual(*tree, arguments.seed));
}

Status export_tree(const TreeToTree& arguments) {
  const std::string extension = arguments.to.extension().string();
  if (extension != ".glb" && extension != ".tree")
    return error("--output {}: expected a file that ends in .glb or .tree", arguments.to.string());
  const Result<trees::BillboardTree> tree = trees::read_tree(arguments.from);
  return tree ? write(arguments.to, *tree) : tree.errors();
}

struct FiguresArguments {
  fs::path capture, output;
  int level = 3;
};

Status figures(const FiguresArguments& arguments) {
  Result<std::vector<trees::TreeView>> views = trees::read_capture(arguments.capture);
  if (!views) return views.errors();
  for (const std::string& note : trees::leave_out_inconsistent(*views, false)) fmt::print("{}\n", note);
  const Result<std::vector<trees::TreeView>> held_out = trees::read_capture(arguments.capture / "held_out");
  if (!held_out) return held_out.errors();
  const Result<std::vector<std::string>> lines =
      trees::write_figures(arguments.output, {*views, *held_out, arguments.level});
  if (!lines) return lines.errors();
  for (const std::string& line : *lines) fmt::print("{}\n", line);
  return Ok{};
}

void add_organs(CLI::App& tree, Chosen& chosen) {
  CLI::App* command = tree.add_subcommand("organs", "Distinguishes trunk, branches and leaves of a volume");
  const auto arguments = std::make_shared<OrgansArguments>();
  command->add_option("volume", arguments->volume, "From parvis tree reconstruct (.volume)")->required();
  command->add_option("--capture", arguments->capture, "The photographs, for the bark");
  command->add_option("--trunk", arguments->trunk, "Write the trunk as a model (.glb), with its bark");
  command->add_option("--rest", arguments->rest, "Write the volume without the trunk (.volume)");
  command->footer(
      "Example: parvis tree organs out/oak.volume --capture out/oak --trunk out/trunk.glb --rest "
      "out/crown.volume");
  command->callback([arguments, &chosen] { chosen = [arguments] { return organs(*arguments); }; });
}

void add_vary(CLI::App& tree, Chosen& chosen) {
  CLI::App* command = tree.add_subcommand("vary", "Makes another individual of a captured kind");
  const auto arguments = std::make_shared<TreeToTree>();
  command->add_option("tree", arguments->from, "The tree (.tree)")->required();
  command->add_option("-o,--output", arguments->to, "The other tree (.tree)")->required();
  command->add_option("--seed", arguments->seed, "Another seed gives another tree")->capture_default_str();
  command->footer("Example: parvis tree vary out/oak.tree --seed 2 -o out/oak_2.tree");
  command->callback([arguments, &chosen] { chosen = [arguments] { return vary(*arguments); }; });
}

void add_tree_export(CLI::App& tree, Chosen& chosen) {
  CLI::App* command = tree.add_subcommand(
      "export", "Writes a tree as glTF: two crossed billboards, with the whole tree in an extension");
  const auto arguments = std::make_shared<TreeToTree>();
  command->add_option("tree", arguments->from, "The tree (.tree, or such a .glb)")->required();
  command->add_option("-o,--output", arguments->to, "The file (.glb, or .tree again)")->required();
  command->footer("Example: parvis tree export out/oak.tree -o out/oak.glb");
  command->callback([arguments, &chosen] { chosen = [arguments] { return export_tree(*arguments); }; });
}

void add_tree_figures(CLI::App& tree, Chosen& chosen) {
  CLI::App* command = tree.add_subcommand(
      "figures", "Draws the figures of chapter 4 of the thesis: grid, convergence, slices, views, cutoffs");
  const auto arguments = std::make_shared<FiguresArguments>();
  command->add_option("capture", arguments->capture, "Folder of a capture with its held_out views")
      ->required();
  command->add_option("-o,--output", arguments->output, "The folder for the pictures")->required();
  command->add_option("--level", arguments->level, "Divisions of the grid for opacity")
      ->capture_default_str()
      ->check(CLI::Range(1, 5));
  command->footer("Example: parvis tree figures out/oak -o out/figures");
  command->callback([arguments, &chosen] { chosen = [arguments] { return figures(*arguments); }; });
}

}  // namespace

void add_tree_products(CLI::App& tree, Chosen& chosen) {
  add_organs(tree, chosen);
  add_vary(tree, chosen);
  add_tree_export(tree, chosen);
  add_tree_figures(tree, chosen);
}

}  // namespace parvis
