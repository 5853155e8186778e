// A street for vehicles as scripts, generators and city models give it; the road builder makes lanes of it.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "base/result.h"

namespace parvis::scene {

/// A road as its author sees it: one centre line for both directions of travel.
struct Road {
  std::vector<glm::vec3> path;  ///< centre line on the ground, metres; lanes take their height from it
  int lanes_each_way = 1;       ///< along the path where `lanes_back` says another number
  int lanes_back = 0;           ///< against the path, of two-way roads; 0: as many as along it
  bool is_one_way =
      false;  ///< all lanes run from the path's first point to its last, side by side about the path
  float lane_width_m = 3.0f;
  float speed_limit = 13.9f;  ///< m/s
  FileLocation where;         ///< of the script's node, for errors
  std::string name;           ///< for errors; may be empty

  int lanes_against() const { return is_one_way ? 0 : lanes_back > 0 ? lanes_back : lanes_each_way; }
};

}  // namespace parvis::scene
