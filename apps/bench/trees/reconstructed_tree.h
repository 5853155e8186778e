// A tree that is photographed and reconstructed, and what its pictures are worth.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/bench.h"
#include "capture/trees/billboard_textures.h"
#include "capture/trees/billboard_tree.h"
#include "capture/trees/judge.h"
#include "capture/trees/reconstruction.h"
#include "capture/trees/synthetic_capture.h"
#include "capture/trees/tree_levels.h"

namespace parvis::bench {

using namespace trees;

/// Sums over trees, reported as means; each tree's own value is noted as it comes.
class Means {
 public:
  /// The report outlives it.
  explicit Means(Report& report) : report_(report) {}
  /// Begins a tree, to which all figures added from now on belong.
  void begin_tree(std::string_view name) { tree_ = name; }
  void add(const std::string& key, double value);
  /// Adds all means to the report, in the order in which their keys came first. Fails where one is no finite
  /// number.
  void report() const;

 private:
  struct Entry {
    std::string key;
    double sum, count;
  };

  Report& report_;
  std::string tree_;
  std::vector<Entry> entries_;
};

/// How large captures are.
struct BenchCaptureSize {
  CaptureOptions capture;
  int truth_samples_per_pixel =
      64;  ///< of what pictures are judged by: its own noise would count as their error
  ReconstructionOptions options;
  int held_out = 40, many = 100;  ///< photographs left out, and of the larger capture
};
/// The sizes of the full run, or of the quick one.
BenchCaptureSize bench_capture_size(const BenchSetup& setup);

/// A sample tree, photographed.
struct SampleCapture {
  scene::Model model;
  std::vector<TreeView> views, held_out;
  std::vector<Camera> held_out_cameras;
};
/// Path-traces a sample tree by its name, from `views` places and from those held out.
SampleCapture sample_capture(std::string_view name, int views, const BenchCaptureSize& size);
/// The same tree and the same held-out views, with another number of photographs.
SampleCapture with_photographs(const SampleCapture& capture, int views, const BenchCaptureSize& size);
/// How views are traced that pictures are judged by.
CaptureOptions truth_options(const BenchCaptureSize& size);

/// The reconstructed tree and its costs.
struct ReconstructedTree {
  TreeVolume volume;
  std::shared_ptr<const TreeLevels> levels;  ///< as read back from the file
  std::vector<StepTime> times;               ///< of all steps from photographs to levels of detail
  double megabytes = 0.0;                    ///< of the file
  double seconds = 0.0;                      ///< of the wall clock, over all of them
  std::vector<std::string> notes;            ///< per step
};
/// All steps from views to a tree that can be drawn, on two cores.
ReconstructedTree reconstructed_tree(const SampleCapture& capture, const BenchCaptureSize& size);

/// A tree of a volume as Parvis would read it from a file.
std::shared_ptr<const TreeLevels> levels_from(const TreeVolume& volume, std::span<const TreeView> views,
                                              TextureMethod method);

/// Mean errors of what Parvis draws of a tree from the places of views, in the light of `light`; alpha's
/// root mean square over all of them. Needs a current OpenGL context. Errors: no views.
ViewErrors errors_of(const std::shared_ptr<const TreeLevels>& tree, const scene::Scene& light,
                     std::span<const TreeView> views);
/// The same in the light of the tree's photographs.
ViewErrors errors_of(const std::shared_ptr<const TreeLevels>& tree, std::span<const TreeView> views);

}  // namespace parvis::bench
