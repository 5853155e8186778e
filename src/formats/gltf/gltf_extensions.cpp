#include "formats/gltf/gltf_extensions.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "formats/gltf/gltf_values.h"

namespace parvis::scene {
namespace {

constexpr std::array<std::string_view, 16> read_ones{"KHR_texture_transform",
                                                     "KHR_materials_clearcoat",
                                                     "KHR_materials_emissive_strength",
                                                     "KHR_materials_ior",
                                                     "KHR_materials_pbrSpecularGlossiness",
                                                     "KHR_materials_transmission",
                                                     "KHR_materials_volume",
                                                     "KHR_mesh_quantization",
                                                     "KHR_draco_mesh_compression",
                                                     "EXT_meshopt_compression",
                                                     "KHR_meshopt_compression",
                                                     "KHR_mesh_primitive_restart",
                                                     "EXT_mesh_gpu_instancing",
                                                     "KHR_node_visibility",
                                                     "EXT_texture_webp",
                                                     "EXT_texture_avif"};

/// Decides whether a file that requires an extension is shown without it: looks of surfaces and lamps, and
/// pictures for which a checker stands. They are named in the account.
bool is_shown_without(std::string_view name) {
  return name.starts_with("KHR_materials_") || name.starts_with("KHR_lights_") ||
         name.starts_with("KHR_texture_") || name.starts_with("EXT_texture_") ||
         name.starts_with("EXT_lights_") || name.starts_with("KHR_xmp") || name == "KHR_animation_pointer" ||
         name == "KHR_node_hoverability" || name == "KHR_node_selectability" || name == "MSFT_texture_dds" ||
         name == "KHR_audio_emitter";
}

/// Parvis's own extensions hold data of its rooms beside a model that any program shows.
bool is_read(std::string_view name) {
  return std::ranges::find(read_ones, name) != read_ones.end() || name.starts_with("PARVIS_");
}

}  // namespace

void check_required_extensions(const GltfFile& file) {
  for (const GltfFile::Json& required : file.list("extensionsRequired")) {
    const auto* name = required.get_ptr<const std::string*>();
    if (name == nullptr || (!is_read(*name) && !is_shown_without(*name)))
      gltf_fail("it requires the extension {}, which is not supported; export it without", required.dump());
  }
}

void count_extensions(const GltfFile& file, FileAccount& account) {
  for (const GltfFile::Json& used : file.list("extensionsUsed")) {
    const auto* name = used.get_ptr<const std::string*>();
    if (name == nullptr) continue;
    if (is_read(*name))
      account.used("extensions");
    else if (*name == "FB_ngon_encoding")
      account.unneeded("extensions", "which triangles were one polygon is not shown", *name);
    else
      account.left_out("extensions", "not read", *name);
  }
}

}  // namespace parvis::scene
