// Scans closed their surfaces where nothing was seen: between a house and the trees beside it, between
// chimneys. What photographs show there lies elsewhere, and is smeared or doubled when they are mixed.
#pragma once

#include <vector>

#include "capture/facades/layer_model.h"
#include "capture/photographs/photograph.h"

namespace parvis::facades {

/// The model without what was cut off.
struct TrimmedScans {
  std::vector<NamedMesh> meshes;
  Errors notes;  ///< a message for each mesh that has lost triangles, and photographs that could not be used
};

/// Cuts off, from their open borders inward, what photographs contradict each other about of meshes of more
/// than `max_faces_in_layers` triangles (the backdrop excepted). Contradicted is a triangle whose colour
/// differs, by the median over the pairs of photographs that see it from about the same side, after exposure
/// and colour were balanced. What lies inside, as windows that reflect, is never reached, and a body without
/// borders stays whole. Crumbs that this leaves are cut off, too. Fails where the meshes are no model, or
/// nothing is left of it.
Result<TrimmedScans> trimmed_scans(const std::vector<NamedMesh>& meshes,
                                   const std::vector<photographs::Photograph>& photographs);

}  // namespace parvis::facades
