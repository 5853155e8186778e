// From photographs to calibrated photographs: COLMAP finds cameras and points (or points alone, for cameras
// that are given); what it could not use is named; z is turned up. The thesis did this by hand in
// ImageModeler (section 3.3).
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "capture/photographs/colmap_set.h"

namespace parvis::photographs {

struct CalibrationJob {
  std::filesystem::path pictures;  ///< folder of the photographs
  std::filesystem::path folder;    ///< becomes a photograph set (set_file.h), with COLMAP's files in colmap/
  std::filesystem::path
      cameras;  ///< given cameras (camera_files.h): only points are computed. Empty: cameras, too
  std::string lens = "SIMPLE_RADIAL";  ///< COLMAP's model for the cameras that are found
  bool one_lens_for_all = true;        ///< of one camera, size and focal length; else a lens per photograph
  int max_features = 4000;             ///< per photograph; the time of matching grows with its square
  double scale = 1.0;                  ///< metres per unit of the reconstruction; 1 where it is not known
  struct Distance {
    std::string a, b;
    double metres = 0.0;
  };
  std::optional<Distance> distance;  ///< between the positions of two photographs: gives the scale
};

/// Runs the job and writes the set. What an earlier run finished is taken over as long as pictures and
/// options are the same; masks and gains of photographs.json are always kept, also those of photographs that
/// have no camera now. The problems name: pictures that cannot be read, photographs without a camera in the
/// end and why, cameras that do not fit their neighbours: found ones are left out, given ones stay. Errors:
/// COLMAP missing or failed, fewer than two photographs of one place, a photographs.json that cannot be read
/// (it stays as it is).
Result<LoadedSet> calibrate(const CalibrationJob& job);

/// A table for people: each photograph's neighbours, points and reprojection error.
std::string calibration_report(const PhotographSet& set);

}  // namespace parvis::photographs
