// Any bytes as views that EXT_meshopt_compression packed, in any of its modes: a model or errors. The first
// five bytes choose mode, filter, stride, count, and how many of the rest are vertices.
#include <algorithm>
#include <array>

#include "base/fuzz_file.h"
#include "formats/gltf/fuzz/packed_gltf.h"
#include "formats/gltf/gltf_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t header = 5;
  if (size < header) return 0;
  static parvis::FuzzFile file(".glb");
  constexpr std::array modes{"TRIANGLES", "INDICES"};
  constexpr std::array filters{"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"};
  const std::size_t stream = size - header, vertices = data[3], indices = vertices / 2 * 3,
                    stride = 4 + 4 * (data[2] % 8), split = std::min<std::size_t>(data[4], stream);
  const auto view = [&](std::size_t at, std::size_t length, std::size_t count, std::size_t bytes,
                        const char* mode, const char* filter) {
    return nlohmann::json{{"buffer", 0},
                          {"byteLength", count * bytes},
                          {"extensions",
                           {{"EXT_meshopt_compression",
                             {{"buffer", 0},
                              {"byteOffset", at},
                              {"byteLength", length},
                              {"byteStride", bytes},
                              {"count", count},
                              {"mode", mode},
                              {"filter", filter}}}}}};
  };
  nlohmann::json json = parvis::scene::packed_gltf(vertices, indices);
  json["buffers"] = {{{"byteLength", stream}}};
  json["bufferViews"] = {view(0, split, vertices, stride, "ATTRIBUTES", filters[data[1] % filters.size()]),
                         view(split, stream - split, indices, 4, modes[data[0] % modes.size()], "NONE")};
  json["accessors"][0]["bufferView"] = 0;
  json["accessors"][1]["bufferView"] = 1;
  const std::string bytes =
      parvis::scene::glb(json, std::string(reinterpret_cast<const char*>(data) + header, stream));
  parvis::Errors warnings;
  (void)parvis::scene::read_gltf(file.with(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()),
                                 warnings);
  return 0;
}
