#include "capture/trees/kept_reconstruction.h"

#include <algorithm>
#include <cmath>

#include "base/content_hash.h"
#include "base/sealed_file.h"
#include "capture/trees/tree_file.h"

namespace parvis::trees {
namespace {

constexpr int reconstruction_version =
    2;  // to be raised whenever the same photographs and options give other cells

void add_named(ContentHash& hash, const TreeView& view) {
  hash.add_text(view.name), hash.add(view.camera);
  hash.add(view.picture.channels), hash.add(view.picture.pixels);
}

bool are_finite(const std::vector<double>& values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

}  // namespace

KeptSteps KeptSteps::of(std::span<const TreeView> views, const ReconstructionOptions& options) {
  ContentHash hash;
  hash.add(reconstruction_version);
  for (const TreeView& view : views) add_named(hash, view);
  hash.add(options.keeps_inconsistent);
  hash.add(options.grid.branching), hash.add(options.grid.level);
  hash.add(options.opacity.method), hash.add(options.opacity.clamps);
  hash.add(options.opacity.picture_factor), hash.add(options.opacity.iterations);
  KeptSteps steps;
  // Each step depends on those before it.
  const auto step = [&](const char* name) { return KeptStep{name, hash.value()}; };
  steps.cutoff = step("cutoff");
  hash.add(options.opacity.cutoff.value_or(-1.0f));
  steps.opacity = step("opacity");
  hash.add(options.coarse_epochs);
  steps.colours = step("colours");
  hash.add(options.cutoff.value_or(-1.0f));
  hash.add(options.fine_epochs), hash.add(options.fine_smoothing);
  steps.finer = step("finer");
  return steps;
}

std::string bytes_of(const Opacities& opacities) {
  std::string bytes;
  append_values(bytes, opacities.extinction_per_m), append_values(bytes, opacities.mean_change);
  append_value(bytes, std::int32_t(opacities.picture_factor));
  return bytes;
}

std::optional<Opacities> opacities_of(std::string_view bytes) {
  ByteReader reader(bytes);
  Opacities opacities;
  opacities.extinction_per_m = reader.take_values<float>();
  opacities.mean_change = reader.take_values<double>();
  opacities.picture_factor = reader.take<std::int32_t>();
  const bool is_whole =
      reader.is_at_end() && opacities.picture_factor > 0 &&
      std::ranges::all_of(opacities.extinction_per_m, [](float tau) { return std::isfinite(tau); }) &&
      are_finite(opacities.mean_change);
  if (!is_whole) return std::nullopt;
  return opacities;
}

std::string bytes_of(const TreeVolume& volume, const FitState& state) {
  std::string bytes;
  append_volume(bytes, volume);
  append_value(bytes, std::uint64_t(state.steps)), append_values(bytes, state.errors);
  append_value(bytes, state.error_sum), append_value(bytes, state.value_sum);
  append_values(bytes, state.mean), append_values(bytes, state.mean_square);
  append_values(bytes, state.cell_steps);
  return bytes;
}

std::optional<FittedVolume> fitted_volume_of(std::string_view bytes) {
  ByteReader reader(bytes);
  Result<TreeVolume> volume = take_volume(reader, "");
  if (!volume) return std::nullopt;
  FittedVolume fitted{*std::move(volume), {}};
  FitState& state = fitted.state;
  state.steps = std::size_t(reader.take<std::uint64_t>()), state.errors = reader.take_values<double>();
  state.error_sum = reader.take<double>(), state.value_sum = reader.take<double>();
  state.mean = reader.take_values<glm::vec4>(), state.mean_square = reader.take_values<glm::vec4>();
  state.cell_steps = reader.take_values<std::uint16_t>();
  const std::size_t cells = fitted.volume.grid.size();
  const bool is_whole = reader.is_at_end() && state.mean.size() == cells &&
                        state.mean_square.size() == cells && state.cell_steps.size() == cells &&
                        are_finite(state.errors);
  if (!is_whole) return std::nullopt;
  return fitted;
}

StepKeeper::StepKeeper(const ReconstructionOptions& options)
    : options_(options),
      checkpoint_(options.processes.is_first() ? options.checkpoint : std::filesystem::path()),
      last_(std::chrono::steady_clock::now()) {}

std::string StepKeeper::find(const KeptStep& step) const {
  if (options_.checkpoint.empty()) return "";
  std::string bytes = checkpoint_.find(step.name, step.key).value_or("");
  options_.processes.share_of_first(bytes);
  return bytes;
}

Status StepKeeper::keep(const KeptStep& step, bool is_finished, const std::function<std::string()>& content) {
  if (options_.checkpoint.empty() && !options_.is_interrupted) return Ok{};
  const bool is_interrupted = options_.processes.any_of(options_.is_interrupted && *options_.is_interrupted);
  const auto now = std::chrono::steady_clock::now();
  Status kept = Ok{};
  if (checkpoint_.keeps_parts() &&
      (is_finished || is_interrupted || now - last_ >= options_.keeping_interval)) {
    kept = checkpoint_.keep(step.name, step.key, content());
    last_ = std::chrono::steady_clock::now();
  }
  if (options_.processes.any_of(!kept.ok()))
    return error("{}; what was kept before is in {}, and the same command goes on from there",
                 kept ? "the first process cannot keep its work" : to_string(kept.errors().front()),
                 options_.checkpoint.string());
  if (!is_interrupted) return Ok{};
  if (options_.checkpoint.empty()) return error("interrupted in the step {}", step.name);
  return error("interrupted in the step {}; what is done is kept in {}: the same command goes on from there",
               step.name, options_.checkpoint.string());
}

}  // namespace parvis::trees
