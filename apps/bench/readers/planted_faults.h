// Places with a fault each, of which loading must warn: no warning at all would pass for a right place.
#pragma once

#include <filesystem>

#include "base/house.h"
#include "bench/report.h"

namespace parvis::bench {

/// Adds faults_without_warning: of roofs without walls, a camera in a wall, roads above nothing, a dressing
/// and a mask that match nothing, how many are loaded without the warning that names the fault; and, as its
/// control, faults_without_warning_in_sound_places, the same of the same places without their faults. Writes
/// into `folder`.
Status measure_planted_faults(const House& house, const std::filesystem::path& folder, Report& report);

}  // namespace parvis::bench
