// script/bench import_export, real places: from a file that nobody has described to a street.
#pragma once

#include "bench/benches.h"

namespace parvis::bench {

/// Adds, of bare files of each kind:
/// minutes_to_first_street (the slowest, reading to picture), and minutes_to_first_street_KIND by kind of
/// file; first_street_shown_percent (the least of a first picture that shows the place), for a quick picture
/// of nothing is none, with its control first_street_shown_percent_turned_away, which must be near 0;
/// first_street_flip_to_traced (the greatest FLIP of a first picture, where it shows the place, against the
/// ray tracer's) with its control first_street_flip_to_traced_of_black_pictures;
/// faults_without_warning (see planted_faults.h);
/// warnings_unexplained, and warnings_unexplained_of_a_wrong_script, a control that must not be 0;
/// osm_triangles_over_buildings (all static triangles of a dressed map by those of its buildings), with its
/// control osm_triangles_over_buildings_of_a_lone_house, which must be beyond the target;
/// ground_gap_percent (of the lower halves of 50 street views of each place) with its control
/// ground_gap_percent_without_plane, which must not be 0;
/// paving_height_error_m (99th percentile against the bare ground, with things on it) with its control
/// paving_height_error_m_on_a_slab, which must be large;
/// pbf_mb_s; ifc_load_ms (skipped without scenes/pavilion.ifc). Needs a current OpenGL context.
Status measure_places(const BenchSetup& setup, Report& report);

}  // namespace parvis::bench
