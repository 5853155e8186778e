// What a reconstruction keeps of its steps, and how it finds them again.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/kept_parts.h"
#include "capture/trees/reconstruction.h"

namespace parvis::trees {

/// A step of a reconstruction that is kept: its name, and the hash of all that its result depends on.
struct KeptStep {
  std::string name;
  std::uint64_t key = 0;
};

/// The steps of a reconstruction.
struct KeptSteps {
  KeptStep cutoff, opacity, colours, finer;

  /// Steps of these photographs with these options. How many processes and threads share the work does not
  /// count.
  static KeptSteps of(std::span<const TreeView> views, const ReconstructionOptions& options);
};

/// A volume and how far its fit is.
struct FittedVolume {
  TreeVolume volume;
  FitState state;
};

/// Opacities as they are kept.
std::string bytes_of(const Opacities& opacities);
/// A fitted volume as it is kept.
std::string bytes_of(const TreeVolume& volume, const FitState& state);
/// Opacities from kept bytes; nothing where the bytes hold none.
std::optional<Opacities> opacities_of(std::string_view bytes);
/// A fitted volume from kept bytes; nothing where the bytes hold none.
std::optional<FittedVolume> fitted_volume_of(std::string_view bytes);

/// Finds and keeps the steps of one reconstruction, as its options say. The first process alone reads and
/// writes; all processes call the same functions in the same order, and all go on or none.
class StepKeeper {
 public:
  /// The options outlive it.
  explicit StepKeeper(const ReconstructionOptions& options);

  /// The kept content of a step; empty: there is none.
  std::string find(const KeptStep& step) const;
  /// Called after each bit of work. `content` is kept if the step is finished by it, if the time has come, or
  /// if the work is to be interrupted. Error: the work ends here, interrupted or because it cannot be kept.
  Status keep(const KeptStep& step, bool is_finished, const std::function<std::string()>& content);

 private:
  const ReconstructionOptions& options_;
  KeptParts checkpoint_;  // of the first process
  std::chrono::steady_clock::time_point last_;
};

}  // namespace parvis::trees
