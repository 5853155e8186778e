// The hull of right cameras covers the silhouettes; of wrong ones it is too small, for each photograph carves
// away what others show (consistency of silhouettes, as Hernandez, Schmitt and Cipolla, Silhouette Coherence
// for Camera Calibration under Circular Motion, PAMI 2007). Searched along one unknown after the other, from
// coarse pictures and long steps to fine ones.
#include "capture/trees/turntable.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numeric>

#include "base/parallel.h"

namespace parvis::trees {
namespace {

constexpr std::array picture_sides{64, 128, 256};  // pixels, of the pictures that are compared
constexpr float min_alpha = 0.1f;                  // of a reduced pixel that shows the tree
constexpr int rounds_per_side = 3;
constexpr int max_steps = 12;   // along one unknown, per round
constexpr float margin = 1.1f;  // of the box that is searched

/// Silhouettes at one resolution.
struct Masks {
  int factor = 1;
  glm::ivec2 size{0};
  std::vector<std::vector<std::uint8_t>> shows;  // per photograph and pixel
  std::vector<double> counts;                    // per photograph: pixels that show the tree
};

Masks masks_of(std::span<const Image8> pictures, int side) {
  Masks masks;
  masks.factor = std::max(1, std::max(pictures[0].width, pictures[0].height) / side);
  for (const Image8& picture : pictures) {
    const ImageF alpha = reduced_alpha(picture, masks.factor);
    masks.size = {alpha.width, alpha.height};
    std::vector<std::uint8_t>& shows = masks.shows.emplace_back();
    for (const float a : alpha.pixels) shows.push_back(a >= min_alpha);
    masks.counts.push_back(double(std::accumulate(shows.begin(), shows.end(), 0)));
  }
  return masks;
}

/// Pixels of all silhouettes together: the plant's extents as it turns.
struct Extents {
  glm::vec2 low{1e9f}, high{-1e9f};
};

Extents extents_of(std::span<const Image8> pictures) {
  Extents extents;
  for (const Image8& picture : pictures)
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x)
        if (picture.at(x, y)[3] > 127) {
          extents.low = glm::min(extents.low, glm::vec2(float(x), float(y)));
          extents.high = glm::max(extents.high, glm::vec2(float(x), float(y)) + 1.0f);
        }
  return extents;
}

/// Mean over the photographs of the share of their silhouettes onto which a point falls that all show.
double explained_share(const Turntable& turntable, const Masks& masks, glm::ivec2 picture_size,
                       const Extents& extents) {
  std::vector<Pinhole> cameras = turntable_cameras(turntable, masks.shows.size(), picture_size);
  for (Pinhole& camera : cameras) camera = reduced(camera, masks.factor);
  const float metres_per_pixel = turntable.distance_m / turntable.focal_px,
              spacing_m = 0.7f * metres_per_pixel * float(masks.factor);
  const float middle = 0.5f * float(picture_size.x) + turntable.axis_px;
  const float radius_m =
      margin * metres_per_pixel * std::max(extents.high.x - middle, middle - extents.low.x);
  const float lean_m = radius_m * std::abs(std::sin(turntable.elevation));
  const float top_m = margin * metres_per_pixel * (0.5f * float(picture_size.y) - extents.low.y) + lean_m,
              foot_m = margin * metres_per_pixel * (0.5f * float(picture_size.y) - extents.high.y) - lean_m;
  const int side = int(2.0f * radius_m / spacing_m) + 1,
            layers = std::max(int((top_m - foot_m) / spacing_m) + 1, 1);

  const std::size_t pixels = masks.shows[0].size();
  std::vector<std::atomic<std::uint8_t>> covered(pixels * cameras.size());
  parallel_for(std::size_t(layers), [&](std::size_t layer) {
    std::vector<std::size_t> places(cameras.size());
    for (int i = 0; i < side * side; ++i) {
      const glm::vec3 point(-radius_m + spacing_m * float(i % side), -radius_m + spacing_m * float(i / side),
                            foot_m + spacing_m * float(layer));
      if (point.x * point.x + point.y * point.y > radius_m * radius_m) continue;
      bool is_shown = true;
      for (std::size_t k = 0; k < cameras.size() && is_shown; ++k) {
        const glm::vec3 seen = cameras[k].project(point);
        const glm::ivec2 at(glm::floor(glm::vec2(seen)));
        is_shown = seen.z > 0.0f && at.x >= 0 && at.y >= 0 && at.x < masks.size.x && at.y < masks.size.y;
        if (!is_shown) break;
        const std::size_t pixel = std::size_t(at.y) * std::size_t(masks.size.x) + std::size_t(at.x);
        is_shown = masks.shows[k][pixel];
        places[k] = k * pixels + pixel;
      }
      if (!is_shown) continue;
      for (const std::size_t place : places) covered[place].store(1, std::memory_order_relaxed);
    }
  });
  double sum = 0.0;
  for (std::size_t k = 0; k < cameras.size(); ++k) {
    double count = 0.0;
    for (std::size_t i = 0; i < pixels; ++i) count += covered[k * pixels + i].load(std::memory_order_relaxed);
    sum += count / masks.counts[k];
  }
  return sum / double(cameras.size());
}

/// An unknown and the first step of its search.
struct Unknown {
  float Turntable::*value;
  float step;
};

/// Walks along each unknown while that explains more.
FoundTurntable searched(FoundTurntable best, const Masks& masks, glm::ivec2 size, const Extents& extents,
                        std::vector<Unknown>& unknowns) {
  best.explained_share = explained_share(best.turntable, masks, size, extents);
  for (int round = 0; round < rounds_per_side; ++round) {
    for (const Unknown& unknown : unknowns)
      for (const float sign : {1.0f, -1.0f}) {
        bool is_better = false;
        for (int i = 0; i < max_steps; ++i) {
          FoundTurntable next = best;
          next.turntable.*unknown.value += sign * unknown.step;
          next.explained_share = explained_share(next.turntable, masks, size, extents);
          if (next.explained_share <= best.explained_share) break;
          best = next, is_better = true;
        }
        if (is_better) break;
      }
    for (Unknown& unknown : unknowns) unknown.step *= 0.5f;
  }
  return best;
}

Status problem_of(std::span<const Image8> pictures, const Turntable& start) {
  if (pictures.size() < 3)
    return error("{} photographs of the turntable: at least 3 are needed, 12 or more are recommended",
                 pictures.size());
  if (!(start.focal_px > 0.0f && start.distance_m > 0.0f && std::abs(start.step) > 0.0f))
    return error("a turntable needs a focal length, a distance and a step that are positive");
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    if (pictures[i].channels != 4 || pictures[i].width != pictures[0].width ||
        pictures[i].height != pictures[0].height)
      return error("photograph {} of the turntable: expected RGBA of {} x {} pixels as the first", i + 1,
                   pictures[0].width, pictures[0].height);
    bool is_seen = false;
    for (std::size_t k = 3; k < pictures[i].pixels.size() && !is_seen; k += 4)
      is_seen = pictures[i].pixels[k] > 127;
    if (!is_seen) return error("photograph {} of the turntable: its matte is empty, it shows no tree", i + 1);
  }
  return Done{};
}

}  // namespace

