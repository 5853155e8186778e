#include "base/registries.h"
#include "formats/gltf/gltf_reader.h"
#include "formats/readers/content.h"
#include "formats/readers/isolated_reader.h"
#include "room_list.h"

namespace parvis::gltf {
namespace {

Result<formats::FileContent> read_model(const std::filesystem::path& file, const formats::ModelReading&,
                                        Errors& warnings) {
  return scene::read_gltf_content(file, warnings);
}

bool is_gltf(std::string_view front) { return front.starts_with("glTF") || formats::looks_like_json(front); }

}  // namespace

/// Adds the reader of .glb and .gltf.
void register_room(Registries& registries) {
  registries.get<formats::Readers>().add({".glb", ".gltf"}, formats::isolated<read_model>(), is_gltf,
                                         formats::TakesPacked::yes);
}

}  // namespace parvis::gltf
