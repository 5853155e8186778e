// The scripts of the square: the place with its streets, tram, traffic, people and sound; and its designs.
#pragma once

#include <span>
#include <string>

namespace parvis::square {

/// The place itself, without anything that moves or may be changed: what its photographs are taken of.
std::string place_script();

/// The place in motion, with two designs, scenarios and views. `vehicle_files` are the models of the traffic.
std::string square_script(std::span<const std::string> vehicle_files);

}  // namespace parvis::square
