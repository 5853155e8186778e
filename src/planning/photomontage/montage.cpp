#include "planning/photomontage/montage.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/colour.h"
#include "base/known_names.h"
#include "base/median.h"
#include "base/parallel.h"
#include "graphics/reference/camera_ray.h"
#include "planning/design/design_nodes.h"
#include "planning/photomontage/lens_view.h"

namespace parvis::photomontage {
namespace {

constexpr float max_ratio = 4.0f;         ///< of light with the design over light without
constexpr float seen_change = 0.01f;      ///< of that ratio
constexpr float darkest = 1e-4f;          ///< radiance times brightness below which a ratio means nothing
constexpr float nearer_by = 1.0f / 1024;  ///< fraction of a distance that separates two surfaces

/// The scene as it is traced at one time, from the photograph's place.
struct Traced {
  ImageF radiance;    ///< linear
  ImageF distance_m;  ///< through the pixels' centres; infinite: the sky
};

Traced trace(stage::Stage& stage, const LensView& view) {
  Traced traced{stage.trace(view.camera, view.width, view.height, 1).radiance,
                ImageF(view.width, view.height, 1, INFINITY)};
  const reference::RayScene rays(stage.scene());
  const reference::CameraRays through(view.camera, view.width, view.height);
  parallel_for(std::size_t(view.height), [&](std::size_t y) {
    for (int x = 0; x < view.width; ++x)
      if (const auto hit = rays.nearest_hit(through.through({float(x) + 0.5f, float(y) + 0.5f})))
        *traced.distance_m.at(x, int(y)) = hit->distance_m;
  });
  return traced;
}

/// How the pieces of a photograph's pixel (oversampling squared) lie in the drawn picture.
struct Pieces {
  LensView view;
  int side = 1;

  /// Calls `piece(x, y)` with the drawn pixel of each piece that the lens sees.
  template <class Piece>
  void each(const photographs::Lens& lens, int x, int y, Piece&& piece) const {
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i) {
        const auto at = view.drawn_pixel(lens, {x + (i + 0.5) / side, y + (j + 0.5) / side});
        if (!at) continue;
        piece(std::clamp(int(at->x), 0, view.width - 1), std::clamp(int(at->y), 0, view.height - 1));
      }
  }
};

/// Three pieces across a pixel, and fewer in large photographs, whose pixels are small.
int pieces_across(const photographs::Lens& lens) {
  const double pixels = double(lens.width) * lens.height;
  return pixels <= 5e6 ? 3 : pixels <= 14e6 ? 2 : 1;
}

glm::vec3 colour_at(const ImageF& image, int x, int y) {
  const float* at = image.at(x, y);
  return {at[0], at[1], at[2]};
}

/// The photograph's brightness over the scene's: the median over what both show, without the design's place.
Result<double> brightness_of(const MontageJob& job, const ImageF& photograph, const Pieces& pieces,
                             const Traced& with, const Traced& without) {
  if (job.brightness) return *job.brightness;
  std::vector<double> logarithms;
  const int step = std::max(1, job.picture.width / 256);
  for (int y = step / 2; y < job.picture.height; y += step)
    for (int x = step / 2; x < job.picture.width; x += step) {
      const float shown = luminance(colour_at(photograph, x, y));
      pieces.each(job.photograph.lens, x, y, [&](int u, int v) {
        const float traced = luminance(colour_at(without.radiance, u, v));
        if (std::isinf(*without.distance_m.at(u, v)) ||
            *with.distance_m.at(u, v) != *without.distance_m.at(u, v))
          return;
        if (shown > 0.002f && shown < 0.95f && traced > 0.0f)
          logarithms.push_back(std::log(double(shown)) - std::log(double(traced)));
      });
    }
  if (logarithms.empty())
    return error(
        "the photograph shows nothing of the scene, so that its brightness is not known; give --brightness, "
        "or a scene with the ground and walls that stand in the photograph");
  return std::exp(median(std::move(logarithms)));
}

/// Colour of the photograph's light, of luminance 1: the mean about the grey pixel.
Result<glm::vec3> light_colour(const MontageJob& job, const ImageF& photograph) {
  if (!job.grey) return glm::vec3(1.0f);
  if (job.grey->x < 0 || job.grey->y < 0 || job.grey->x >= photograph.width ||
      job.grey->y >= photograph.height)
    return error("the grey pixel {},{} lies outside of the photograph, which has {} x {}", job.grey->x,
                 job.grey->y, photograph.width, photograph.height);
  constexpr int reach = 2;
  glm::vec3 sum(0.0f);
  for (int y = std::max(job.grey->y - reach, 0); y <= std::min(job.grey->y + reach, photograph.height - 1);
       ++y)
    for (int x = std::max(job.grey->x - reach, 0); x <= std::min(job.grey->x + reach, photograph.width - 1);
         ++x)
      sum += colour_at(photograph, x, y);
  if (luminance(sum) <= 0.0f)
    return error("the grey pixel {},{} is black; choose one that is lit", job.grey->x, job.grey->y);
  return sum / luminance(sum);
}

/// Sums of a pixel's pieces.
struct Pixel {
  glm::vec3 light{0.0f};
  int pieces = 0, covered = 0, shaded = 0;
};

Pixel composed(const MontageJob& job, const Pieces& pieces, glm::vec3 photograph, glm::vec3 brightness,
               const Traced& with, const Traced& without, int x, int y) {
  Pixel pixel;
  pieces.each(job.photograph.lens, x, y, [&](int u, int v) {
    const glm::vec3 lit = brightness * colour_at(with.radiance, u, v),
                    before = brightness * colour_at(without.radiance, u, v);
    ++pixel.pieces;
    if (*with.distance_m.at(u, v) < *without.distance_m.at(u, v) * (1.0f - nearer_by)) {
      pixel.light += lit;
      ++pixel.covered;
      return;
    }
    const glm::vec3 ratio = glm::min((lit + darkest) / (before + darkest), glm::vec3(max_ratio));
    const bool is_changed = glm::length(ratio - 1.0f) > seen_change;
    pixel.shaded += is_changed;
    pixel.light += is_changed ? photograph * ratio : photograph;
  });
  return pixel;
}

Status show(stage::Stage& stage, const std::string& design, bool is_shown) {
  std::vector<std::string> names;
  stage::Simulation& simulation = stage.simulation();
  for (const scene::Node* node : design::designs_of(simulation.live())) {
    names.push_back(node->text("name"));
    if (names.back() != design) continue;
    simulation.live().set(*node, "visible", is_shown);
    if (Errors errors = simulation.live().refresh(simulation.scene); !errors.empty()) return errors;
    simulation.clock.follow(simulation.scene);
    simulation.settle();
    return Ok{};
  }
  return error("the scene has no design \"{}\"{}", design.substr(0, 40), names_that_exist(design, names));
}

}  // namespace

