#include "scene/model_source.h"

namespace parvis::scene {

Result<Model> model_from_file(const std::filesystem::path& file, UpAxis, Errors&) {
  return error("{}: model files cannot be read yet", file.string());
}

}  // namespace parvis::scene
