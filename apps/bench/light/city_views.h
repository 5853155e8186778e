// Views of a city from many places: its streets, its balconies, and from above.
#pragma once

#include <vector>

#include "base/camera.h"
#include "bench/light/double_tracer.h"
#include "scene/data/scene.h"

namespace parvis::bench {

/// So many views of a picture's size, each above another point of the lanes where traffic drives: in turn
/// from the height of a person's eyes, of a balcony, of eyes again, and from above the roofs, steeply down;
/// in any heading. None stands inside of a body of `tracer`, which has the city's opaque_twin, or so near to
/// one that nothing else is seen. Fails where the city has no lanes, or too few places that are free.
Result<std::vector<Camera>> city_views(const scene::Scene& city, const DoubleTracer& tracer,
                                       std::size_t count, int width, int height);

}  // namespace parvis::bench
