// How photographs are calibrated: the options that `parvis facade calibrate` and `walk` have in common.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "capture/photographs/calibrate.h"

namespace parvis {

struct CalibrationArguments {
  photographs::CalibrationJob job;
  std::vector<std::string> distance;  ///< two photographs, and metres

  void add(CLI::App& stage);
  /// Calibrates, and reports on standard output; problems go to standard error.
  Status run();
};

}  // namespace parvis
