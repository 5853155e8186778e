// What the bench `trees` measures: captures with truth, path-traced, from photographs to the display. Every
// figure has a control beside it that must fail the figure's target: its key ends in what was done wrong.
#pragma once

#include <functional>
#include <string>

#include "base/result.h"

namespace parvis::trees {

/// Receives figures as they come.
struct FigureSink {
  std::function<void(const std::string& key, double value)> add;
  std::function<void(const std::string& row)> note;
};

/// How much is measured: `is_quick` takes two trees in place of four, small pictures and a coarser grid.
struct FigureOptions {
  bool is_quick = false;
};

/// Opacity, pictures, sizes, minutes, measurements and relighting of reconstructed trees, and the estimate in
/// two groups of photographs.
Status measure_reconstruction(const FigureOptions& options, const FigureSink& sink);

/// A thousand trees in a scene, and what levels of detail change. Needs a current OpenGL context.
Status measure_display(const FigureOptions& options, const FigureSink& sink);

}  // namespace parvis::trees
