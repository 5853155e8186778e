// Bodies that mirror their surroundings all round, as the paper's figures have them (Meyer and Loscos 2003):
// the ball of figure 9, the whale of figure 10.
#pragma once

#include "scene/data/model.h"

namespace parvis::city {

/// Polished metal, 2 m across, its middle at the origin.
scene::Model make_ball();

/// Polished metal, 12 m long; x forward, y left, z up, its middle about the origin.
scene::Model make_whale();

}  // namespace parvis::city
