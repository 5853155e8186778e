// Progress of long work: a bar with an estimate on a terminal, plain lines elsewhere, on standard error.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

namespace parvis {

class Progress {
 public:
  /// `total` steps are to come; `what` names the work ("rendering film").
  Progress(std::string what, std::size_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Counts `steps` as done. Any thread may call it.
  void advance(std::size_t steps = 1);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace parvis
