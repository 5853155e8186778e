#include "bench/parts.h"

namespace parvis::bench {

std::span<const Part> all_parts() {
  static const std::vector<Part> parts{
      // clang-format off
      {"frame", "city", "frames of the paper's city with and without reflections, culling, rays", measure_frames},
      {"frame", "mirrors", "a mirror ball and box against the ray tracer", measure_mirrors},
      {"window", "walk", "frames per second of the window while walking", measure_window},
      {"processes", "speedup", "how much sooner two processes bake and take a photograph than one", measure_processes, false},
      {"import_export", "reading", "scripts and city models read", measure_reading, false},
      {"import_export", "places", "from bare files to streets", measure_streets},
      {"import_export", "files", "streets over hills, packed maps, buildings, planted faults", measure_place_files, false},
      {"import_export", "scenarios", "a scenario of the paper's city chosen", measure_scenarios},
      {"import_export", "photographs", "rays of path-traced photographs", measure_photographs, false},
      {"import_export", "isolation", "what reading in a child process costs", measure_isolation, false},
      {"multiple_environment_maps", "memory", "bytes of maps, rays through heights", measure_maps_memory},
      {"multiple_environment_maps", "placement", "maps that show the city, beside an even spread", measure_placement},
      {"multiple_environment_maps", "cost", "thirty cars from above, beside re-rendered maps", measure_maps_cost},
      {"multiple_environment_maps", "near_cost", "ten cars in the street, one near, beside re-rendered maps", measure_maps_near_cost},
      {"multiple_environment_maps", "bodies", "a hundred bodies in place of one", measure_maps_bodies},
      {"multiple_environment_maps", "city_size", "ten times the city", measure_maps_city_size},
      {"multiple_environment_maps", "quality", "near cars against the ray tracer, beside the baselines", measure_maps_quality},
      {"multiple_environment_maps", "traced", "traced reflections of near cars, beside maps", measure_maps_traced},
      {"multiple_environment_maps", "motion", "reflections of cars that drive", measure_maps_motion},
      {"multiple_environment_maps", "budget", "frames of a drive that hold a budget", measure_maps_budget},
      {"multiple_environment_maps", "paper", "the paper's own configuration", measure_maps_paper},
      {"multiple_environment_maps", "other_places", "places and cars that the method was not made with", measure_maps_other_places},
      {"curved_reflectors", "explosion_maps", "the search beside explosion maps", measure_explosion_maps, false},
      {"curved_reflectors", "search", "the search beside the paper's, on real bodies and ellipsoids", measure_search, false},
      {"curved_reflectors", "roots", "several images of one vertex", measure_roots, false},
      {"curved_reflectors", "edges", "long edges", measure_edges, false},
      {"curved_reflectors", "cost", "the search on the GPU beside one more draw", measure_cost},
      {"curved_reflectors", "grids", "flicker and pictures of virtual grids", measure_grids, false},
      {"curved_reflectors", "kitchen", "the kitchen's mirrors beside re-rendered cube maps", measure_kitchen},
      {"curved_reflectors", "bonnet", "a person in a bonnet", measure_bonnet},
      {"curved_reflectors", "two_bounces", "mirrors in mirrors", measure_two_bounces},
      {"curved_reflectors", "refraction", "glass beside re-rendered cube maps", measure_refraction},
      {"light", "sky", "sun positions and skies against their ground truths", measure_sky},
      {"light", "sky_update", "what a new hour's sky costs", measure_sky_update},
      {"light", "relighting", "rays at the vertices of a moved object", measure_relighting},
      {"light", "lit_object", "what a running scene shows of a moved object's light", measure_lit_object},
      {"light", "bounced_light", "pictures with bounced light against photographs", measure_bounced_light},
      {"light", "night", "pictures in the light of lamps against photographs", measure_night},
      {"light", "sun_hours", "hours of sun against rays at each minute", measure_sun_hours, false},
      {"light", "shadows", "shadows of each technique against exact ones", measure_shadows},
      {"light", "shadow_times", "exact shadows of a picture beside its shadow maps", measure_shadow_times},
      {"plan", "hand", "a bench that is dragged and placed in the paper's city", measure_plan},
      {"plan", "files", "undo, replay and kills", measure_plan_files, false},
      {"plan", "photomontage", "cameras of photographs from six clicks", measure_clicked_cameras, false},
      {"noise", "cases", "propagation and emission against the published cases", measure_noise_cases, false},
      {"noise", "map", "the map of The Hague, and levels after a change of traffic", measure_noise_map, false},
      {"sound", "mix", "mixing, what is heard against the map of noise, shadows", measure_sound, false},
      {"vegetation", "grove", "points and lines of grown plants against their real geometry", measure_vegetation},
      {"facades", "sceaux", "the castle: held-out photographs, costs, times of drawing", measure_sceaux},
      {"facades", "courtyard", "the courtyard: held-out photographs", measure_courtyard},
      {"facades", "filling", "filling of a texture that is known", measure_filling, false},
      {"facades", "drawing", "times of drawing alone", measure_drawings, true, true},
      {"trees", "reconstruction", "held-out photographs of captured trees, time, memory, measures", measure_reconstruction},
      {"trees", "display", "a wood of a thousand captured trees", measure_display},
      {"trees", "maize", "silhouettes of a real plant", measure_maize},
      {"trees", "distribution", "two processes beside one", measure_distribution, false},
      // clang-format on
  };
  return parts;
}

}  // namespace parvis::bench
