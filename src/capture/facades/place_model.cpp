#include "capture/facades/place_model.h"

#include <cmath>

#include "base/bounds.h"
#include "base/files.h"
#include "base/image_io.h"
#include "capture/facades/place_folder.h"
#include "capture/facades/prepared_photo.h"
#include "capture/facades/relief.h"
#include "capture/photographs/set_file.h"

namespace parvis::facades {
namespace {

void add(Errors& all, const Errors& more) { all.insert(all.end(), more.begin(), more.end()); }

/// A dome around everything, so far away that where it stands makes no difference.
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

/// Luminance of the folder's photographs, freed from distortion. One that cannot be read is in the notes.
std::vector<GreyPhoto> grey_photos(const PlaceSource& source, Errors& notes) {
  std::vector<GreyPhoto> photos;
  for (const photographs::Photograph& photograph : source.photographs) {
    const Result<View> view = view_of(photograph);
    const Result<Image8> picture = view ? read_image8(photograph.file) : view.errors();
    if (!picture)
      add(notes, picture.errors());
    else if (picture->width == view->width && picture->height == view->height)
      photos.push_back(grey_photo(*view, *picture));
  }
  return photos;
}

}  // namespace

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
  add(model.notes, planes->notes);
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
  model.meshes.push_back(backdrop(model.meshes, loaded->set));
  add(model.notes, reliefs.notes);
  return model;
}

}  // namespace parvis::facades
