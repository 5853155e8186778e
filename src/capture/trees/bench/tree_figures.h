// What the bench `trees` measures: captures with truth, path-traced, from photographs to what the house
// draws. Every figure that has a target has a control beside it that must fail it: its key ends in what was
// done wrong, and a row says so if it does not. Figures that are no numbers, or of nothing, are errors.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "base/result.h"

namespace parvis::trees {

/// What a figure must reach.
struct Target {
  double limit = 0.0;
  bool is_maximum = false;  ///< what it must not exceed; else the minimum

  bool is_reached_by(double value) const { return is_maximum ? value <= limit : value >= limit; }
};

/// Receives figures as they come.
struct FigureSink {
  std::function<void(const std::string& key, double value)> add;
  std::function<void(const std::string& row)> note;
  std::function<void(const std::string& key, const std::string& why)> skip;

  /// Adds a figure. Errors: it is not finite.
  Status figure(const std::string& key, double value) const;
  /// Adds the figure of a control, which must miss `target`: a row says so where it does not, for then the
  /// figure that it stands beside says nothing. Errors: it is not finite.
  Status control(const std::string& key, double value, const Target& target) const;
};

/// How much is measured: `is_quick` takes two trees in place of four, small pictures and a coarser grid.
struct FigureOptions {
  bool is_quick = false;
};

/// Opacity, pictures, sizes, minutes, measurements and relighting of reconstructed trees. Needs a current
/// OpenGL context.
Status measure_reconstruction(const FigureOptions& options, const FigureSink& sink);

/// A thousand trees in a scene, and what levels of detail change there. Needs a current OpenGL context.
Status measure_display(const FigureOptions& options, const FigureSink& sink);

/// Silhouettes of a real maize plant that were left out, of the shared photographs; skipped where those are
/// not beside the checkout. Needs a current OpenGL context.
Status measure_maize(const FigureOptions& options, const FigureSink& sink);

/// Does what `parvis tree reconstruct` printed say that so many processes made the tree together?
bool says_processes(std::string_view report, int count);

/// The reconstruction by two processes of MPI that run `program`, the parvis command, against one.
Status measure_distribution(const FigureOptions& options, const std::filesystem::path& program,
                            const FigureSink& sink);

}  // namespace parvis::trees
