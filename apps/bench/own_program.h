// The program parvis, run as a user runs it: for figures of whole commands.
#pragma once

#include <string>
#include <vector>

#include "base/result.h"

namespace parvis::bench {

/// Is there a program of this name?
bool has_program(const std::string& name);

/// What the program says, and how long it ran.
struct OwnRun {
  std::string output;    ///< standard output
  double seconds = 0.0;  ///< by the clock, all of it
};

/// Runs parvis, which was built beside, with `arguments`; `before` are words that stand before it ("mpirun -n
/// 2"), as the shell takes them. An error where it ends with another status than 0.
Result<OwnRun> run_own_program(const std::string& before, const std::vector<std::string>& arguments);

/// The first number after `text` in what a program said. An error where there is none.
Result<double> number_after(const std::string& output, const std::string& text);

}  // namespace parvis::bench
