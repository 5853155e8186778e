// The pairs of model and camera that a vdobject node lists.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "base/result.h"
#include "scene/script/node.h"

namespace parvis::view_dependent_objects {

/// A model file and the place from which its textures were taken.
struct ModelPair {
  std::filesystem::path file;
  glm::vec3 viewpoint{0.0f};  ///< in the frame of the models, z up
  FileLocation where;         ///< of file=, for errors
};

/// Pairs in the order of the attributes: each file= is followed by one of camera=, cameraFile= and
/// cameraName= (appendix A.1). cameraName= names a viewpoint of the file that was named last, be it a model
/// or a cameraFile=; a cameraFile= without it holds one viewpoint alone. Errors name the attribute, and the
/// viewpoints that there are.
Result<std::vector<ModelPair>> model_pairs(const scene::Node& node);

}  // namespace parvis::view_dependent_objects
