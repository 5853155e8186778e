#include "stage/refinement.h"

#include "graphics/shading/tone_curve.h"

namespace parvis::stage {
namespace {

constexpr int samples_per_round = 16;  // spread evenly over each pixel, as those of a reference picture

}  // namespace

Refinement::Refinement(KeptRays& rays, const scene::Scene& scene, const shading::SkyLight& sky,
                       shading::DrawnLight light, const Camera& camera, int width, int height, int bounces)
    : rays_(rays),
      scene_(scene),
      sky_(sky),
      light_(std::move(light)),
      camera_(camera),
      width_(width),
      height_(height),
      bounces_(bounces),
      sum_(width, height, 3),
      weights_(width, height, 1),
      thread_([this] { run(); }) {}

Refinement::~Refinement() {
  is_interrupted_ = true;
  thread_.join();
}

void Refinement::run() {
  using namespace std::chrono_literals;
  std::optional<KeptRays::Moment> moment;
  while (!moment) {
    if (is_interrupted_) return;
    moment = rays_.of(scene_, 10ms);
  }
  reference::TraceOptions options;
  options.samples_per_pixel = samples_per_round;
  options.drawn_light = &light_;
  options.mirror_bounces = bounces_;
  options.is_interrupted = &is_interrupted_;
  options.progress.clear();
  for (int sample = 0; sample < max_samples; ++sample) {
    options.seed = 1 + std::uint64_t(sample / samples_per_round);
    options.only_sample = sample % samples_per_round;
    const reference::TracedPicture traced =
        reference::trace_picture(*moment->rays, *moment->scene, sky_, camera_, width_, height_, options);
    if (is_interrupted_) return;
    add(traced.radiance);
  }
}

/// Weighted as the samples of a reference picture are, so that the mean becomes the same.
void Refinement::add(const ImageF& sample) {
  const std::scoped_lock lock(mutex_);
  for (std::size_t i = 0; i < weights_.pixels.size(); ++i) {
    const glm::vec3 radiance(sample.pixels[3 * i], sample.pixels[3 * i + 1], sample.pixels[3 * i + 2]);
    const float weight = shading::sample_weight(scene_.exposure * radiance);
    for (std::size_t c = 0; c < 3; ++c) sum_.pixels[3 * i + c] += weight * radiance[int(c)];
    weights_.pixels[i] += weight;
  }
  ++samples_;
  is_new_ = true;
}

std::optional<ImageF> Refinement::take() {
  const std::scoped_lock lock(mutex_);
  if (!is_new_) return std::nullopt;
  is_new_ = false;
  ImageF mean = sum_;
  for (std::size_t i = 0; i < weights_.pixels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) mean.pixels[3 * i + c] /= weights_.pixels[i];
  return mean;
}

}  // namespace parvis::stage
