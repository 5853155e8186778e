// COLMAP models as photograph sets and back.
#pragma once

#include <filesystem>

#include "capture/photographs/colmap_model.h"
#include "capture/photographs/photograph.h"

namespace parvis::photographs {

/// A set, and what could not be used of its source, one message per photograph, camera or point that was left
/// out or mended.
struct LoadedSet {
  PhotographSet set;
  Errors problems;
};

/// The photographs of a model, each with the mean reprojection error of its own observations. Left out, with
/// a problem that names it: an image whose camera is missing, whose pose is no rotation, whose name occurs
/// twice or leads out of the folder of pictures; a camera that no image uses is named. Observations of what
/// is missing are dropped.
LoadedSet photograph_set_of(const ColmapModel& model, const std::filesystem::path& picture_folder);

/// The model of a set: photographs of equal lenses share a camera. Identifiers count from 1 in the order of
/// the set.
ColmapModel colmap_model_of(const PhotographSet& set);

/// Each photograph's mean distance between its observations and where its camera sees their points; -1
/// without any.
void measure_reprojection(PhotographSet& set);

}  // namespace parvis::photographs
