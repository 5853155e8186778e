#include "bench/all_benches.h"

#include "bench/environment_rays/multiple_environment_maps_bench.h"
#include "bench/facades/facades_bench.h"
#include "bench/frame/frame_bench.h"
#include "bench/light/light_bench.h"
#include "bench/processes_bench.h"
#include "bench/readers/import_export_bench.h"
#include "bench/trees/trees_bench.h"
#include "bench/vegetation/vegetation_bench.h"
#include "bench/virtual_objects/curved_reflectors_bench.h"
#include "bench/window_bench.h"

namespace parvis::bench {

const Benches& all_benches() {
  static const Benches benches = [] {
    Benches all;
    for (const auto add :
         {add_frame, add_window, add_processes, add_import_export, add_multiple_environment_maps,
          add_curved_reflectors, add_light, add_vegetation, add_facades, add_trees})
      add(all);
    return all;
  }();
  return benches;
}

}  // namespace parvis::bench
