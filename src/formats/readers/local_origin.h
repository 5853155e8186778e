// The origin about which a model's coordinates are kept: those of a national grid have seven digits before
// the point, and single precision has seven in all.
#pragma once

#include <glm/glm.hpp>
#include <string>

#include "scene/data/file_account.h"

namespace parvis::formats {

/// Distance from which on single precision ends at millimetres.
inline constexpr double max_local_m = 10'000.0;

/// Whole metres that are to be taken off coordinates (z up) within `low` and `high`: the middle of a plan
/// that is nowhere within `max_local_m` of zero, the middle of such heights; else zero.
glm::dvec3 local_origin(glm::dvec3 low, glm::dvec3 high);

/// Notes a local origin other than zero in the account, with the map's system (`map`, as models hold it;
/// empty: the file names none).
void note_origin(glm::dvec3 origin, const std::string& map, scene::FileAccount& account);

/// Notes that coordinates around an origin other than zero were in single precision when they were read:
/// `whose` says by whom, "the file has" or "the format's reader has".
void note_single_precision(glm::dvec3 origin, const std::string& whose, scene::FileAccount& account);

}  // namespace parvis::formats
