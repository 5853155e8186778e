// A grown plant as a model of few triangles.
#pragma once

#include "life/vegetation/scene_plant.h"
#include "scene/data/model.h"

namespace parvis::share {

/// True if the model has fewer leaves than the plant, each so much larger that the area is that of all.
bool is_thinned(const vegetation::PlantShape& shape);

/// Leaves of two triangles and the thickest wood. The alpha of corners is the share of the sky that the plant
/// itself leaves open there.
scene::Model plant_model(const vegetation::PlantShape& shape);

}  // namespace parvis::share
