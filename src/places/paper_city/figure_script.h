// The places of the paper's figures 7, 9 and 10 in its city (Meyer and Loscos 2003): a ball, a whale, trees
// and people, and good places to look from.
#pragma once

#include <string>

namespace parvis::city {

/// Includes the script of the city with its people.
std::string figure_script();

}  // namespace parvis::city
