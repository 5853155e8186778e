// A street of three walls with known colours, photographed: for tests of all that is made of photographs.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "base/colour.h"
#include "base/image_io.h"
#include "base/test_folder.h"
#include "capture/facades/item_buffer.h"
#include "capture/facades/place_layers.h"
#include "capture/facades/test_model.h"

namespace parvis::facades {

/// Linear colour of a point of the walls.
inline glm::vec3 pattern(glm::dvec3 p) {
  return {0.4 + 0.2 * std::sin(2.0 * p.x), 0.4 + 0.2 * std::sin(3.0 * p.z + p.x), 0.05 * p.y};
}

/// A far wall, a near one before it, and a post.
inline std::vector<NamedMesh> street() {
  return {wall("far", 6, -12, 12, -8, 8), wall("near", 4, -0.7f, 0.7f, -2, 2),
          wall("post", 3, 1.5f, 1.8f, -2, 2)};
}

/// The street with its walls divided into small squares, so many in each direction.
inline std::vector<NamedMesh> fine_street(int cells) {
  std::vector<NamedMesh> fine;
  for (const NamedMesh& coarse : street()) {
    NamedMesh named{coarse.name, {}};
    const glm::vec3 *c = coarse.mesh.positions.data(), u = (c[1] - c[0]) / float(cells),
                    v = (c[3] - c[0]) / float(cells);
    for (int y = 0; y < cells; ++y)
      for (int x = 0; x < cells; ++x) {
        const auto first = std::uint32_t(named.mesh.positions.size());
        for (const glm::ivec2 at : {glm::ivec2(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
          named.mesh.positions.push_back(c[0] + float(x + at.x) * u + float(y + at.y) * v);
          named.mesh.normals.push_back(coarse.mesh.normals[0]), named.mesh.uvs.push_back(glm::vec2(0.0f));
        }
        for (const std::uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) named.mesh.indices.push_back(first + k);
      }
    fine.push_back(std::move(named));
  }
  return fine;
}

/// The photograph that a view takes of a model whose points have these linear colours, as a PNG file of an
/// exposure.
inline photographs::Photograph photograph_of(const std::vector<NamedMesh>& meshes,
                                             const std::function<glm::vec3(glm::dvec3)>& colour,
                                             const TestFolder& folder, const std::string& name,
                                             const View& view, float exposure) {
  const LayerModel model = model_of(meshes);
  const ItemBuffer seen = item_buffer(model, view);
  ImageF picture(view.width, view.height, 4, 1.0f);
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x)
      for (int c = 0; c < 3; ++c)
        picture.at(x, y)[c] =
            exposure * colour(view.to_world({x + 0.5, y + 0.5}, seen.depths[seen.index(x, y)]))[c];
  photographs::Photograph photo;
  photo.name = name, photo.file = folder.path() / name;
  EXPECT_TRUE(write_image(photo.file, srgb8_from_linear(picture)));
  photo.lens = photographs::pinhole_lens(view.width, view.height, view.fx, view.fy, view.cx, view.cy);
  glm::dmat4 opencv_from_world(view.camera_from_world);
  opencv_from_world[3] = glm::dvec4(-(view.camera_from_world * view.centre), 1.0);
  photo.world_from_camera = photographs::world_from_camera_of_opencv(opencv_from_world);
  return photo;
}

/// The photograph that a view takes of the street, as a PNG file, each with an exposure of its own.
inline photographs::Photograph photograph(const TestFolder& folder, const std::string& name, const View& view,
                                          float exposure) {
  return photograph_of(street(), pattern, folder, name, view, exposure);
}

/// Four photographs along the street, each with an exposure of its own.
struct Photos {
  TestFolder folder;
  std::vector<photographs::Photograph> photos;
  Photos() {
    for (int i = 0; i < 4; ++i)
      photos.push_back(photograph(folder, fmt::format("{:04}.png", i),
                                  test_view(160, 120, {1.3 * i - 2.0, 0, 0}), 0.8f + 0.1f * float(i)));
  }
};

/// The true picture of a view, 8-bit sRGB.
inline Image8 true_picture(const View& view) {
  const LayerModel model = model_of(street());
  const ItemBuffer seen = item_buffer(model, view);
  ImageF truth(view.width, view.height, 4, 1.0f);
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x)
      for (int c = 0; c < 3; ++c)
        truth.at(x, y)[c] = pattern(view.to_world({x + 0.5, y + 0.5}, seen.depths[seen.index(x, y)]))[c];
  return srgb8_from_linear(truth);
}

}  // namespace parvis::facades
