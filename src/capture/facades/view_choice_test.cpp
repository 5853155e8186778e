#include "capture/facades/view_choice.h"

#include <gtest/gtest.h>

#include "capture/facades/facade_lookup.h"
#include "capture/facades/test_street.h"

namespace parvis::facades {
namespace {

/// The street with its walls divided into small squares.
std::vector<NamedMesh> fine_street() {
  std::vector<NamedMesh> fine;
  for (const NamedMesh& coarse : street()) {
    constexpr int cells = 24;
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

struct Packed {
  Photos input;
  PackedFacade facade;

  Packed() {
    for (int i = 4; i < 7; ++i)
      input.photos.push_back(photograph(input.folder, fmt::format("{:04}.png", i),
                                        test_view(160, 120, {1.3 * i - 5.6, 0.4, 0.5}), 1.0f));
    Result<PlaceLayers> made = place_layers(input.photos, fine_street());
    EXPECT_TRUE(made) << to_string(made ? Errors{} : made.errors());
    facade = packed_facade(*made);
  }
};

PackedFacade with(const ViewChoice& choice, PackedFacade facade) {
  facade.lists = choice.lists;
  facade.candidates.insert(facade.candidates.end(), choice.candidates.begin(), choice.candidates.end());
  return facade;
}

double psnr(const ImageF& a, const ImageF& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) sum += std::pow(double(a.pixels[i] - b.pixels[i]), 2);
  return -10.0 * std::log10(std::max(sum / double(a.pixels.size()), 1e-12));
}

TEST(ViewChoice, AFewPhotographsShowWhatAllOfThemShow) {
  const Packed packed;
  const View view = test_view(160, 120, {0.4, 0.5, 0.2});
  const ViewChooser chooser(packed.facade);
  const ViewChoice choice = chooser.choice(glm::vec3(view.centre), float(1.0 / view.fx));
  std::size_t all = 0, chosen = 0;
  for (std::size_t t = 0; t < choice.lists.size(); ++t)
    all += packed.facade.lists[t].y, chosen += choice.lists[t].y;
  EXPECT_LT(chosen, all * 7 / 10) << "of seven photographs three are compared";
  const FacadeTexels texels(packed.facade);
  const ImageF by_all = view_of_facade(packed.facade, texels, view);
  EXPECT_GT(psnr(view_of_facade(with(choice, packed.facade), texels, view), by_all), 40.0);
  // The control: the last photograph of each list, whichever it is.
  ViewChoice last = choice;
  for (glm::uvec2& list : last.lists) list.x += std::max(list.y, 1u) - 1, list.y = std::min(list.y, 1u);
  EXPECT_LT(psnr(view_of_facade(with(last, packed.facade), texels, view), by_all), 38.0);
}

TEST(ViewChoice, ATriangleThatFillsTheViewKeepsAllItsPhotographs) {
  const Photos input;
  const Result<PlaceLayers> made = place_layers(input.photos, street());
  ASSERT_TRUE(made);
  const PackedFacade facade = packed_facade(*made);
  const ViewChoice choice = ViewChooser(facade).choice({0.0f, 0.0f, 0.0f}, 0.01f);
  EXPECT_EQ(choice.lists, facade.lists);
  EXPECT_TRUE(choice.candidates.empty());
  EXPECT_TRUE(ViewChooser(PackedFacade{}).choice({}, 0.01f).lists.empty());
}

TEST(ViewChoice, ItHoldsForAPartOfTheWayToTheNextPhotograph) {
  const Packed packed;
  EXPECT_NEAR(ViewChooser(packed.facade).step(), 0.05f * 0.792f, 0.001f);
}

}  // namespace
}  // namespace parvis::facades
