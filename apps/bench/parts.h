// What the parts of the benches measure: one function each, which parts.cpp lists.
#pragma once

#include "bench/bench.h"

namespace parvis::bench {

using Measured = void(const BenchSetup& setup, Report& report);

Measured measure_frames, measure_mirrors;       // frame.cpp
Measured measure_processes, measure_window;     // commands.cpp
Measured measure_isolation;                     // formats/reading.cpp
Measured measure_place_files, measure_streets;  // formats/places.cpp
Measured measure_maps_memory, measure_placement, measure_maps_cost, measure_maps_near_cost,
    measure_maps_bodies, measure_maps_city_size, measure_maps_quality, measure_maps_traced,
    measure_maps_motion, measure_maps_budget, measure_maps_paper,
    measure_maps_other_places;  // reflections/maps.cpp
Measured measure_explosion_maps, measure_search, measure_roots, measure_edges, measure_cost, measure_grids,
    measure_kitchen, measure_bonnet, measure_two_bounces, measure_refraction;  // curved/
Measured measure_sky, measure_sky_update, measure_relighting, measure_lit_object, measure_bounced_light,
    measure_night, measure_sun_hours, measure_shadows, measure_shadow_times;        // light/
Measured measure_plan, measure_plan_precision, measure_sketch, measure_plan_files;  // plan.cpp
Measured measure_plan_drawings;                                                     // plan_drawings.cpp
Measured measure_clicked_cameras;                                                   // clicked_cameras.cpp
Measured measure_study_replay, measure_study_kills, measure_study_cases, measure_study_xdf;  // study.cpp
Measured measure_off_axis, measure_blending, measure_walls_cost, measure_walls_lock,
    measure_wand;                                                                        // display.cpp
Measured measure_noise_cases, measure_noise_map;                                         // noise.cpp
Measured measure_sound;                                                                  // sound.cpp
Measured measure_vegetation;                                                             // vegetation.cpp
Measured measure_sceaux, measure_courtyard, measure_filling, measure_drawings;           // facades/
Measured measure_reconstruction, measure_display, measure_maize, measure_distribution;   // trees/
Measured measure_walking, measure_recorded_people, measure_shown_people, measure_jumps;  // crowd/crowd.cpp
Measured measure_square, measure_levels;                                                 // crowd/square.cpp
Measured measure_square_first_picture;                                                   // square/square.cpp

/// Parts of reflections/maps.cpp, on a stage of the paper's city or on its scene.
void measure_motion(stage::Stage& stage, const BenchSetup& setup, Report& report);
void measure_budget(stage::Stage& stage, const BenchSetup& setup, Report& report);
void measure_body_count(const scene::Scene& city, const BenchSetup& setup, Report& report);
void measure_city_size(const scene::Scene& city, const BenchSetup& setup, Report& report);

}  // namespace parvis::bench
