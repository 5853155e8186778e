// The places that the bench `facades` measures, of the shared photographs.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bench/scratch_folder.h"
#include "capture/facades/layer_model.h"
#include "capture/photographs/photograph.h"

namespace parvis::bench {

/// Photographs with a model, and the names of those that judge.
struct BenchPlace {
  std::vector<photographs::Photograph> photographs;
  std::vector<facades::NamedMesh> meshes;
  std::vector<std::string> held_out;
  std::shared_ptr<const ScratchFolder> files;  ///< the photographs', where they are copies
  bool is_scan = false;                        ///< its model is trimmed (facades/scan_trim.h)
};

/// The castle with its mesh of 175,000 triangles.
Result<BenchPlace> sceaux(const std::filesystem::path& folder, bool is_quick);
/// The courtyard with the model that `parvis facade model` proposes for the photographs that do not judge;
/// quickly with pictures of half the width and height.
Result<BenchPlace> courtyard(const std::filesystem::path& folder, bool is_quick);

}  // namespace parvis::bench
