#include "scene/model_source.h"

#include "scene/gltf_reader.h"

namespace parvis::scene {

Result<Model> model_from_file(const std::filesystem::path& file, UpAxis, Errors& warnings) {
  const std::string extension = file.extension().string();
  if (extension == ".glb" || extension == ".gltf") return read_gltf(file, warnings);
  return error("{}: model files cannot be read yet", file.string());
}

}  // namespace parvis::scene
