#include "bench/virtual_objects/refraction.h"

#include <array>

#include "bench/scratch_folder.h"
#include "bench/virtual_objects/beside_rerendered.h"
#include "bench/virtual_objects/kitchen.h"
#include "graphics/gl/context.h"

namespace parvis::bench {
namespace {

constexpr std::array cameras{"ball", "egg", "both"};
constexpr std::size_t quick_cameras = 2;
constexpr double max_flip_ratio = 0.5;
constexpr int width = 960, height = 600, quick_width = 320, quick_height = 200;

}  // namespace

Status measure_refraction(const BenchSetup& setup, Report& report) {
  const Result<gl::Context> context = gl::Context::create_headless();
  if (!context) return context.errors();
  const ScratchFolder folder;
  Result<std::unique_ptr<house::Stage>> stage = open_kitchen(setup.house, folder.path, "glass.xp");
  if (!stage) return stage.errors();
  return measure_beside_rerendered(
      **stage, std::span(cameras).first(setup.is_quick ? quick_cameras : cameras.size()),
      setup.is_quick ? quick_width : width, setup.is_quick ? quick_height : height,
      "refraction_flip_over_rerendered", max_flip_ratio, report);
}

}  // namespace parvis::bench
