#include "bench/environment_rays/motion_error.h"

#include <cstdlib>

#include "bench/environment_rays/near_views.h"
#include "graphics/reference/metrics.h"
#include "graphics/shading/tone_curve.h"

namespace parvis::bench {
namespace {

constexpr double frame_s = 1.0 / 30.0;
constexpr int frames_before = 30;  // until maps that are taken face by face are as old as they ever are
constexpr int judged_frames = 4;
constexpr float min_way_m = 3.0f;  // in those: a car that waits mirrors the same
constexpr int samples_per_pixel = 16;
constexpr int max_attempts_per_drive = 8;

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

/// What a drive showed: a picture by each method and the true one, of each judged frame.
struct Drive {
  std::vector<Image8> truths, masks;
  std::vector<std::vector<Image8>> pictures;  ///< of each method
};

/// Nothing: the car waited, or something came between it and the eye.
Result<std::optional<Drive>> drive_with(house::Stage& stage, const std::vector<JudgedMethod>& methods,
                                        const NearView& view, int width, int height) {
  const Companion companion(stage.scene(), view);
  const glm::vec3 start(companion.car()[3]);
  for (int frame = 0; frame < frames_before; ++frame) {
    for (const JudgedMethod& method : methods) {
      if (!method.shows_earlier_frames) continue;
      if (Status status = pass_by(stage, method, companion.camera(), width, height); !status)
        return status.errors();
    }
    stage.play().advance(frame_s);
  }
  if (glm::distance(start, glm::vec3(companion.car()[3])) < min_way_m) return std::optional<Drive>();
  stage.renderer().begin_frame(stage.scene(), companion.camera());
  const auto window = window_of_car(stage, companion.camera(), view.object, width, height);
  if (!window) return std::optional<Drive>();

  Drive drive;
  drive.pictures.resize(methods.size());
  for (int frame = 0; frame < judged_frames; ++frame) {
    const Camera camera = companion.camera();
    const reference::TracedPicture truth = stage.trace(camera, width, height, samples_per_pixel, *window);
    drive.truths.push_back(shading::tone_mapped_picture(truth.radiance, stage.scene().exposure));
    drive.masks.push_back(truth.mirror_mask);
    for (std::size_t m = 0; m < methods.size(); ++m) {
      Result<Image8> picture = picture_of(stage, methods[m], camera, width, height, *window);
      if (!picture) return picture.errors();
      drive.pictures[m].push_back(*std::move(picture));
    }
    stage.play().advance(frame_s);
  }
  return std::optional(std::move(drive));
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
Status judge(const Drive& drive, MotionErrors& sums) {
  const Image8 still(drive.truths[0].width, drive.truths[0].height, drive.truths[0].channels);
  for (std::size_t m = 0; m < drive.pictures.size(); ++m) {
    const Result<reference::Difference> last =
        reference::compare(drive.pictures[m].back(), drive.truths.back(), drive.masks.back());
    if (!last) return last.errors();
    sums.flip[m] += last->flip;
  }
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
  return Done{};
}

}  // namespace

Result<MotionErrors> errors_in_motion(house::Stage& stage, const std::vector<JudgedMethod>& methods,
                                      int drives, int width, int height) {
  MotionErrors errors;
  errors.flip.resize(methods.size());
  errors.difference.resize(methods.size());
  NearViews near_views(stage, width, height);
  for (int attempt = 0; attempt < max_attempts_per_drive * drives && errors.drives < drives; ++attempt) {
    const Result<NearView> view = near_views.next();
    if (!view) return view.errors();
    const Result<std::optional<Drive>> drive = drive_with(stage, methods, *view, width, height);
    if (!drive) return drive.errors();
    const std::optional<Drive>& seen = *drive;
    if (!seen) continue;
    if (Status status = judge(*seen, errors); !status) return status.errors();
  }
  if (errors.drives == 0) return error("no car drove on for a second in sight of an eye beside it");
  const double count = errors.drives;
  for (double& flip : errors.flip) flip /= count;
  for (double& difference : errors.difference) difference /= count;
  errors.true_difference /= count;
  return errors;
}

}  // namespace parvis::bench
