#include "bench/readers/photo_bench.h"

#include "bench/scratch_folder.h"
#include "graphics/reference/photograph.h"
#include "house/stage/stage.h"
#include "places/paper_city/paper_city.h"

namespace parvis::bench {
namespace {

constexpr int width = 1280, height = 960, samples = 64, quick_samples = 4;
constexpr const char* camera_name = "crossing";

}  // namespace

Status measure_photographs(const BenchSetup& setup, Report& report) {
  const ScratchFolder folder;
  if (Status status = city::write_paper_city(folder.path, 1); !status) return status;
  Result<house::Play> play = house::open_play(setup.house, folder.path / "paper.xp", {});
  if (!play) return play.errors();
  play->advance(8.0);  // so that cars have reached the crossing
  const Result<Camera> camera = play->camera(camera_name);
  if (!camera) return camera.errors();
  const scene::Scene& scene = play->scene;
  const reference::RayScene rays(scene);
  const shading::SkyLight sky =
      shading::make_sky_light(scene.sky.picture, scene.sky.intensity, scene.sky.heading);
  reference::PhotographOptions options;
  options.samples_per_pixel = setup.is_quick ? quick_samples : samples;
  const Result<reference::Photograph> photograph =
      reference::take_photograph(rays, scene, sky, *camera, width, height, options);
  if (!photograph) return photograph.errors();
  report.add("path_traced_mrays_s", 1e-6 * double(photograph->rays) / photograph->seconds);
  report.add("photo_s_1280x960_64spp", photograph->seconds * samples / options.samples_per_pixel);
  report.note(
      fmt::format("the paper's city, camera \"{}\", {} triangles, {} samples per pixel, {:.1f} rays a path",
                  camera_name, rays.triangle_count(), options.samples_per_pixel,
                  double(photograph->rays) / (double(width) * height * options.samples_per_pixel)));
  return Done{};
}

}  // namespace parvis::bench
