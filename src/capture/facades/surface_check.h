// Surfaces of a proposed model that the photographs speak against: each photograph in turn is rendered from
// the others, with a surface as it was proposed, without its relief, and without it.
#pragma once

#include <vector>

#include "capture/facades/layer_model.h"
#include "capture/facades/prepared_photo.h"

namespace parvis::facades {

/// Photographs as the check looks at them: small, and no more than it needs. Those without pixels, or with
/// distortion, are passed over.
std::vector<PreparedPhoto> small_photos(const std::vector<photographs::Photograph>& photographs);

/// Makes surfaces flat, or takes them out of `meshes`, where that renders the photographs better from each
/// other; notes name each. `flat` are the surfaces that may go, as they were before their reliefs. Fewer than
/// four photographs prove nothing.
Errors leave_out_what_makes_worse(std::vector<NamedMesh>& meshes, const std::vector<NamedMesh>& flat,
                                  std::vector<PreparedPhoto> photos);

}  // namespace parvis::facades
