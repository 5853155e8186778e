// The hash of all that a photograph of a scene depends on.
#pragma once

#include <cstdint>

#include "scene/data/scene.h"

namespace parvis::scene {

/// The shapes, surfaces and places of all objects, sun, sky, air, and what rooms keep in the scene to be
/// drawn (`DataRole`). Cameras, roads and exposure leave it alone.
std::uint64_t scene_key(const Scene& scene);

/// The same without dynamic and hidden objects: what a picture of the static surroundings depends on.
std::uint64_t fixed_scene_key(const Scene& scene);

/// The same without sun, sky and air: what light of any hour hits.
std::uint64_t fixed_shape_key(const Scene& scene);

}  // namespace parvis::scene
