#include "bench/trees/reconstructed_tree.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include "capture/trees/sample_trees.h"
#include "capture/trees/shown_tree.h"
#include "capture/trees/tree_file.h"

namespace parvis::bench {

void Means::report() const {
  for (const Entry& entry : entries_) {
    const double mean = entry.sum / entry.count;
    if (!std::isfinite(mean)) fail("{}: the figure is {}, no number", entry.key, mean);
    report_.add(entry.key, mean);
  }
}

void Means::add(const std::string& key, double value) {
  report_.note(fmt::format("{}: {} {:.4g}", tree_, key, value));
  auto entry = std::ranges::find(entries_, key, &Entry::key);
  if (entry == entries_.end()) entry = entries_.insert(entries_.end(), {key, 0.0, 0.0});
  entry->sum += value, entry->count += 1.0;
}

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

BenchCaptureSize bench_capture_size(const BenchSetup& setup) {
  BenchCaptureSize size;
  if (!setup.is_quick) return size;
  size.capture.width = size.capture.height = 200;
  size.options.grid.level = 3;
  size.held_out = 6;
  return size;
}

SampleCapture sample_capture(std::string_view name, int views, const BenchCaptureSize& size) {
  scene::Model model = must(make_sample_tree(name, 1));
  const Bounds bounds = scene::bounds(model);
  SampleCapture capture{std::move(model), {}, {}, held_out_cameras(bounds, size.held_out, 5)};
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

ReconstructedTree reconstructed_tree(const SampleCapture& capture, const BenchCaptureSize& size) {
  const tbb::global_control two_cores(tbb::global_control::max_allowed_parallelism, timed_threads);
  Clock whole, clock;
  Reconstruction found = must(reconstruct(capture.views, size.options));
  ReconstructedTree made;
  made.volume = std::move(found.volume), made.times = std::move(found.times);
  made.notes = std::move(found.notes);
  clock.lap();
  const BillboardTree tree = textured(made.volume, capture.views, {});
  made.times.push_back({"textures", clock.lap()});
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() /
      fmt::format("parvis_bench_{}.tree", std::chrono::steady_clock::now().time_since_epoch().count());
  const std::size_t bytes = must(write_tree(file, tree));
  made.times.push_back({"file", clock.lap()});
  BillboardTree read = must(read_tree(file));
  std::error_code code;
  std::filesystem::remove(file, code);
  made.levels = std::make_shared<const TreeLevels>(levels_of(std::move(read)));
  made.times.push_back({"levels", clock.lap()});
  made.seconds = whole.lap();
  made.megabytes = double(bytes) * 1e-6;
  return made;
}

std::shared_ptr<const TreeLevels> levels_from(const TreeVolume& volume, std::span<const TreeView> views,
                                              TextureMethod method) {
  TextureOptions options;
  options.method = method;
  return std::make_shared<const TreeLevels>(levels_of(as_stored(textured(volume, views, options))));
}

namespace {

/// Errors of the shown tree as a camera of this exposure sees it.
ViewErrors errors_of_shown(ShownTree shown, float exposure, std::span<const TreeView> views) {
  if (views.empty()) fail("there are no views to compare with");
  ViewErrors mean;
  double squares = 0.0;
  for (const TreeView& view : views) {
    ImageF picture = must(shown.picture(view.camera));
    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
      if (i % 4 != 3) picture.pixels[i] *= exposure;
    const ViewErrors one = must(judged(picture, view));
    mean += one, squares += one.alpha_rmse * one.alpha_rmse;
  }
  mean /= double(views.size());
  mean.alpha_rmse = std::sqrt(squares / double(views.size()));
  return mean;
}

}  // namespace

ViewErrors errors_of(const std::shared_ptr<const TreeLevels>& tree, const scene::Scene& light,
                     std::span<const TreeView> views) {
  return errors_of_shown(must(ShownTree::create(tree, light)), 1.0f, views);  // its textures are as exposed
}

ViewErrors errors_of(const std::shared_ptr<const TreeLevels>& tree, std::span<const TreeView> views) {
  return errors_of(tree, scene_in_light_of(tree->levels.front().light), views);
}

}  // namespace parvis::bench
