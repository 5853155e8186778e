// What drawing a captured place takes, beside the same triangles with one texture.
#pragma once

#include <memory>

#include "base/camera.h"
#include "base/result.h"
#include "bench/report.h"
#include "capture/facades/packed_facade.h"

namespace parvis::bench {

/// The keys draw_... of a facade seen by a camera: medians of ratios of drawings that follow one another.
Status measure_drawing(std::shared_ptr<const facades::PackedFacade> facade, const Camera& camera,
                       bool is_quick, Report& report);

}  // namespace parvis::bench
