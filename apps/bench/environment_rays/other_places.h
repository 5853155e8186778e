// Reflections in places and on cars that the method was not made with.
#pragma once

#include <filesystem>

#include "base/house.h"
#include "bench/report.h"
#include "reflections/methods/settings.h"

namespace parvis::bench {

/// `other_places_flip_ratio` and `other_places_flip_ratio_worst`: FLIP of the shipped method over that of
/// re-rendered cube maps, in near views of Delft's glTF cars and The Hague's Peugeot. Maps are kept in
/// `folder`. Skipped where the scenes or the shared data are absent.
Status measure_other_places(const House& house, const methods::Settings& shipped,
                            const std::filesystem::path& folder, bool is_quick, Report& report);

}  // namespace parvis::bench
