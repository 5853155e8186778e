// Objects that play an animation of their model: posed and deformed as time goes on, for every renderer
// alike.
#pragma once

#include "scene/data/scene.h"

namespace parvis::scene {

/// Lets `object` play its model's animation: from now on it moves.
void play(Object& object, const PlayedAnimation& played);

/// Poses and deforms every object that plays an animation, as it stands `time_s` after the scene began;
/// hidden ones, too.
void animate(Scene& scene, double time_s);

}  // namespace parvis::scene
