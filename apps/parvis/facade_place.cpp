#include "facade_place.h"

#include <algorithm>

#include "capture/facades/coarse_model_file.h"
#include "capture/facades/place_model.h"
#include "capture/facades/place_recipe.h"
#include "capture/facades/scan_frame.h"
#include "capture/facades/scan_trim.h"
#include "capture/photographs/set_file.h"
#include "formats/readers/readers.h"
#include "rooms/rooms.h"

namespace parvis {
namespace {

void print(const Errors& messages) {
  if (!messages.empty()) fmt::print(stderr, "{}", to_string(messages));
}

Errors of_file(Errors errors, const std::filesystem::path& file) {
  for (Error& error : errors) error.where.file = file.string();
  return errors;
}

/// The objects of a model in any format.
Result<std::vector<facades::NamedMesh>> read_meshes(const std::filesystem::path& file) {
  Errors warnings;
  const Result<scene::Model> model = rooms::all_registries().get<formats::Readers>().read(file, {}, warnings);
  if (!model) return model.errors();
  print(warnings);
  return facades::named_meshes(*model);
}

}  // namespace

Status write_trimmed_scan(const std::filesystem::path& folder, const std::filesystem::path& scan,
                          const std::filesystem::path& output) {
  const Result<std::vector<facades::NamedMesh>> meshes = read_meshes(scan);
  if (!meshes) return meshes.errors();
  const Result<photographs::LoadedSet> loaded = photographs::read_photograph_set(folder);
  if (!loaded) return loaded.errors();
  Result<facades::PlacedScan> placed = facades::placed_scan(*meshes, loaded->set);
  if (!placed) return of_file(placed.errors(), scan);
  if (placed->is_moved)
    fmt::print(stderr, "{}: turned and scaled as the cameras were when they were calibrated\n",
               scan.string());
  const Result<facades::PlaceSource> source = facades::read_place(folder, std::move(placed->meshes));
  if (!source) return source.errors();
  print(source->notes);
  Result<facades::TrimmedScans> trimmed = facades::trimmed_scans(source->meshes, source->photographs);
  if (!trimmed) return trimmed.errors();
  print(trimmed->notes);
  std::vector<facades::NamedMesh>& kept = trimmed->meshes;
  if (std::ranges::count(kept, facades::backdrop_name, &facades::NamedMesh::name) == 0)
    kept.push_back(facades::backdrop(kept, loaded->set));
  return facades::write_meshes(output, kept);
}

Result<facades::PlaceSource> open_place(const PlaceArguments& arguments) {
  const std::filesystem::path file =
      arguments.model.empty() ? arguments.folder / "model.glb" : arguments.model;
  std::error_code code;
  if (!std::filesystem::exists(file, code))
    return error("{}: there is no model; run parvis facade model \"{}\", or give one by --model",
                 file.string(), arguments.folder.string());
  Result<std::vector<facades::NamedMesh>> meshes = read_meshes(file);
  if (!meshes) return meshes.errors();
  return facades::read_place(arguments.folder, *std::move(meshes), arguments.left_out);
}

Result<facades::PlaceLayers> open_layers(const facades::PlaceSource& source,
                                         const facades::PlaceSettings& settings) {
  Result<facades::PlaceLayers> place = facades::make_place(source, settings);
  if (place) print(place->warnings);
  return place;
}

Status finish_place(const PlaceArguments& arguments, bool writes_pictures) {
  const Result<facades::PlaceSource> source = open_place(arguments);
  if (!source) return source.errors();
  const std::string look =
      fmt::format("look: parvis view \"{}\"\n", (arguments.folder / "place.xp").string());
  if (writes_pictures && facades::is_packed(*source, arguments.settings)) {
    fmt::print("{} is packed as it is\n{}", arguments.folder.string(), look);
    return Ok{};
  }
  const Result<facades::PlaceLayers> place = open_layers(*source, arguments.settings);
  if (!place) return place.errors();
  if (writes_pictures)
    if (Status status = facades::write_layered_pictures(*source, *place); !status) return status;
  const Result<facades::PackedFacade> packed = facades::pack_place(*source, *place);
  if (!packed) return packed.errors();
  if (Status status = facades::remember_packed(*source, arguments.settings); !status) return status;
  fmt::print(
      "{} photographs, {} layers, {} surfaces; {:.1f} MB of textures, {:.1f} % of the photographs' RGBA\n",
      packed->photos.size(), packed->layers.size(), packed->surfaces.size(),
      1e-6 * double(packed->texture_bytes()),
      100.0 * double(packed->texture_bytes()) / double(packed->photograph_bytes()));
  fmt::print("written to {}\n{}", (arguments.folder / "place.facade").string(), look);
  return Ok{};
}

}  // namespace parvis
