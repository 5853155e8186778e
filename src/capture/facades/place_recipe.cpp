#include "capture/facades/place_recipe.h"

#include <algorithm>
#include <filesystem>

#include "base/content_hash.h"
#include "base/files.h"

namespace parvis::facades {
namespace fs = std::filesystem;
namespace {

constexpr int packing_version = 3;  ///< counts when the same sources are packed in another way
constexpr int layers_version = 1;   ///< counts when layers are found or filled in another way

fs::path recipe_file(const fs::path& folder) { return folder / "packed.txt"; }

/// Size and time of a file; empty where there is none.
std::string state_of(const fs::path& file) {
  std::error_code code;
  const auto time = fs::last_write_time(file, code);
  if (file.empty() || code) return "";
  const auto bytes = fs::file_size(file, code);
  return fmt::format("{} {} {}\n", file.filename().string(), bytes, time.time_since_epoch().count());
}

/// Hash of the model and the cameras.
ContentHash geometry_of(const PlaceSource& source) {
  ContentHash hash;
  for (const NamedMesh& named : source.meshes)
    hash.add_text(named.name), hash.add(named.mesh.positions), hash.add(named.mesh.indices);
  for (const photographs::Photograph& photo : source.photographs) {
    hash.add_text(photo.name), hash.add(photo.world_from_camera), hash.add(photo.gain);
    hash.add(int(photo.lens.model)), hash.add(photo.lens.parameters);
  }
  return hash;
}

std::string recipe_of(const PlaceSource& source, const PlaceSettings& settings) {
  ContentHash hash = geometry_of(source);
  std::string text = fmt::format("packing {}\n", packing_version);
  if (settings.flattens_shadows) text += "shadows flattened\n";
  if (settings.carries_edits) text += "edits carried\n";
  for (const photographs::Photograph& photo : source.photographs)
    text += state_of(photo.file) + state_of(photo.mask);
  const Result<std::string> choices = read_file(source.folder / "filling.txt", 1 << 24);
  if (choices) hash.add_text(*choices);
  std::vector<fs::path> pictures;
  std::error_code code;
  for (const fs::directory_entry& entry : fs::directory_iterator(source.folder / "layers", code))
    if (entry.path().extension() == ".psd") pictures.push_back(entry.path());
  std::ranges::sort(pictures);
  for (const fs::path& picture : pictures) text += state_of(picture);
  return text + fmt::format("model, cameras and choices {:016x}\n", hash.value());
}

/// The recipe with the state of its result: a facade that came from elsewhere is packed again.
std::string packed_recipe_of(const PlaceSource& source, const PlaceSettings& settings) {
  return recipe_of(source, settings) + state_of(source.folder / "place.facade");
}

}  // namespace

bool is_packed(const PlaceSource& source, const PlaceSettings& settings) {
  std::error_code code;
  if (!fs::exists(source.folder / "place.facade", code) || !fs::exists(source.folder / "place.xp", code))
    return false;
  const Result<std::string> known = read_file(recipe_file(source.folder), 1 << 24);
  return known && *known == packed_recipe_of(source, settings);
}

std::uint64_t layers_key(const PlaceSource& source, const PlaceSettings& settings) {
  ContentHash hash = geometry_of(source);
  hash.add(layers_version);
  for (const bool setting : {settings.balances_colours, settings.finds_occluders, settings.flattens_shadows})
    hash.add(int(setting));
  for (const photographs::Photograph& photo : source.photographs)
    for (const fs::path& file : {photo.file, photo.mask}) {
      const Result<std::string> bytes = file.empty() ? std::string() : read_file(file);
      hash.add_text(bytes ? *bytes : "cannot be read");
    }
  return hash.value();
}

Status remember_packed(const PlaceSource& source, const PlaceSettings& settings) {
  return write_file(recipe_file(source.folder), packed_recipe_of(source, settings));
}

}  // namespace parvis::facades
