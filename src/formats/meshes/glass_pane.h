// Glass that bounds no body, as a pane: what stands behind it is seen straight through.
#pragma once

#include <set>
#include <string>

#include "scene/data/model.h"

namespace parvis::scene {

/// A pane of that glass: blended, tinted by as much as its colour and its thickness keep of the light, seen
/// from both sides. It mirrors as much as both faces of a sheet, seen straight on.
Material pane_of(const Material& glass);

/// Makes a model's solid glass such that light can be followed through it: each body is parts of its own
/// (what leaves a body out shows the others), and open sheets are panes. Returns the names of what became
/// panes.
std::set<std::string> settle_glass(Model& model);

}  // namespace parvis::scene
