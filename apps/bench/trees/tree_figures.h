// What the bench `trees` measures: captures with truth, path-traced, from photographs to what the house
// draws. Every figure that has a target has a control beside it that must miss it, else the bench fails: its
// key ends in what was done wrong. Figures of nothing are errors.
#pragma once

#include <filesystem>
#include <string_view>

#include "base/result.h"
#include "bench/report.h"

namespace parvis::trees {

/// How much is measured: `is_quick` takes two trees in place of four, small pictures and a coarser grid.
struct FigureOptions {
  bool is_quick = false;
};

/// Opacity, pictures, sizes, minutes, measurements and relighting of reconstructed trees. Needs a current
/// OpenGL context.
Status measure_reconstruction(const FigureOptions& options, bench::Report& report);

/// A thousand trees in a scene, and what levels of detail change there. Needs a current OpenGL context.
Status measure_display(const FigureOptions& options, bench::Report& report);

/// Silhouettes of a real maize plant that were left out, of the shared photographs; skipped where those are
/// not beside the checkout. Needs a current OpenGL context.
Status measure_maize(const FigureOptions& options, bench::Report& report);

/// Does what `parvis tree reconstruct` printed say that so many processes made the tree together?
bool says_processes(std::string_view report, int count);

/// The reconstruction by two processes of MPI that run `program`, the parvis command, against one.
Status measure_distribution(const FigureOptions& options, const std::filesystem::path& program,
                            bench::Report& report);

}  // namespace parvis::trees
