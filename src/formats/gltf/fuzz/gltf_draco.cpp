// Any bytes as a mesh that KHR_draco_mesh_compression packed: a model or errors.
#include "base/fuzz_file.h"
#include "formats/gltf/fuzz/packed_gltf.h"
#include "formats/gltf/gltf_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static parvis::FuzzFile file(".glb");
  nlohmann::json json = parvis::scene::packed_gltf(4, 6);
  json["buffers"] = {{{"byteLength", size}}};
  json["bufferViews"] = {{{"buffer", 0}, {"byteLength", size}}};
  json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", 0}, {"attributes", {{"POSITION", 0}}}};
  const std::string bytes = parvis::scene::glb(json, std::string(reinterpret_cast<const char*>(data), size));
  parvis::Errors warnings;
  (void)parvis::scene::read_gltf(file.with(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()),
                                 warnings);
  return 0;
}
