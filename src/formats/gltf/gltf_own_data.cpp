#include "formats/gltf/gltf_own_data.h"

#include "base/json_guard.h"
#include "formats/gltf/gltf_file.h"
#include "formats/gltf/gltf_values.h"

namespace parvis::scene {
namespace {

using Json = GltfFile::Json;

GltfOwnData own_data_of(const GltfFile& file, const std::string& extension) {
  Json json = gltf_extension(file.json(), extension.c_str());
  if (json.empty()) gltf_fail("it has no extension {}", extension);
  GltfOwnData own{extension, "", {}};
  for (const auto& [name, number] : gltf_member(json, "views").items()) {
    if (!number.is_number_unsigned() || number.get<std::uint64_t>() >= file.list("bufferViews").size())
      gltf_fail("{}: the view \"{}\" is {}; expected the number of a buffer view", extension, name,
                number.dump().substr(0, 40));
    const std::span<const std::uint8_t> bytes = file.buffer_view(number.get<int>());
    gltf_charge(bytes.size(), "the view \"{}\"", name);
    own.views.emplace_back(name, std::string(bytes.begin(), bytes.end()));
  }
  json.erase("views");
  own.json = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  return own;
}

}  // namespace

Result<GltfOwnData> read_gltf_own_data(const std::filesystem::path& file, const std::string& extension) {
  const FileLocation where{file.string(), 0, 0};
  try {
    return own_data_of(GltfFile(file), extension);
  } catch (const GltfFile::GltfProblem& problem) {
    return Error{problem.message, where};
  } catch (const Json::exception& problem) {
    return error_at(where, "a value is not of the kind that glTF asks for ({})", json_reason(problem.what()));
  }
}

}  // namespace parvis::scene
