#include "bench/curved_bench.h"

#include "bench/curved_bonnet.h"
#include "bench/curved_cost.h"
#include "bench/curved_edges.h"
#include "bench/curved_grids.h"
#include "bench/curved_kitchen.h"
#include "bench/curved_refraction.h"
#include "bench/curved_roots.h"
#include "bench/curved_search.h"
#include "bench/curved_two_bounces.h"

namespace parvis::bench {

Result<Report> curved_bench(bool is_quick) {
  Report report("curved");
  for (const auto measure : {measure_search, measure_roots, measure_edges, measure_cost, measure_grids,
                             measure_kitchen, measure_bonnet, measure_two_bounces, measure_refraction})
    if (Status status = measure(is_quick, report); !status) return status.errors();
  return report;
}

}  // namespace parvis::bench
