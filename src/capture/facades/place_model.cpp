#include "capture/facades/place_model.h"

#include <array>
#include <cmath>

#include "base/bounds.h"
#include "base/files.h"
#include "base/image_io.h"
#include "capture/facades/place_folder.h"
#include "capture/facades/prepared_photo.h"
#include "capture/facades/relief.h"
#include "capture/facades/surface_check.h"
#include "capture/photographs/set_file.h"

namespace parvis::facades {
namespace {

constexpr double ground_edge = 0.15;  ///< longest of the ground's triangles, of the median viewing distance

/// Each triangle divided into four until its edges are short: a colour where no photograph says anything
/// belongs to a corner.
void divide_triangles(Mesh& mesh, double longest_edge) {
  constexpr std::size_t max_divided = 4096;
  while (mesh.triangle_count() < max_divided) {
    Mesh fine;
    bool is_fine = true;
    for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
      const std::array<std::uint32_t, 3> c{mesh.indices[t], mesh.indices[t + 1], mesh.indices[t + 2]};
      const auto first = std::uint32_t(fine.positions.size());
      const auto add_point = [&](std::uint32_t a, std::uint32_t b) {
        fine.positions.push_back(0.5f * (mesh.positions[a] + mesh.positions[b]));
        fine.normals.push_back(mesh.normals[a]), fine.uvs.push_back(0.5f * (mesh.uvs[a] + mesh.uvs[b]));
      };
      for (std::size_t k = 0; k < 3; ++k) add_point(c[k], c[k]);
      for (std::size_t k = 0; k < 3; ++k) {
        add_point(c[k], c[(k + 1) % 3]);
        is_fine &= glm::distance(mesh.positions[c[k]], mesh.positions[c[(k + 1) % 3]]) <= longest_edge;
      }
      for (const std::uint32_t k : {0u, 3u, 5u, 3u, 1u, 4u, 5u, 4u, 2u, 3u, 4u, 5u})
        fine.indices.push_back(first + k);
    }
    if (is_fine) return;
    mesh = std::move(fine);
  }
}

/// Luminance of the folder's photographs, freed from distortion. One that cannot be read is in the notes.
std::vector<GreyPhoto> grey_photos(const PlaceSource& source, Errors& notes) {
  std::vector<GreyPhoto> photos;
  for (const photographs::Photograph& photograph : source.photographs) {
    const Result<View> view = view_of(photograph);
    const Result<Image8> picture = view ? read_image8(photograph.file) : view.errors();
    if (!picture)
      append(notes, picture.errors());
    else if (picture->width == view->width && picture->height == view->height)
      photos.push_back(grey_photo(*view, *picture));
  }
  return photos;
}

/// The surfaces that were found among the points, flat; not the ground, which is there in any case.
std::vector<NamedMesh> found_surfaces(CoarseModel planes) {
  std::erase_if(planes.surfaces, [](const CoarseSurface& s) { return s.kind == SurfaceKind::ground; });
  return meshes_of(planes);
}

}  // namespace

NamedMesh backdrop(const std::vector<NamedMesh>& meshes, const photographs::PhotographSet& set) {
  constexpr int around = 32, up = 10;
  constexpr double radius_of_extent = 6.0, lowest_deg = -6.0;
  Bounds bounds;
  for (const NamedMesh& named : meshes) bounds.add(named.mesh.bounds());
  for (const photographs::Photograph& photograph : set.photographs)
    bounds.add(glm::vec3(photograph.position_in_world()));
  const glm::dvec3 centre = 0.5 * (glm::dvec3(bounds.min) + glm::dvec3(bounds.max));
  const double radius = radius_of_extent * double(bounds.radius());
  NamedMesh dome{backdrop_name, {}};
  for (int row = 0; row <= up; ++row)
    for (int column = 0; column < around; ++column) {
      const double rise = glm::radians(glm::mix(lowest_deg, 90.0, double(row) / up)),
                   turn = glm::radians(360.0 * column / around);
      const glm::dvec3 out(std::cos(rise) * std::cos(turn), std::cos(rise) * std::sin(turn), std::sin(rise));
      dome.mesh.positions.push_back(glm::vec3(centre + radius * out));
      dome.mesh.normals.push_back(glm::vec3(-out)), dome.mesh.uvs.push_back(glm::vec2(0.0f));
    }
  const auto corner = [&](int row, int column) { return std::uint32_t(row * around + column % around); };
  for (int row = 0; row < up; ++row)
    for (int column = 0; column < around; ++column) {
      const std::uint32_t a = corner(row, column), b = corner(row, column + 1),
                          c = corner(row + 1, column + 1), d = corner(row + 1, column);
      dome.mesh.indices.insert(dome.mesh.indices.end(), {a, c, b});
      if (row + 1 < up) dome.mesh.indices.insert(dome.mesh.indices.end(), {a, d, c});
    }
  return dome;
}

Result<PlaceModel> propose_place_model(const std::filesystem::path& folder, const ModelSettings& settings) {
  const Result<photographs::LoadedSet> loaded = photographs::read_photograph_set(folder);
  if (!loaded) return loaded.errors();
  Result<CoarseModel> planes = propose_coarse_model(loaded->set);
  if (!planes) return planes.errors();
  PlaceModel model;
  model.notes = loaded->problems;
  if (!settings.hints.empty()) {
    const Result<std::string> text = read_file(settings.hints);
    if (!text) return text.errors();
    if (Status status = apply_hints(*planes, *text, settings.hints.string()); !status) return status.errors();
  }
  append(model.notes, planes->notes);
  model.planes = *std::move(planes);
  if (!settings.finds_relief) {
    model.meshes = meshes_of(model.planes);
    model.meshes.push_back(backdrop(model.meshes, loaded->set));
    return model;
  }
  const Result<PlaceSource> source = read_place(folder, {});
  if (!source) return source.errors();
  ReliefModel reliefs = with_reliefs(model.planes, loaded->set, grey_photos(*source, model.notes));
  model.meshes = std::move(reliefs.meshes);
  for (NamedMesh& named : model.meshes)
    if (named.name == "ground")
      divide_triangles(named.mesh, ground_edge * photographs::viewing_distance(loaded->set));
  model.meshes.push_back(backdrop(model.meshes, loaded->set));
  append(model.notes, reliefs.notes);
  if (settings.hints.empty())  // what somebody decided stays
    append(model.notes, leave_out_what_makes_worse(model.meshes, found_surfaces(model.planes),
                                                   small_photos(source->photographs)));
  return model;
}

}  // namespace parvis::facades
