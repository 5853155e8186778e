// What drawing a captured place costs.
#pragma once

#include <memory>

#include "bench/bench.h"
#include "capture/facades/packed_facade.h"

namespace parvis::bench {

/// draw_over_plain_texture_time and what belongs to it, from a camera. Needs a current OpenGL context.
void measure_drawing(std::shared_ptr<const facades::PackedFacade> facade, const Camera& camera, bool is_quick,
                     Report& report);

}  // namespace parvis::bench
