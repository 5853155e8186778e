#include "formats/meshes/assimp_reader.h"

#include "formats/meshes/assimp_module.h"

namespace parvis::scene {

Result<formats::FileContent> read_assimp_content(const std::filesystem::path& file, formats::UpAxis up,
                                                 Errors& warnings) {
  return assimp.call(&AssimpFunctions::read, file, up, warnings);
}

Result<Model> read_with_assimp(const std::filesystem::path& file, formats::UpAxis up, Errors& warnings) {
  Result<formats::FileContent> content = read_assimp_content(file, up, warnings);
  if (!content) return content.errors();
  return std::move(content->model);
}

}  // namespace parvis::scene
