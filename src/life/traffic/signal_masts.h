// Masts of traffic lights as models: static masts, and lit lamps, which are shown in turn.
#pragma once

#include <memory>

#include "life/traffic/signals.h"
#include "scene/data/model.h"

namespace parvis::traffic {

/// Masts, housings and dark lenses of a junction's lights, in the world's frame.
std::shared_ptr<const scene::Model> signal_masts(const SignalJunction& junction);

/// Lamps of a junction that are lit together: those of drivers in one phase and colour, or of people who
/// cross the streets of one phase, in the world's frame; no parts where there are none.
std::shared_ptr<const scene::Model> lit_drive_lamps(const SignalJunction& junction, int phase,
                                                    DriveLight light);
/// The lamps for people who cross the streets of a phase, see above.
std::shared_ptr<const scene::Model> lit_walk_lamps(const SignalJunction& junction, int phase,
                                                   scene::WalkLight light);

}  // namespace parvis::traffic