Result<Montage> make_montage(stage::Stage& stage, const MontageJob& job) {
  const photographs::Lens& lens = job.photograph.lens;
  const int side = pieces_across(lens);
  const Result<LensView> view = view_of(job.photograph, side);
  if (!view) return view.errors();
  const Pieces pieces{*view, side};
  if (Status status = show(stage, job.design, false); !status) return status.errors();
  const Traced without = trace(stage, *view);
  if (Status status = show(stage, job.design, true); !status) return status.errors();
  const Traced with = trace(stage, *view);

  const ImageF photograph = linear_from_srgb8(job.picture);
  const Result<double> brightness = brightness_of(job, photograph, pieces, with, without);
  if (!brightness) return brightness.errors();
  const Result<glm::vec3> colour = light_colour(job, photograph);
  if (!colour) return colour.errors();
  const glm::vec3 scaled = float(*brightness) * *colour;
  Montage montage{Image8(lens.width, lens.height, 3), *brightness};
  std::vector<glm::dvec2> rows(std::size_t(lens.height), glm::dvec2(0.0));  // covered, shaded
  parallel_for(std::size_t(lens.height), [&](std::size_t row) {
    const int y = int(row);
    for (int x = 0; x < lens.width; ++x) {
      const std::uint8_t* shown = job.picture.at(x, y);
      std::uint8_t* out = montage.picture.at(x, y);
      std::copy_n(shown, 3, out);
      const Pixel pixel = composed(job, pieces, colour_at(photograph, x, y), scaled, with, without, x, y);
      if (pixel.covered + pixel.shaded == 0) continue;
      rows[row] += glm::dvec2(pixel.covered, pixel.shaded) / double(pixel.pieces);
      const float hidden = job.in_front.empty() ? 0.0f : float(*job.in_front.at(x, y)) / 255.0f;
      const glm::vec3 light =
          glm::mix(pixel.light / float(pixel.pieces), colour_at(photograph, x, y), hidden);
      for (int c = 0; c < 3; ++c)
        out[c] = std::uint8_t(std::lround(255.0f * srgb_from_linear(std::clamp(light[c], 0.0f, 1.0f))));
    }
  });
  for (const glm::dvec2& each : rows) {
    montage.covered += each.x / (double(lens.width) * lens.height);
    montage.shaded += each.y / (double(lens.width) * lens.height);
  }
  if (montage.covered == 0.0)
    return error(
        "the photograph's camera sees nothing of the design \"{}\": is it the camera of this photograph, in "
        "the "
        "scene's coordinates?",
        job.design);
  return montage;
}

}  // namespace parvis::photomontage
