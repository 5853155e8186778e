// What a browser does not show as Parvis does, and what it shows in its place.
#pragma once

#include <string>
#include <vector>

#include "planning/share/shown_things.h"
#include "scene/script/live_scene.h"

namespace parvis::share {

/// A sentence for each kind of node or thing of the scene that a page cannot show: how many there are, and
/// what is shown instead. Empty: it shows everything.
std::vector<std::string> shown_instead(const scene::Scene& scene, const scene::LiveScene& live,
                                       const ShownThings& things);

}  // namespace parvis::share
