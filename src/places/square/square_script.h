// The scripts of the square: the place with its streets, tram, traffic, people and sound; and its designs.
#pragma once

#include <span>
#include <string>

namespace parvis::square {

/// Sun, sky and air.
std::string light_script();

/// The light and the place itself, without anything that moves or may be changed: what its photographs are
/// taken of.
std::string place_script();

/// Everything else, for the place or for what was captured of it: lamps, tram, traffic, people, sound,
/// designs, scenarios and views. `vehicle_files` are the models of the traffic.
std::string life_script(std::span<const std::string> vehicle_files);

/// The place in motion, with its plane trees.
std::string square_script();

}  // namespace parvis::square
