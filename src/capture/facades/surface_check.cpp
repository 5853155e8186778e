#include "capture/facades/surface_check.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "base/colour.h"
#include "base/image_io.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "base/reduction.h"
#include "capture/facades/blend.h"
#include "capture/facades/novel_view.h"

namespace parvis::facades {
namespace {

constexpr int check_width = 160;  // pixels: what covers a portal covers many of them
constexpr std::size_t max_photos = 32, min_photos = 4;
constexpr float max_error = 0.09f;           // of a pixel; also of one that no other photograph shows
constexpr double min_gain = 0.03;            // of all errors: a surface that costs less is not worth a hole
constexpr double min_share_of_photos = 0.6;  // of those that a change concerns must gain by it

/// Squared differences of perceived colours per photograph, summed over its pixels, as the others render it.
std::vector<double> errors_of(const std::vector<NamedMesh>& meshes, std::vector<PreparedPhoto>& photos) {
  const Result<LayerModelResult> model = layer_model(meshes);
  if (!model) return {};
  for (PreparedPhoto& photo : photos) photo.depths = item_buffer(model->model, photo.view).depths;
  const BlendSettings settings;
  std::vector<double> errors(photos.size(), 0.0);
  parallel_for(photos.size(), [&](std::size_t i) {
    const PreparedPhoto& photo = photos[i];
    for (int y = 0; y < photo.view.height; ++y)
      for (int x = 0; x < photo.view.width; ++x) {
        const double depth = photo.depths[std::size_t(y) * std::size_t(photo.view.width) + std::size_t(x)];
        glm::vec4 shown(0.0f);
        if (std::isfinite(depth)) {
          std::vector<Opinion> found =
              opinions(photos, settings, photo.view.to_world({x + 0.5, y + 0.5}, depth), photo.view.centre,
                       depth / photo.view.fx);
          std::erase_if(found, [&](const Opinion& opinion) { return opinion.photo == i; });
          shown = blended(found, settings.best, settings.max_contradiction);
        }
        const float* p = photo.colours.at(x, y);
        const glm::vec3 off = perceived(glm::vec3(shown)) - perceived(glm::vec3(p[0], p[1], p[2]));
        errors[i] += double(shown.w > 0.0f ? std::min(glm::dot(off, off) / 3.0f, max_error) : max_error);
      }
  });
  return errors;
}

double sum_of(const std::vector<double>& errors) {
  return std::accumulate(errors.begin(), errors.end(), 0.0);
}

/// Do the photographs as a whole, and most of those that show the difference, gain by a change?
bool is_better(const std::vector<double>& changed, const std::vector<double>& now) {
  if (changed.empty() || sum_of(now) - sum_of(changed) < min_gain * sum_of(now)) return false;
  int better = 0, concerned = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (std::abs(changed[i] - now[i]) < 0.2 * min_gain * now[i]) continue;
    ++concerned, better += changed[i] < now[i];
  }
  return better >= min_share_of_photos * concerned;
}

/// A change to a surface, and the errors of the photographs after it.
struct Change {
  std::size_t mesh = 0;
  const NamedMesh* flat = nullptr;  ///< null: it is taken out
  std::vector<double> errors;
};

std::vector<NamedMesh> changed(std::vector<NamedMesh> meshes, const Change& change) {
  if (change.flat)
    meshes[change.mesh] = *change.flat;
  else
    meshes.erase(meshes.begin() + std::ptrdiff_t(change.mesh));
  return meshes;
}

}  // namespace

std::vector<PreparedPhoto> small_photos(const std::vector<photographs::Photograph>& photographs) {
  const std::size_t step = (photographs.size() + max_photos - 1) / max_photos;
  std::vector<PreparedPhoto> photos;
  for (std::size_t i = 0; i < photographs.size(); i += step) {
    const Result<View> view = view_of(photographs[i]);
    const Result<Image8> picture = view ? read_image8(photographs[i].file) : view.errors();
    if (!picture || picture->width != view->width || picture->height != view->height) continue;
    const int n = std::max(picture->width / check_width, 1);
    PreparedPhoto photo{photographs[i].name, *view, linear_from_srgb8(reduced(*picture, n)), {}, {}};
    photo.view.fx /= n, photo.view.fy /= n, photo.view.cx /= n, photo.view.cy /= n;
    photo.view.width = photo.colours.width, photo.view.height = photo.colours.height;
    photos.push_back(std::move(photo));
  }
  return photos;
}

Errors leave_out_what_makes_worse(std::vector<NamedMesh>& meshes, const std::vector<NamedMesh>& flat,
                                  std::vector<PreparedPhoto> photos) {
  Errors notes;
  if (photos.size() < min_photos) return notes;
  std::vector<double> now = errors_of(meshes, photos);
  Progress progress("checking surfaces", flat.size());
  while (true) {
    std::optional<Change> best;
    const auto consider = [&](Change change) {
      change.errors = errors_of(changed(meshes, change), photos);
      if (is_better(change.errors, now) && (!best || sum_of(change.errors) < sum_of(best->errors)))
        best = std::move(change);
    };
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      const auto plain = std::ranges::find(flat, meshes[i].name, &NamedMesh::name);
      if (plain == flat.end()) continue;
      if (notes.empty()) progress.advance();
      consider({i, nullptr, {}});
      if (plain->mesh.indices.size() != meshes[i].mesh.indices.size()) consider({i, &*plain, {}});
    }
    if (!best) return notes;
    notes.push_back(
        error("{} {}: with it as it was proposed, photographs are rendered {:.1f} dB worse from "
              "each other; to decide by hand, give --hints",
              meshes[best->mesh].name, best->flat ? "stays flat" : "is left out",
              10.0 * std::log10(sum_of(now) / sum_of(best->errors))));
    meshes = changed(std::move(meshes), *best);
    now = std::move(best->errors);
  }
}

}  // namespace parvis::facades
