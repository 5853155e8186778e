// A bench: parts that measure, and what they measure with. A part throws Failed where it cannot measure; the
// program reports that and goes on with the next part.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/image.h"
#include "bench/report.h"
#include "rooms/rooms.h"
#include "stage/stage.h"

namespace parvis::bench {

/// Something that must be known for a figure is not.
struct Failed {
  Errors errors;
};

/// Throws Failed with a formatted message.
template <class... Args>
[[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) {
  throw Failed{{error(format, std::forward<Args>(args)...)}};
}

/// The value of a result; throws Failed with its errors.
template <class T>
T must(Result<T> result) {
  if (!result) throw Failed{result.errors()};
  return *std::move(result);
}
inline void must(const Status& status) {
  if (!status) throw Failed{status.errors()};
}

/// Data shared by the parts of a bench while they run.
struct BenchSetup {
  bool is_quick = false;         ///< fewer repetitions and views, every key all the same
  std::filesystem::path folder;  ///< for files; the program removes it unless `--keep` names it

  /// The folder of the paper's city, which is written when first asked for.
  std::filesystem::path city() const;
  /// The scene of a script, without its processes.
  scene::Scene scene(const std::filesystem::path& script,
                     std::span<const std::filesystem::path> data_folders = {}) const;
  /// The same with its processes, running.
  stage::Simulation simulation(const std::filesystem::path& script,
                               std::span<const std::filesystem::path> data_folders = {}) const;
};

/// A renderer of a running scene.
std::unique_ptr<stage::Stage> stage_of(stage::Simulation simulation);
/// The same of a scene that has no script.
std::unique_ptr<stage::Stage> stage_of(const scene::Scene& scene);
/// A renderer of a scene as it is, with the drawables and the light of all rooms.
std::unique_ptr<render::Renderer> renderer_of(const scene::Scene& scene);

/// FLIP of two pictures, over the pixels of a mask (empty: all).
double flip_between(const Image8& picture, const Image8& expected, const Image8& mask = {});

/// One part of a bench.
struct Part {
  const char* bench;    ///< the bench that it belongs to
  const char* name;     ///< snake_case
  const char* summary;  ///< one clause for --list: what is measured
  std::function<void(const BenchSetup&, Report&)> measure;
  bool needs_gl = true;     ///< a current OpenGL context
  bool when_named = false;  ///< it is contained in another part, and run only when it is named
};

/// Every part, in the order of --list: parts.cpp.
std::span<const Part> all_parts();

/// The parts that a name stands for: all of a bench, or one as PART, BENCH_PART or BENCH/PART. Empty: none.
std::vector<const Part*> parts_named(const std::string& name);

/// Runs parts one after another, whatever has become of those before, and checks the controls. Fails with the
/// errors of all.
Status run_parts(const BenchSetup& setup, std::span<const Part* const> parts, Report& report);

}  // namespace parvis::bench
