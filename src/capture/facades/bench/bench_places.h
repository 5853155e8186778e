// The places that the bench `facades` measures, of the shared photographs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "capture/facades/layer_model.h"
#include "capture/photographs/photograph.h"

namespace parvis::bench {

/// Photographs with a model, and the names of those that judge.
struct BenchPlace {
  std::vector<photographs::Photograph> photographs;
  std::vector<facades::NamedMesh> meshes;
  std::vector<std::string> held_out;
};

/// The castle with its mesh of 175,000 triangles.
Result<BenchPlace> sceaux(const std::filesystem::path& folder);
/// The courtyard with the model that `parvis facade model` proposes for the photographs that do not judge.
Result<BenchPlace> courtyard(const std::filesystem::path& folder);

}  // namespace parvis::bench
