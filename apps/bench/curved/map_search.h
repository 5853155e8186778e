// The searches over reflector maps that the benches of curved reflectors compare.
#pragma once

#include "reflections/reflection_search/reflection_search.h"
#include "reflections/reflector_maps/reflector_map.h"

namespace parvis::bench {

using MapSearch = reflection_search::ReflectionSearch<reflector_maps::ReflectorMap>;

/// The paper's search from where the paper begins: nine steps of its midpoint method.
MapSearch::PatchPoint by_midpoint(MapSearch& search, const MapSearch::ReflectionTask& task);

}  // namespace parvis::bench
