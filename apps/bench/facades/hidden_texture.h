// Photographs of houses of the paper's city (section 7), traced by this program, with a board before each
// facade: what the board hides is known.
#pragma once

#include <filesystem>
#include <vector>

#include "base/image.h"
#include "base/result.h"
#include "capture/facades/layer_model.h"
#include "capture/photographs/photograph.h"

namespace parvis::bench {

/// One house, photographed along the street.
struct PhotographedHouse {
  std::vector<photographs::Photograph> photographs;  ///< in the folder given; with the board
  std::vector<Image8> truths;                        ///< the same views without the board: 8-bit sRGB
  std::vector<facades::NamedMesh>
      meshes;  ///< its street front, `hidden_surface`, as one rectangle; the board
};
inline constexpr const char* hidden_surface = "front";

/// Traces `count` houses of the city that stand in a row and have one street front, five photographs each,
/// into `folder`. The city's own relief (bays, cornices) is not in the meshes.
Result<std::vector<PhotographedHouse>> photographed_houses(std::size_t count,
                                                           const std::filesystem::path& folder);

}  // namespace parvis::bench
