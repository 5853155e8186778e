// How true reflections are on cars that drive: the eye drives along, so that nothing but what a car mirrors
// changes.
#include <cstdlib>

#include "bench/parts.h"
#include "bench/reflections/comparison.h"
#include "graphics/shading/tone_curve.h"
#include "reflections/probes/methods.h"

namespace parvis::bench {
namespace {

constexpr double frame_s = 1.0 / 30.0;
constexpr int frames_before = 30;  // until maps that are taken face by face are as old as they ever are
constexpr int judged_frames = 4;
constexpr float min_way_m = 3.0f;  // in those: a car that waits mirrors the same
constexpr int samples_per_pixel = 16;
constexpr int max_attempts_per_drive = 8;

/// Means over all drives, of each method.
struct MotionErrors {
  std::vector<double> flip;  ///< in the last frame
  std::vector<double>
      difference;                ///< by how much frames differ otherwise than true ones do, of display white
  double true_difference = 0.0;  ///< by how much true frames differ
  int drives = 0;
};

/// An eye that keeps its place beside a car.
class Companion {
 public:
  Companion(const scene::Scene& scene, const NearView& view)
      : scene_(scene),
        camera_(view.camera),
        object_(std::size_t(view.object)),
        car_from_camera_(glm::inverse(car()) * view.camera.world_from_camera) {}

  const glm::mat4& car() const { return scene_.objects[object_].world_from_model; }
  Camera camera() const {
    Camera camera = camera_;
    camera.world_from_camera = car() * car_from_camera_;
    return camera;
  }

