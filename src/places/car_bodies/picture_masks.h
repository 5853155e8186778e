// Which parts of a body's picture are glass and lamps, as masks of the node `material`.
#pragma once

#include <string>
#include <vector>

#include "base/bounds.h"
#include "scene/data/model.h"

namespace parvis::car_bodies {

/// Masks as the attribute `mask` spells them.
struct PictureMasks {
  std::vector<std::string> glass;  ///< "box u0 v0 u1 v1 grey t", one per pane or row of panes
  std::vector<std::string> lamps;  ///< "colour #RRGGBB t": rear lamps, front lamps
};

/// Panes are the grey regions of the picture on the upper half of the body that do not face up; lamps are red
/// regions at its rear and yellow ones at its front. A body in a grey of the panes' kind gets no masks for
/// them. `faces_back`: the front is toward negative x.
PictureMasks find_masks(const scene::Model& model, const Bounds& bounds, bool faces_back);

}  // namespace parvis::car_bodies
