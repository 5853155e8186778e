// The model stage of a place on disk: surfaces proposed from points, corrected by hints, with their reliefs.
#pragma once

#include <filesystem>

#include "capture/facades/coarse_model.h"

namespace parvis::facades {

/// Results of the stage.
struct PlaceModel {
  CoarseModel planes;             ///< as proposed and corrected
  std::vector<NamedMesh> meshes;  ///< with reliefs
  Errors notes;                   ///< what was left out, and why
};

/// Settings of the stage.
struct ModelSettings {
  std::filesystem::path hints;  ///< see apply_hints; empty: none
  bool finds_relief = true;     ///< else every surface stays flat
};

/// Proposes the model of a folder of calibrated photographs. Errors: those of the proposal and of the hints.
Result<PlaceModel> propose_place_model(const std::filesystem::path& folder,
                                       const ModelSettings& settings = {});

/// A dome around meshes and cameras, named `backdrop_name`: so far away that where it stands makes no
/// difference, for what photographs show beyond the model.
NamedMesh backdrop(const std::vector<NamedMesh>& meshes, const photographs::PhotographSet& set);

}  // namespace parvis::facades
