// After space carving (Kutulakos and Seitz 2000): a surface about which the photographs that see it do not
// agree is none. Carving goes on only from where the scan ends already, because glass contradicts itself,
// too.
#include "capture/facades/scan_trim.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/joined_triangles.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "capture/facades/balance.h"
#include "capture/facades/sightings.h"

namespace parvis::facades {
namespace {

constexpr float contradicted = 0.12f;  ///< of sRGB, in the channel that differs most
/// Angles between the directions to two photographs that are compared: from the same place any surface
/// agrees, and from the side real ones differ.
constexpr double min_compared_angle_deg = 3.0, max_compared_angle_deg = 26.0;
constexpr int smoothing_rounds = 8;   ///< in each a triangle takes the mean of its own and its neighbours'
constexpr double crumb_share = 0.01;  ///< of a mesh's triangles

glm::dvec3 centre_of(const Mesh& mesh, const std::array<std::uint32_t, 3>& t) {
  return (glm::dvec3(mesh.positions[t[0]]) + glm::dvec3(mesh.positions[t[1]]) +
          glm::dvec3(mesh.positions[t[2]])) /
         3.0;
}

/// How much photographs contradict each other about a point; nothing where no two can be compared.
std::optional<float> contradiction_at(std::span<const PreparedPhoto> photos, std::span<const ImageF> srgb,
                                      glm::dvec3 point) {
  const Sightings found = sightings(photos, srgb, point);
  const double most = std::cos(glm::radians(min_compared_angle_deg)),
               fewest = std::cos(glm::radians(max_compared_angle_deg));
  std::vector<float> differences;
  for (std::size_t a = 0; a < found.size(); ++a)
    for (std::size_t b = a + 1; b < found.size(); ++b) {
      const double cosine = glm::dot(glm::normalize(photos[found[a].photo].view.centre - point),
                                     glm::normalize(photos[found[b].photo].view.centre - point));
      if (cosine > most || cosine < fewest) continue;
      const glm::vec3 d = glm::abs(found[a].srgb - found[b].srgb);
      differences.push_back(std::max({d.x, d.y, d.z}));
    }
  if (differences.empty()) return std::nullopt;
  const auto middle = differences.begin() + std::ptrdiff_t((differences.size() - 1) / 2);
  std::ranges::nth_element(differences, middle);
  return *middle;
}

/// Contradictions per triangle, smoothed over its neighbours: leaves agree here and there though nothing is
/// there. A triangle that no two photographs see takes its neighbours' value; 0 where nothing is known far
/// around.
std::vector<float> contradictions(const Mesh& mesh, const JoinedTriangles& joined,
                                  std::span<const PreparedPhoto> photos, std::span<const ImageF> srgb) {
  std::vector<std::optional<float>> values(joined.triangles.size());
  parallel_for(values.size(), [&](std::size_t t) {
    values[t] = contradiction_at(photos, srgb, centre_of(mesh, joined.triangles[t]));
  });
  for (int round = 0; round < smoothing_rounds; ++round) {
    const std::vector<std::optional<float>> before = values;
    parallel_for(values.size(), [&](std::size_t t) {
      float sum = before[t].value_or(0.0f), count = before[t] ? 1.0f : 0.0f;
      for (const std::uint32_t neighbour : joined.neighbours[t])
        if (neighbour != no_triangle && before[neighbour]) sum += *before[neighbour], ++count;
      if (count > 0.0f) values[t] = sum / count;
    });
  }
  std::vector<float> smoothed;
  smoothed.reserve(values.size());
  for (const std::optional<float>& value : values) smoothed.push_back(value.value_or(0.0f));
  return smoothed;
}

/// Visits `first` and all that `is_open` lets it reach over edges. `is_done` remembers who was visited.
template <class IsOpen, class Visit>
void flood(const JoinedTriangles& joined, std::uint32_t first, std::vector<char>& is_done, IsOpen is_open,
           Visit visit) {
  std::vector<std::uint32_t> open{first};
  is_done[first] = 1;
  while (!open.empty()) {
    const std::uint32_t t = open.back();
    open.pop_back();
    visit(t);
    for (const std::uint32_t neighbour : joined.neighbours[t])
      if (neighbour != no_triangle && !is_done[neighbour] && is_open(neighbour))
        is_done[neighbour] = 1, open.push_back(neighbour);
  }
}

/// 1 for each triangle that is cut off.
std::vector<char> cut_off(const JoinedTriangles& joined, const std::vector<float>& values) {
  const std::size_t count = joined.triangles.size();
  std::vector<char> is_cut(count, 0);
  const auto is_false = [&](std::uint32_t t) { return values[t] > contradicted; };
  for (std::uint32_t t = 0; t < count; ++t)
    if (!is_cut[t] && is_false(t) && std::ranges::count(joined.neighbours[t], no_triangle) > 0)
      flood(joined, t, is_cut, is_false, [](std::uint32_t) {});
  // Crumbs: small pieces that hung on what is gone.
  std::vector<char> is_done = is_cut;
  const std::vector<char> is_gone = is_cut;
  for (std::uint32_t t = 0; t < count; ++t) {
    if (is_done[t]) continue;
    std::vector<std::uint32_t> piece;
    bool hung_on = false;
    flood(
        joined, t, is_done, [&](std::uint32_t) { return true; },
        [&](std::uint32_t at) {
          piece.push_back(at);
          for (const std::uint32_t neighbour : joined.neighbours[at])
            hung_on |= neighbour != no_triangle && is_gone[neighbour] != 0;
        });
    if (hung_on && double(piece.size()) < crumb_share * double(count))
      for (const std::uint32_t at : piece) is_cut[at] = 1;
  }
  return is_cut;
}

/// The triangles that are kept, with their vertices alone.
Mesh kept_part(const Mesh& mesh, const JoinedTriangles& joined, const std::vector<char>& is_cut) {
  Mesh kept;
  std::vector<std::uint32_t> number(mesh.positions.size(), ~0u);
  for (std::size_t t = 0; t < joined.triangles.size(); ++t) {
    if (is_cut[t]) continue;
    for (const std::uint32_t corner : joined.triangles[t]) {
      if (number[corner] == ~0u) {
        number[corner] = std::uint32_t(kept.positions.size());
        append_vertex(kept, mesh, corner);
      }
      kept.indices.push_back(number[corner]);
    }
  }
  return kept;
}

bool is_scan(const NamedMesh& named) {
  return named.name != backdrop_name && named.mesh.triangle_count() > max_faces_in_layers;
}

}  // namespace

Result<TrimmedScans> trimmed_scans(const std::vector<NamedMesh>& meshes,
                                   const std::vector<photographs::Photograph>& photographs) {
  const Result<LayerModelResult> model = layer_model(meshes);
  if (!model) return model.errors();
  TrimmedScans trimmed;
  std::vector<PreparedPhoto> photos;
  Progress progress("trimming scans", photographs.size() + meshes.size());
  for (const photographs::Photograph& photograph : photographs) {
    Result<PreparedPhoto> photo = prepared_photo(photograph, model->model);
    progress.advance();
    if (photo)
      photos.push_back(*std::move(photo));
    else
      trimmed.notes.insert(trimmed.notes.end(), photo.errors().begin(), photo.errors().end());
  }
  const std::vector<Balance> found = balances(photos);
  for (std::size_t i = 0; i < photos.size(); ++i) apply(found[i], photos[i]);
  const std::vector<ImageF> srgb = blurred_srgb(photos);
  for (const NamedMesh& named : meshes) {
    progress.advance();
    if (!is_scan(named)) {
      trimmed.meshes.push_back(named);
      continue;
    }
    const JoinedTriangles joined = joined_triangles(named.mesh);
    const std::vector<char> is_cut = cut_off(joined, contradictions(named.mesh, joined, photos, srgb));
    const auto cut = std::size_t(std::ranges::count(is_cut, 1));
    if (cut > 0)
      trimmed.notes.push_back(
          error("{}: {} of {} triangles at its borders were cut off: photographs contradict each other about "
                "them",
                named.name, cut, joined.triangles.size()));
    if (cut == 0)
      trimmed.meshes.push_back(named);
    else if (cut < joined.triangles.size())
      trimmed.meshes.push_back({named.name, kept_part(named.mesh, joined, is_cut)});
  }
  if (trimmed.meshes.empty())
    return error(
        "photographs contradict each other about all of the model; it is of another place, or their cameras "
        "are of another frame");
  return trimmed;
}

}  // namespace parvis::facades
