// parvis facade panorama: an equirectangular picture as six calibrated photographs.
#include <algorithm>
#include <filesystem>
#include <memory>

#include "base/path_inside.h"
#include "capture/photographs/panorama.h"
#include "capture/photographs/set_file.h"
#include "facade_stages.h"

namespace parvis {
namespace {

struct FacadePanoramaArguments {
  std::filesystem::path panorama, folder;
  std::vector<double> position{0.0, 0.0, 0.0};
  double heading_deg = 0.0;
};

/// Writes the faces, and adds them to the photographs that the folder holds: a place has several panoramas.
Status add_panorama(const FacadePanoramaArguments& arguments) {
  for (const char* name : {"faces", "masks"})
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
  const Result<photographs::PhotographSet> faces =
      photographs::split_panorama(arguments.panorama, pictures, position, arguments.heading_deg);
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
  return Ok{};
}

}  // namespace

void add_facade_panorama(CLI::App& stage, Chosen& chosen) {
  const auto arguments = std::make_shared<FacadePanoramaArguments>();
  stage
      .add_option(
          "panorama", arguments->panorama,
          "Equirectangular picture, twice as wide as high, of the whole sphere around one viewpoint. Phones "
          "and Hugin stitch one from photographs that were taken from one spot")
      ->required()
      ->check(CLI::ExistingFile);
  stage.add_option("-o,--output", arguments->folder, "Folder of the place; its panoramas are kept")
      ->required();
  stage.add_option("--position", arguments->position, "Where it was taken: x y z, metres")
      ->expected(3)
      ->capture_default_str();
  stage
      .add_option("--heading-deg", arguments->heading_deg,
                  "Heading of the panorama's middle column, degrees from north over east")
      ->capture_default_str();
  stage.footer(
      "Example: parvis facade panorama square.jpg -o square --position 12 3 1.7\n"
      "         parvis facade pack square --model square.glb");
  stage.callback([arguments, &chosen] { chosen = [arguments] { return add_panorama(*arguments); }; });
}

}  // namespace parvis