 private:
  const scene::Scene& scene_;
  Camera camera_;
  std::size_t object_;
  glm::mat4 car_from_camera_;
};

/// Pictures of a drive: one by each method and the true one, of each judged frame.
struct Drive {
  std::vector<Image8> truths, masks;
  std::vector<std::vector<Image8>> pictures;  ///< of each method
};

/// Nothing: the car waited, or something came between it and the eye.
std::optional<Drive> drive_with(stage::Stage& stage, const std::vector<JudgedMethod>& methods,
                                const NearView& view, glm::ivec2 size) {
  const Companion companion(stage.scene(), view);
  const glm::vec3 start(companion.car()[3]);
  for (int frame = 0; frame < frames_before; ++frame) {
    for (const JudgedMethod& method : methods)
      if (method.shows_earlier_frames) pass_by(stage, method, companion.camera(), size);
    stage.simulation().advance(frame_s);
  }
  if (glm::distance(start, glm::vec3(companion.car()[3])) < min_way_m) return {};
  stage.renderer().begin_frame(stage.scene(), companion.camera());
  const auto window = window_of_car(stage, companion.camera(), view.object, size);
  if (!window) return {};
  Drive drive;
  drive.pictures.resize(methods.size());
  for (int frame = 0; frame < judged_frames; ++frame) {
    const Camera camera = companion.camera();
    const reference::TracedPicture truth = stage.trace(camera, size.x, size.y, samples_per_pixel, *window);
    drive.truths.push_back(shading::tone_mapped_picture(truth.radiance, stage.scene().exposure));
    drive.masks.push_back(truth.mirror_mask);
    for (std::size_t m = 0; m < methods.size(); ++m)
      drive.pictures[m].push_back(picture_of(stage, methods[m], camera, size, *window));
    stage.simulation().advance(frame_s);
  }
  return drive;
}

/// Mean over reflective pixels and colours of what one pair of pictures differs otherwise than another.
double difference_of_differences(const Image8& before, const Image8& after, const Image8& true_before,
                                 const Image8& true_after, const Image8& mask) {
  double sum = 0.0;
  std::size_t count = 0;
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x) {
      if (*mask.at(x, y) < 128) continue;
      for (int c = 0; c < 3; ++c)
        sum += std::abs((after.at(x, y)[c] - before.at(x, y)[c]) -
                        (true_after.at(x, y)[c] - true_before.at(x, y)[c]));
      count += 3;
    }
  return count > 0 ? sum / 255.0 / double(count) : 0.0;
}

/// Adds a drive to the sums.
void judge(const Drive& drive, MotionErrors& sums) {
  const Image8 still(drive.truths[0].width, drive.truths[0].height, drive.truths[0].channels);
  for (std::size_t m = 0; m < drive.pictures.size(); ++m)
    sums.flip[m] += flip_between(drive.pictures[m].back(), drive.truths.back(), drive.masks.back());
  constexpr double pairs = judged_frames - 1;
  for (std::size_t frame = 1; frame < judged_frames; ++frame) {
    const Image8 &before = drive.truths[frame - 1], &after = drive.truths[frame], &mask = drive.masks[frame];
    sums.true_difference += difference_of_differences(still, still, before, after, mask) / pairs;
    for (std::size_t m = 0; m < drive.pictures.size(); ++m)
      sums.difference[m] += difference_of_differences(drive.pictures[m][frame - 1], drive.pictures[m][frame],
                                                      before, after, mask) /
                            pairs;
  }
  ++sums.drives;
}

MotionErrors errors_in_motion(stage::Stage& stage, const std::vector<JudgedMethod>& methods, int drives,
                              glm::ivec2 size) {
  MotionErrors errors;
  errors.flip.resize(methods.size());
  errors.difference.resize(methods.size());
  NearViews near_views(stage, size);
  for (int attempt = 0; attempt < max_attempts_per_drive * drives && errors.drives < drives; ++attempt)
    if (const auto drive = drive_with(stage, methods, near_views.next(), size)) judge(*drive, errors);
  if (errors.drives == 0) fail("no car drove on for a second in sight of an eye beside it");
  const double count = errors.drives;
  for (double& flip : errors.flip) flip /= count;
  for (double& difference : errors.difference) difference /= count;
  errors.true_difference /= count;
  return errors;
}

/// Faces of cube maps that could be drawn in the time that the shipped method takes in near views; one at
/// least.
int faces_for_the_same_time(stage::Stage& stage, int repeats, Report& report) {
  const Compared near = compared(stage, {.methods = {{"none", usual("none")},
                                                     {"mem", shipped_maps()},
                                                     {"rerendered", usual("rerendered_cube_map")}},
                                         .views = 3,
                                         .size = {0, 0},
                                         .repeats = repeats});
  std::vector<double> face_ms;
  for (std::size_t v = 0; v < near.seen.size(); ++v)
    face_ms.push_back(near.method("rerendered").ms[v] / (6.0 * near.seen[v]));
  const double mem_ms = median(near.method("mem").ms).value;
  const int faces = std::max(int(std::lround(mem_ms / median(face_ms).value)), 1);
  report.note(
      fmt::format("near views: mem {:.2f} ms, a re-rendered face {:.2f} ms: {} time-sliced faces per frame",
                  mem_ms, median(face_ms).value, faces));
  return faces;
}

}  // namespace

void measure_motion(stage::Stage& stage, const BenchSetup& setup, Report& report) {
  methods::Settings sliced = usual("time_sliced_cube_map");
  sliced.own.get<probes::TimeSlicing>().faces_per_frame =
      faces_for_the_same_time(stage, setup.is_quick ? 3 : 10, report);
  const auto methods = judged_methods(
      stage,
      {{"mem", shipped_maps()}, {"rerendered", usual("rerendered_cube_map")}, {"time_sliced", sliced}});
  const MotionErrors errors = errors_in_motion(stage, methods, setup.is_quick ? 2 : 20,
                                               setup.is_quick ? full_picture / 2 : full_picture);
  report.note(fmt::format("{} drives beside cars: true frames differ by {:.4f} inside reflections",
                          errors.drives, errors.true_difference));
  for (std::size_t m = 0; m < methods.size(); ++m)
    report.note(fmt::format("driving, {}: FLIP {:.4f}, error of frame differences {:.4f}", methods[m].name,
                            errors.flip[m], errors.difference[m]));
  report.add("flip_ratio_mem_over_time_sliced", errors.flip[0] / errors.flip[2]);
  report.add("motion_error_ratio_mem_over_rerendered", errors.difference[0] / errors.difference[1]);
}

}  // namespace parvis::bench
