// The captures and reconstructions that figures of trees are measured on.
#pragma once

#include <string>
#include <vector>

#include "bench/trees/tree_figures.h"
#include "capture/trees/billboard_textures.h"
#include "capture/trees/billboard_tree.h"
#include "capture/trees/judge.h"
#include "capture/trees/reconstruction.h"
#include "capture/trees/synthetic_capture.h"
#include "capture/trees/tree_levels.h"

namespace parvis::trees {

/// How large captures are.
struct BenchCaptureSize {
  CaptureOptions capture;
  int truth_samples_per_pixel =
      64;  ///< of what pictures are judged by: its own noise would count as their error
  ReconstructionOptions options;
  int held_out = 40, many = 100;  ///< photographs left out, and of the larger capture
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
/// The same tree and the same held-out views, with another number of photographs.
SampleCapture with_photographs(const SampleCapture& capture, int views, const BenchCaptureSize& size);
/// How views are traced that pictures are judged by.
CaptureOptions truth_options(const BenchCaptureSize& size);

/// What comes of it.
struct ReconstructedTree {
  TreeVolume volume;
  std::shared_ptr<const TreeLevels> levels;  ///< as read back from the file
  std::vector<StepTime> times;               ///< of all steps from photographs to levels of detail
  double megabytes = 0.0;                    ///< of the file
  double seconds = 0.0;                      ///< of the wall clock, over all of them
  std::vector<std::string> notes;            ///< per step
};
/// All steps from views to a tree that can be drawn, on two cores.
Result<ReconstructedTree> reconstructed_tree(const SampleCapture& capture, const BenchCaptureSize& size);

/// A tree of a volume as the house would read it from a file.
std::shared_ptr<const TreeLevels> levels_from(const TreeVolume& volume, std::span<const TreeView> views,
                                              TextureMethod method);

/// Mean errors of what the house draws of a tree from the places of views, in the light of `light`; alpha's
/// root mean square over all of them. Needs a current OpenGL context. Errors: no views.
Result<ViewErrors> errors_of(const std::shared_ptr<const TreeLevels>& tree, const scene::Scene& light,
                             std::span<const TreeView> views);
/// The same in the light of the tree's photographs.
Result<ViewErrors> errors_of(const std::shared_ptr<const TreeLevels>& tree, std::span<const TreeView> views);
/// The same of the mesh that was photographed, as the house draws any object, at full detail: its shape is
/// exact, but leaves do not hide the sky from each other as they do in photographs.
Result<ViewErrors> errors_of_mesh(const scene::Model& model, std::span<const TreeView> views);

}  // namespace parvis::trees
