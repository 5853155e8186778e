#include "tree_calibrate.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <vector>

#include "base/image_io.h"
#include "capture/trees/capture_folder.h"
#include "capture/trees/turntable.h"

namespace parvis {
namespace {

struct CalibrateArguments {
  std::filesystem::path capture;
  float distance_m = 0.0f, focal_px = 0.0f, turn_deg = 360.0f;
};

/// The RGBA pictures of a folder, by name, without their cameras.
Result<std::vector<trees::TreeView>> pictures_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code code;
  for (const auto& entry : std::filesystem::directory_iterator(folder, code))
    if (entry.path().extension() == ".png") files.push_back(entry.path());
  if (files.empty())
    return error("{}: no .png pictures are there; parvis tree matte makes them", folder.string());
  std::ranges::sort(files);
  std::vector<trees::TreeView> views;
  for (const std::filesystem::path& file : files) {
    Result<Image8> picture = read_image8(file);
    if (!picture) return picture.errors();
    if (picture->channels != 4)
      return error("{}: it has no matte; make one with parvis tree matte", file.string());
    views.push_back({file.stem().string(), {}, *std::move(picture)});
  }
  return views;
}

Status calibrate(const CalibrateArguments& arguments) {
  Result<std::vector<trees::TreeView>> views = pictures_in(arguments.capture);
  if (!views) return views.errors();
  std::vector<Image8> pictures;
  for (const trees::TreeView& view : *views) pictures.push_back(view.picture);
  trees::Turntable start;
  start.focal_px = arguments.focal_px, start.distance_m = arguments.distance_m;
  start.step = glm::radians(arguments.turn_deg) / float(pictures.size());
  const Result<trees::FoundTurntable> found = trees::found_turntable(pictures, start);
  if (!found) return found.errors();
  if (!(found->explained_share > 0.0))
    return error(
        "{}: no turntable explains anything of these silhouettes; compare --distance {:g} and --focal {:g} "
        "with the photographs",
        arguments.capture.string(), arguments.distance_m, arguments.focal_px);
  const std::vector<trees::Pinhole> cameras =
      trees::turntable_cameras(found->turntable, pictures.size(), {pictures[0].width, pictures[0].height});
  for (std::size_t i = 0; i < cameras.size(); ++i) (*views)[i].camera = cameras[i];
  if (Status status = trees::write_cameras(arguments.capture, *views); !status) return status;
  const trees::Turntable& t = found->turntable;
  fmt::print(
      "camera {:.2f} degrees above the level of the axis at the picture's middle, rolled by {:.2f} degrees; "
      "axis "
      "{:.1f} pixels to the right; {} by {:.2f} degrees per photograph\n{:.1f} % of the silhouettes "
      "explained by "
      "points that all photographs show\n",
      glm::degrees(t.elevation), glm::degrees(t.roll), t.axis_px,
      t.step > 0.0f ? "counter-clockwise" : "clockwise", glm::degrees(std::abs(t.step)),
      100.0 * found->explained_share);
  return Done{};
}

}  // namespace

void add_tree_calibrate(CLI::App& tree, Chosen& chosen) {
  CLI::App* command =
      tree.add_subcommand("calibrate", "Finds the cameras of a plant on a turntable, from its silhouettes");
  const auto arguments = std::make_shared<CalibrateArguments>();
  command
      ->add_option("capture", arguments->capture,
                   "Folder of RGBA pictures, by name in the order in which they were taken; the cameras are "
                   "written into it")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("--distance", arguments->distance_m, "Metres from the camera to the axis")
      ->required()
      ->check(CLI::Range(0.01, 10'000.0));
  command->add_option("--focal", arguments->focal_px, "Focal length in pixels of these pictures")
      ->required()
      ->check(CLI::Range(1.0, 1e6));
  command->add_option("--turn", arguments->turn_deg, "Degrees that all photographs together turn")
      ->capture_default_str()
      ->check(CLI::Range(1.0f, 360.0f));
  command->footer(
      "Example: parvis tree calibrate out/plant --distance 5.45 --focal 1168\n"
      "Photographs taken by walking round a tree: parvis facade calibrate.");
  command->callback([arguments, &chosen] { chosen = [arguments] { return calibrate(*arguments); }; });
}

}  // namespace parvis
