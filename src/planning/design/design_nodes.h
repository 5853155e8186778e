// The nodes of designs: design, placed, surface, measured; and what they hold as plain data.
#pragma once

#include <vector>

#include "base/registries.h"
#include "planning/design/kind.h"
#include "planning/design/measurement.h"
#include "planning/design/placed_object.h"
#include "scene/script/live_scene.h"

namespace parvis::design {

inline constexpr const char *design_type = "design", *placed_type = "placed", *surface_type = "surface",
                            *measured_type = "measured", *kind_type = "kind", *view_type = "camera";

/// Registers design, placed, surface and measured. `registries` outlives the scenes: its readers read models
/// of kinds.
void add_design_nodes(Registries& registries);

/// Does a node in a design stand for an object, a ground surface or a measurement? Kinds and views stand
/// there, too.
bool is_thing(const scene::Node& node);

/// The designs of a scene, in the order of its script.
std::vector<const scene::Node*> designs_of(const scene::LiveScene& live);

/// An object or ground surface as plain data. `node` is a placed or a surface, or a measured, whose kind is
/// then its quantity, whose position its first point.
PlacedObject placed_object(const scene::Scene& scene, const scene::Node& node, const std::string& design);

/// All objects and ground surfaces of all designs, or of one; where scenarios show several, of those that are
/// shown where `only_visible`.
std::vector<PlacedObject> placed_objects(const scene::Scene& scene, const scene::LiveScene& live,
                                         const std::string& design = "", bool only_visible = false);

/// A measurement as plain data. `node` is a measured.
Measurement measurement(const scene::Node& node, const std::string& design);

/// The measurements of all designs, or of one; where `only_visible`, those that are shown.
std::vector<Measurement> measurements(const scene::LiveScene& live, const std::string& design = "",
                                      bool only_visible = false);

}  // namespace parvis::design
