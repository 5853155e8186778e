#include "capture/trees/bench/reconstructed_tree.h"

#include <chrono>
#include <filesystem>

#include "capture/trees/billboard_textures.h"
#include "capture/trees/sample_trees.h"
#include "capture/trees/tree_file.h"

namespace parvis::trees {
namespace {

constexpr float thesis_cutoff = 0.94f;  // of its oak: a search by held-out error would double the time

}  // namespace

BenchCaptureSize bench_capture_size(const FigureOptions& options) {
  BenchCaptureSize size;
  size.options.cutoff = thesis_cutoff;
  if (!options.is_quick) return size;
  size.capture.width = size.capture.height = 160;
  size.capture.samples_per_pixel = 9;
  size.options.grid.level = 3;
  size.held_out = 6;
  return size;
}

Result<SampleCapture> sample_capture(std::string_view name, int views, const BenchCaptureSize& size) {
  Result<scene::Model> model = make_sample_tree(name, 1);
  if (!model) return model.errors();
  const scene::Scene scene = capture_scene(*model, {});
  const Bounds bounds = scene::bounds(*model);
  SampleCapture capture{*std::move(model), {}, {}, held_out_cameras(bounds, size.held_out, 5)};
  capture.views = photograph_tree(scene, capture_cameras(bounds, views), std::string(name), size.capture);
  CaptureOptions other = size.capture;
  other.seed += 76;
  capture.held_out = photograph_tree(scene, capture.held_out_cameras, std::string(name) + " held out", other);
  return capture;
}

Result<ReconstructedTree> reconstructed_tree(const SampleCapture& capture, const BenchCaptureSize& size) {
  const auto start = std::chrono::steady_clock::now();
  Result<Reconstruction> found = reconstruct(capture.views, size.options);
  if (!found) return found.errors();
  ReconstructedTree made{std::move(found->volume), {}, 0.0, 0.0, std::move(found->notes)};
  made.tree = textured(made.volume, capture.views, {});
  const std::filesystem::path file = std::filesystem::temp_directory_path() /
                                     fmt::format("parvis_bench_{}.tree", start.time_since_epoch().count());
  const Result<std::size_t> bytes = write_tree(file, made.tree);
  std::error_code code;
  std::filesystem::remove(file, code);
  if (!bytes) return bytes.errors();
  made.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  made.megabytes = double(*bytes) * 1e-6;
  made.tree = as_stored(std::move(made.tree));
  return made;
}

}  // namespace parvis::trees
