#include "bench/trees/reconstructed_tree.h"

#include <tbb/global_control.h>

#include <chrono>
#include <cmath>
#include <filesystem>

#include "capture/trees/sample_trees.h"
#include "capture/trees/shown_tree.h"
#include "capture/trees/tree_file.h"

namespace parvis::trees {
namespace {

constexpr std::size_t timed_threads = 2;  // the minutes are those of two cores

/// Seconds since the last call, or since it was made.
class Clock {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - start_).count();
    start_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

BenchCaptureSize bench_capture_size(const FigureOptions& options) {
  BenchCaptureSize size;
  if (!options.is_quick) return size;
  size.capture.width = size.capture.height = 200;
  size.options.grid.level = 3;
  size.held_out = 6;
  return size;
}

Result<SampleCapture> sample_capture(std::string_view name, int views, const BenchCaptureSize& size) {
  Result<scene::Model> model = make_sample_tree(name, 1);
  if (!model) return model.errors();
  const Bounds bounds = scene::bounds(*model);
  SampleCapture capture{*std::move(model), {}, {}, held_out_cameras(bounds, size.held_out, 5)};
  capture.held_out = photograph_tree(capture_scene(capture.model, {}), capture.held_out_cameras,
                                     std::string(name) + " held out", truth_options(size));
  return with_photographs(capture, views, size);
}

SampleCapture with_photographs(const SampleCapture& capture, int views, const BenchCaptureSize& size) {
  SampleCapture result = capture;
  result.views =
      photograph_tree(capture_scene(capture.model, {}), capture_cameras(scene::bounds(capture.model), views),
                      capture.model.name, size.capture);
  return result;
}

CaptureOptions truth_options(const BenchCaptureSize& size) {
  CaptureOptions options = size.capture;
  options.samples_per_pixel = size.truth_samples_per_pixel, options.seed += 76;
  return options;
}

Result<ReconstructedTree> reconstructed_tree(const SampleCapture& capture, const BenchCaptureSize& size) {
  const tbb::global_control two_cores(tbb::global_control::max_allowed_parallelism, timed_threads);
  Clock whole, clock;
  Result<Reconstruction> found = reconstruct(capture.views, size.options);
  if (!found) return found.errors();
  ReconstructedTree made;
  made.volume = std::move(found->volume), made.times = std::move(found->times);
  made.notes = std::move(found->notes);
  clock.lap();
  const BillboardTree tree = textured(made.volume, capture.views, {});
  made.times.push_back({"textures", clock.lap()});
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() /
      fmt::format("parvis_bench_{}.tree", std::chrono::steady_clock::now().time_since_epoch().count());
  const Result<std::size_t> bytes = write_tree(file, tree);
  if (!bytes) return bytes.errors();
  made.times.push_back({"file", clock.lap()});
  Result<BillboardTree> read = read_tree(file);
  std::error_code code;
  std::filesystem::remove(file, code);
  if (!read) return read.errors();
  made.levels = std::make_shared<const TreeLevels>(levels_of(*std::move(read)));
  made.times.push_back({"levels", clock.lap()});
  made.seconds = whole.lap();
  made.megabytes = double(*bytes) * 1e-6;
  return made;
}

std::shared_ptr<const TreeLevels> levels_from(const TreeVolume& volume, std::span<const TreeView> views,
                                              TextureMethod method) {
  TextureOptions options;
  options.method = method;
  return std::make_shared<const TreeLevels>(levels_of(as_stored(textured(volume, views, options))));
}

namespace {

/// Of what is shown, as a camera of this exposure sees it.
Result<ViewErrors> errors_of_shown(Result<ShownTree> shown, float exposure, std::span<const TreeView> views) {
  if (views.empty()) return error("there are no views to compare with");
  if (!shown) return shown.errors();
  ViewErrors mean;
  double squares = 0.0;
  for (const TreeView& view : views) {
    Result<ImageF> picture = shown->picture(view.camera);
    if (!picture) return picture.errors();
    for (std::size_t i = 0; i < picture->pixels.size(); ++i)
      if (i % 4 != 3) picture->pixels[i] *= exposure;
    const Result<ViewErrors> one = judged(*picture, view);
    if (!one) return one.errors();
    mean += *one, squares += one->alpha_rmse * one->alpha_rmse;
  }
  mean /= double(views.size());
  mean.alpha_rmse = std::sqrt(squares / double(views.size()));
  return mean;
}

}  // namespace

Result<ViewErrors> errors_of(const std::shared_ptr<const TreeLevels>& tree, const scene::Scene& light,
                             std::span<const TreeView> views) {
  return errors_of_shown(ShownTree::create(tree, light), 1.0f, views);  // its textures are as exposed
}

Result<ViewErrors> errors_of_mesh(const scene::Model& model, std::span<const TreeView> views) {
  return errors_of_shown(ShownTree::of_scene(capture_scene(model, {})), capture_exposure, views);
}

Result<ViewErrors> errors_of(const std::shared_ptr<const TreeLevels>& tree, std::span<const TreeView> views) {
  return errors_of(tree, scene_in_light_of(tree->levels.front().light), views);
}

}  // namespace parvis::trees
