#include "capture/facades/scan_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>

#include "base/progress.h"
#include "capture/facades/item_buffer.h"
#include "capture/facades/prepared_photo.h"

namespace parvis::facades {
namespace {

using photographs::Photograph;
using photographs::PhotographSet;

constexpr std::size_t max_probes = 8;  ///< photographs, spread over all, that are asked
constexpr int probe_width = 400;       ///< pixels: a point is in the right triangle or beside it
constexpr double same_depth = 0.03;    ///< of a point and of the scan behind its pixel, as a share
constexpr std::size_t min_scan_points = 50;
/// The fraction of points before or behind the scan that must lie on it: in a wrong frame a few do, too.
constexpr double min_share = 0.25;

/// A small view of a photograph, and the points that it was found to show.
struct Probe {
  View view;
  std::vector<glm::dvec3> points;
};

Result<View> small_view(Photograph photograph) {
  photograph.lens = photographs::undistorted(photograph.lens);
  Result<View> view = view_of(photograph);
  if (!view) return view;
  const double scale = double(probe_width) / view->width;
  view->width = probe_width, view->height = std::max(int(std::lround(scale * view->height)), 1);
  view->fx *= scale, view->fy *= scale, view->cx *= scale, view->cy *= scale;
  return view;
}

Result<std::vector<Probe>> probes_of(const PhotographSet& set) {
  const std::size_t step = std::max<std::size_t>((set.photographs.size() + max_probes - 1) / max_probes, 1);
  std::vector<Probe> probes;
  for (std::size_t i = 0; i < set.photographs.size(); i += step) {
    const Result<View> view = small_view(set.photographs[i]);
    if (!view) return view.errors();
    probes.push_back({*view, {}});
  }
  for (const photographs::SparsePoint& point : set.points)
    for (const photographs::Observation& o : point.observations)
      if (const auto photograph = std::size_t(o.photograph); photograph % step == 0)
        probes[photograph / step].points.push_back(point.position_in_world);
  return probes;
}

/// Points in pixels that show the scan, and those of them that lie on it.
struct Agreement {
  std::size_t asked = 0, on_scan = 0;
  bool is_enough() const {
    return double(on_scan) >= min_share * double(asked) && on_scan >= min_scan_points / 2;
  }
};

Result<Agreement> agreement(const std::vector<NamedMesh>& meshes, const std::vector<Probe>& probes) {
  const Result<LayerModelResult> model = layer_model(meshes);
  if (!model) return model.errors();
  Agreement found;
  for (const Probe& probe : probes) {
    const ItemBuffer seen = item_buffer(model->model, probe.view);
    for (const glm::dvec3& point : probe.points) {
      const glm::dvec3 p = probe.view.to_camera(point);
      if (p.z <= 0.0) continue;
      const glm::dvec2 pixel = glm::floor(probe.view.to_pixel(p));
      if (pixel.x < 0.0 || pixel.y < 0.0 || pixel.x >= seen.width || pixel.y >= seen.height) continue;
      const double depth = double(seen.depths[seen.index(int(pixel.x), int(pixel.y))]);
      if (!std::isfinite(depth)) continue;
      ++found.asked, found.on_scan += std::abs(depth - p.z) < same_depth * p.z;
    }
  }
  return found;
}

std::vector<NamedMesh> moved(const std::vector<NamedMesh>& meshes, const glm::dmat4& world_from_scan) {
  std::vector<NamedMesh> result;
  result.reserve(meshes.size());
  for (const NamedMesh& named : meshes) {
    result.push_back({named.name, {}});
    append(result.back().mesh, named.mesh, glm::mat4(world_from_scan));
  }
  return result;
}

}  // namespace

Result<PlacedScan> placed_scan(const std::vector<NamedMesh>& meshes, const PhotographSet& set) {
  const Result<std::vector<Probe>> probes = probes_of(set);
  if (!probes) return probes.errors();
  std::size_t points = 0;
  for (const Probe& probe : *probes) points += probe.points.size();
  if (points < min_scan_points) return PlacedScan{meshes, false};
  const glm::dmat4 y_up = glm::rotate(glm::dmat4(1.0), glm::radians(-90.0), glm::dvec3(1, 0, 0));
  const std::array<glm::dmat4, 4> frames{glm::dmat4(1.0), set.world_from_given, y_up,
                                         set.world_from_given * y_up};
  PlacedScan best;
  Agreement of_best;
  Progress progress("finding the scan's frame", frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    progress.advance();
    if (std::find(frames.begin(), frames.begin() + std::ptrdiff_t(i), frames[i]) !=
        frames.begin() + std::ptrdiff_t(i))
      continue;
    std::vector<NamedMesh> candidate = i == 0 ? meshes : moved(meshes, frames[i]);
    const Result<Agreement> found = agreement(candidate, *probes);
    if (!found) return found.errors();
    if (found->is_enough() && found->on_scan > of_best.on_scan)
      best = {std::move(candidate), i != 0}, of_best = *found;
  }
  if (!of_best.is_enough())
    return error(
        "hardly any of the points that photographs have in common lie on the scan: it is of another place, "
        "or "
        "of another frame than the cameras; calibrate with those that it was made with (--cameras)");
  return best;
}

}  // namespace parvis::facades
