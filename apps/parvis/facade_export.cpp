// parvis facade export: a packed place as glTF, for other programs.
#include <filesystem>
#include <memory>

#include "capture/facades/facade_gltf.h"
#include "facade_stages.h"

namespace parvis {
namespace {

struct FacadeExportArguments {
  std::filesystem::path folder, output;
  int texture_side = 4096;
};

Status write_place(const FacadeExportArguments& arguments) {
  const std::filesystem::path packed = arguments.folder / "place.facade";
  std::error_code code;
  if (!std::filesystem::exists(packed, code))
    return error("{}: the place is not packed; run parvis facade pack \"{}\"", packed.string(),
                 arguments.folder.string());
  if (arguments.output.extension() != ".glb")
    return error("{}: a place is written as .glb", arguments.output.string());
  const Result<facades::PackedFacade> facade = facades::read_facade(packed);
  if (!facade) return facade.errors();
  if (Status status = facades::write_facade_gltf(arguments.output, *facade, arguments.texture_side); !status)
    return status;
  fmt::print("{}: {} surfaces, {} triangles, {} photographs\n", arguments.output.string(),
             facade->surfaces.size(), facade->triangle_count(), facade->photos.size());
  return Ok{};
}

}  // namespace

void add_facade_export(CLI::App& stage, Chosen& chosen) {
  const auto arguments = std::make_shared<FacadeExportArguments>();
  stage.add_option("folder", arguments->folder, "Folder of a packed place")
      ->required()
      ->check(CLI::ExistingDirectory);
  stage.add_option("-o,--output", arguments->output, "The file (.glb); its picture is written beside it")
      ->required();
  stage
      .add_option("--texture-side", arguments->texture_side,
                  "Largest side of the baked texture, pixels; a power of two")
      ->capture_default_str()
      ->check(CLI::IsMember({256, 512, 1024, 2048, 4096, 8192, 16384}));
  stage.footer("Example: parvis facade export courtyard -o courtyard.glb");
  stage.callback([arguments, &chosen] { chosen = [arguments] { return write_place(*arguments); }; });
}

}  // namespace parvis