std::vector<Pinhole> turntable_cameras(const Turntable& turntable, std::size_t count, glm::ivec2 size) {
  std::vector<Pinhole> cameras;
  for (std::size_t i = 0; i < count; ++i) {
    // The plant turns counter-clockwise: in its frame the camera goes the other way round.
    const float angle = turntable.step * float(i), level = std::cos(turntable.elevation);
    const glm::vec3 out(-std::sin(angle) * level, -std::cos(angle) * level, std::sin(turntable.elevation));
    Pinhole camera;
    camera.width = size.x, camera.height = size.y, camera.focal = glm::vec2(turntable.focal_px);
    camera.principal_point = 0.5f * glm::vec2(size);
    const glm::mat3 upright(look_at(turntable.distance_m * out, glm::vec3(0.0f)));
    const float c = std::cos(turntable.roll), s = std::sin(turntable.roll);
    camera.world_from_camera = upright * glm::mat3(c, -s, 0.0f, s, c, 0.0f, 0.0f, 0.0f, 1.0f);
    camera.position_in_world =
        turntable.distance_m * (out - camera.world_from_camera[0] * (turntable.axis_px / turntable.focal_px));
    cameras.push_back(camera);
  }
  return cameras;
}

Result<FoundTurntable> found_turntable(std::span<const Image8> pictures, Turntable start) {
  if (Status problem = problem_of(pictures, start); !problem) return problem.errors();
  const glm::ivec2 size(pictures[0].width, pictures[0].height);
  const Extents extents = extents_of(pictures);
  // A whole turn is as wide to both sides of the axis.
  start.axis_px = 0.5f * (extents.low.x + extents.high.x) - 0.5f * float(size.x);
  FoundTurntable best;
  for (const float direction : {1.0f, -1.0f}) {
    FoundTurntable found{start, 0.0};
    found.turntable.step *= direction;
    std::vector<Unknown> unknowns{{&Turntable::axis_px, 0.03f * float(size.x)},
                                  {&Turntable::elevation, 0.06f},
                                  {&Turntable::roll, 0.02f}};
    for (const int side : picture_sides) {
      found = searched(found, masks_of(pictures, side), size, extents, unknowns);
      for (Unknown& unknown : unknowns) unknown.step *= 4.0f;  // half as long as at the resolution before
    }
    if (found.explained_share > best.explained_share) best = found;
  }
  return best;
}

}  // namespace parvis::trees
