// The program parvis, run as a user runs it: for figures of whole commands.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace parvis::bench {

/// Is there a program of this name?
bool has_program(const std::string& name);

/// Output of the program, and how long it ran.
struct OwnRun {
  std::string output;    ///< standard output
  double seconds = 0.0;  ///< by the clock, all of it
};

/// Runs parvis, which was built beside, with `arguments`; `before` are words that stand before it ("mpirun
/// -n 2"), as the shell takes them. Fails where it ends with another status than 0.
OwnRun run_own_program(const std::string& before, const std::vector<std::string>& arguments);

/// Runs `work` in a child process, which it leaves by returning where it fails, and kills the child at a
/// moment after it has called its argument `wanted` times: each call, false where nobody listens,
/// acknowledges what was done before it. Returns how often it was called.
int acknowledged_before_kill(int wanted, const std::function<void(const std::function<bool()>&)>& work);

/// The first number after `text` in what a program printed. Fails where there is none.
double number_after(const std::string& output, const std::string& text);

}  // namespace parvis::bench
