// A valid .glb around a compressed byte stream, so that a fuzzer's bytes reach the decoders.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace parvis::scene {

/// The JSON of one mesh with float positions and 32-bit indices; the caller adds the compressed buffer views
/// in `binary`.
inline nlohmann::json packed_gltf(std::size_t vertices, std::size_t indices) {
  return {{"asset", {{"version", "2.0"}}},
          {"scenes", {{{"nodes", {0}}}}},
          {"nodes", {{{"mesh", 0}}}},
          {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}}},
          {"accessors",
           {{{"componentType", 5126}, {"count", vertices}, {"type", "VEC3"}},
            {{"componentType", 5125}, {"count", indices}, {"type", "SCALAR"}}}}};
}

/// The bytes of a .glb file (glTF 2.0, section 4.4) with the JSON and the binary chunk.
inline std::string glb(const nlohmann::json& json, std::string binary) {
  std::string text = json.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  std::string bytes = "glTF";
  const auto append_word = [&](std::size_t value) {
    for (int shift = 0; shift < 32; shift += 8) bytes += char(value >> shift & 255);
  };
  append_word(2);
  append_word(28 + text.size() + binary.size());
  append_word(text.size());
  bytes += "JSON" + text;
  append_word(binary.size());
  bytes.append("BIN\0", 4);
  return bytes + binary;
}

}  // namespace parvis::scene
