// The captures and reconstructions that figures of trees are measured on.
#pragma once

#include <string>
#include <vector>

#include "capture/trees/bench/tree_figures.h"
#include "capture/trees/billboard_tree.h"
#include "capture/trees/reconstruction.h"
#include "capture/trees/synthetic_capture.h"

namespace parvis::trees {

/// How large captures are.
struct BenchCaptureSize {
  CaptureOptions capture;
  ReconstructionOptions options;
  int held_out = 40;
};
/// The sizes of the full run, or of the quick one.
BenchCaptureSize bench_capture_size(const FigureOptions& options);

/// A sample tree, photographed.
struct SampleCapture {
  scene::Model model;
  std::vector<TreeView> views, held_out;
  std::vector<Camera> held_out_cameras;
};
/// Path-traces a sample tree by its name, from `views` places and from those held out.
Result<SampleCapture> sample_capture(std::string_view name, int views, const BenchCaptureSize& size);

/// What comes of it.
struct ReconstructedTree {
  TreeVolume volume;
  BillboardTree tree;
  double seconds = 0.0, megabytes = 0.0;  ///< all steps; of the file
  std::vector<std::string> notes;         ///< per step
};
/// All steps from views to a tree that can be drawn.
Result<ReconstructedTree> reconstructed_tree(const SampleCapture& capture, const BenchCaptureSize& size);

}  // namespace parvis::trees
