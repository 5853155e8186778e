// parvis facade panorama: what was taken from one spot, a panorama or photographs of it, as calibrated
// photographs, six faces each.
#include <algorithm>
#include <filesystem>
#include <memory>

#include "base/path_inside.h"
#include "capture/photographs/panorama.h"
#include "capture/photographs/set_file.h"
#include "capture/photographs/stitch.h"
#include "facade_stages.h"

namespace parvis {
namespace {

struct Arguments {
  std::filesystem::path panorama, folder;
  std::vector<double> position{0.0, 0.0, 0.0};
  double heading_deg = 0.0;
};

/// The faces of a panorama, or of photographs that were taken from one spot.
Result<photographs::PhotographSet> faces_of(const Arguments& arguments, const std::filesystem::path& pictures,
                                            glm::dvec3 position) {
  if (!std::filesystem::is_directory(arguments.panorama))
    return photographs::split_panorama(arguments.panorama, pictures, position, arguments.heading_deg);
  const std::filesystem::path source = arguments.panorama.lexically_normal();
  const std::string name = (source.has_filename() ? source : source.parent_path()).filename().string();
  const Result<std::filesystem::path> work =
      path_inside(arguments.folder, std::filesystem::path("stitching") / name);
  if (!work) return work.errors();
  Result<photographs::StitchedSpot> spot =
      photographs::stitch(source, *work, name, position, arguments.heading_deg);
  if (!spot) return spot.errors();
  fmt::print(stderr, "{}", to_string(spot->problems));
  fmt::print("{} photographs stitched: focal length {:.0f} pixels, error {:.2f} pixels\n", spot->used,
             spot->focal_px, spot->error_px);
  return photographs::write_faces(std::move(spot->faces), pictures);
}

/// Writes the faces, and adds them to the photographs that the folder holds: a place has several panoramas.
Status add_panorama(const Arguments& arguments) {
  for (const char* name : {"faces", "masks", "stitching"})
    if (const Result<std::filesystem::path> inside = path_inside(arguments.folder, name); !inside)
      return inside.errors();
  const std::filesystem::path pictures = arguments.folder / "faces";
  const glm::dvec3 position(arguments.position[0], arguments.position[1], arguments.position[2]);
  photographs::PhotographSet set;
  std::error_code code;
  if (std::filesystem::exists(arguments.folder / "photographs.json", code)) {
    const Result<photographs::LoadedSet> there = photographs::read_photograph_set(arguments.folder);
    if (!there) return there.errors();
    fmt::print(stderr, "{}", to_string(there->problems));
    set = there->set;
    for (const photographs::Photograph& photograph : set.photographs)
      if (photograph.file.parent_path() != pictures.lexically_normal())
        return error("{}: it holds photographs that are no panorama's faces ({}); choose another folder",
                     arguments.folder.string(), photograph.name);
  }
  const Result<photographs::PhotographSet> faces = faces_of(arguments, pictures, position);
  if (!faces) return faces.errors();
  for (const photographs::Photograph& face : faces->photographs) {
    std::erase_if(set.photographs, [&](const auto& known) { return known.name == face.name; });
    set.photographs.push_back(face);
    fmt::print("{}  {} x {}\n", face.name, face.lens.width, face.lens.height);
  }
  std::ranges::sort(set.photographs, {}, &photographs::Photograph::name);
  if (Status status = photographs::write_photograph_set(arguments.folder, set, pictures); !status)
    return status;
  fmt::print("{} photographs in {}\n", set.photographs.size(), arguments.folder.string());
  return Done{};
}

}  // namespace

void add_facade_panorama(CLI::App& stage, Chosen& chosen) {
  const auto arguments = std::make_shared<Arguments>();
  stage
      .add_option(
          "panorama", arguments->panorama,
          "Equirectangular picture, twice as wide as high, of the whole sphere around one viewpoint; or a "
          "folder of photographs that were taken from one spot, which are stitched")
      ->required()
      ->check(CLI::ExistingPath);
  stage.add_option("-o,--output", arguments->folder, "Folder of the place; its panoramas are kept")
      ->required();
  stage.add_option("--position", arguments->position, "Where it was taken: x y z, metres")
      ->expected(3)
      ->capture_default_str();
  stage
      .add_option(
          "--heading-deg", arguments->heading_deg,
          "Heading of the panorama's middle column, or of the first photograph, degrees from north over east")
      ->capture_default_str();
  stage.footer(
      "Example: parvis facade panorama square.jpg -o square --position 12 3 1.7\n"
      "         parvis facade pack square --model square.glb");
  stage.callback([arguments, &chosen] { chosen = [arguments] { return add_panorama(*arguments); }; });
}

}  // namespace parvis
