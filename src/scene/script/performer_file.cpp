#include "scene/script/performer_file.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "scene/script/named_file.h"

namespace parvis::scene {

bool is_performer_file(const std::string& name) {
  std::string extension = std::filesystem::path(name).extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return extension == ".pfb";
}

Result<std::filesystem::path> in_place_of_performer_file(const std::string& name, const Roots& roots,
                                                         const FileLocation& where) {
  constexpr std::array readable{".glb", ".gltf", ".iv", ".wrl"};
  for (const char* extension : readable) {
    const std::filesystem::path other = std::filesystem::path(name).replace_extension(extension);
    Result<std::filesystem::path> file = find_named_file(other.string(), roots, where);
    if (file && std::filesystem::is_regular_file(*file)) return file;
  }
  return error_at(
      where,
      "\"{}\" is a file of OpenGL Performer, which nothing reads any more, and no .glb, .gltf, .iv or "
      ".wrl of that name lies in the scene's folder; export the model as one of these",
      name);
}

Errors replaced_performer_files(const Node& node) {
  Errors told;
  for (const NodeAttribute& attribute : node.attributes)
    if (attribute.schema->type == AttributeType::file && is_performer_file(attribute.text))
      told.push_back(
          error_at(attribute.where,
                   "\"{}\" is a file of OpenGL Performer, which nothing reads any more: \"{}\" is used",
                   attribute.text, std::get<std::filesystem::path>(attribute.value).filename().string()));
  return told;
}

}  // namespace parvis::scene
