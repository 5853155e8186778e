// Which frame a scan is of. Programs that make one of the photographs keep the frame in which the cameras
// were given or found; calibration turns and scales it (PhotographSet::world_from_given).
#pragma once

#include <vector>

#include "capture/facades/layer_model.h"
#include "capture/photographs/photograph.h"

namespace parvis::facades {

/// A scan in the world of the photographs.
struct PlacedScan {
  std::vector<NamedMesh> meshes;
  bool is_moved = false;  ///< it was of another frame
};

/// The scan in the frame in which most of the points that photographs have in common lie on it, as the
/// photographs see both: as it is; turned and scaled as the cameras were; and each of the two without the
/// quarter turn that readers give to formats whose y is up. Where the photographs have too few points in
/// common it stays as it is. Errors: the meshes are no model, or hardly a point lies on them in any frame.
Result<PlacedScan> placed_scan(const std::vector<NamedMesh>& meshes, const photographs::PhotographSet& set);

}  // namespace parvis::facades
