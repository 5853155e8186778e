// What PROJ makes, owned: contexts that say nothing, coordinate systems and their parts.
#pragma once

#include <proj.h>

#include <memory>

namespace parvis::scene {

struct DestroyOfProj {
  void operator()(PJ* object) const { proj_destroy(object); }
  void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
};
using ProjContext = std::unique_ptr<PJ_CONTEXT, DestroyOfProj>;
using ProjObject = std::unique_ptr<PJ, DestroyOfProj>;

/// Systems that nobody knows are for us to report.
inline ProjContext quiet_context() {
  ProjContext context(proj_context_create());
  proj_log_level(context.get(), PJ_LOG_NONE);
  return context;
}

/// The system itself; of one that is made of several the first, of one that is bound to a datum shift what is
/// bound.
inline ProjObject plan_of(PJ_CONTEXT* context, ProjObject system) {
  constexpr int deepest = 4;
  for (int depth = 0; system && depth < deepest; ++depth) {
    const PJ_TYPE type = proj_get_type(system.get());
    if (type == PJ_TYPE_COMPOUND_CRS)
      system.reset(proj_crs_get_sub_crs(context, system.get(), 0));
    else if (type == PJ_TYPE_BOUND_CRS)
      system.reset(proj_get_source_crs(context, system.get()));
    else
      break;
  }
  return system;
}

}  // namespace parvis::scene
