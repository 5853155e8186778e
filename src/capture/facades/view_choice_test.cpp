#include "capture/facades/view_choice.h"

#include <gtest/gtest.h>

#include "capture/facades/facade_lookup.h"
#include "capture/facades/item_buffer.h"
#include "capture/facades/test_street.h"

namespace parvis::facades {
namespace {

struct PackedStreet {
  Photos input;
  PackedFacade facade;

  explicit PackedStreet(int cells) {
    for (int i = 4; i < 7; ++i)
      input.photos.push_back(photograph(input.folder, fmt::format("{:04}.png", i),
                                        test_view(160, 120, {1.3 * i - 5.6, 0.4, 0.5}), 1.0f));
    Result<PlaceLayers> made = place_layers(input.photos, fine_street(cells));
    EXPECT_TRUE(made) << to_string(made ? Errors{} : made.errors());
    facade = packed_facade(*made);
  }
};

PackedFacade with(const ViewChoice& choice, PackedFacade facade) {
  facade.lists = choice.lists;
  facade.candidates.insert(facade.candidates.end(), choice.candidates.begin(), choice.candidates.end());
  return facade;
}

/// The picture of a view by the choice for its eye.
ImageF shown(const ViewChoice& choice, const PackedFacade& facade, const FacadeTexels& texels,
             const View& view) {
  return view_of_facade(with(choice, facade), texels, view, item_buffer(model_of(facade), view),
                        choice.triangles);
}

double psnr(const ImageF& a, const ImageF& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) sum += std::pow(double(a.pixels[i] - b.pixels[i]), 2);
  return -10.0 * std::log10(std::max(sum / double(a.pixels.size()), 1e-12));
}

TEST(ViewChoice, AFewPhotographsShowWhatAllOfThemShow) {
  const PackedStreet packed(24);
  const View view = test_view(160, 120, {0.4, 0.5, 0.2});
  const ViewChooser chooser(packed.facade);
  const ViewChoice choice = chooser.choice(glm::vec3(view.centre), float(1.0 / view.fx));
  std::size_t all = 0, chosen = 0;
  for (std::size_t t = 0; t < choice.lists.size(); ++t)
    all += packed.facade.lists[t].y, chosen += choice.triangles[t] ? 2 : choice.lists[t].y;
  EXPECT_LT(chosen, all * 7 / 10) << "of seven photographs three are compared";
  const FacadeTexels texels(packed.facade);
  const ImageF by_all = view_of_facade(packed.facade, texels, view);
  EXPECT_GT(psnr(shown(choice, packed.facade, texels, view), by_all), 40.0);
  // The control: the last photograph of each list, whichever it is.
  ViewChoice last = choice;
  for (glm::uvec2& list : last.lists) list.x += std::max(list.y, 1u) - 1, list.y = std::min(list.y, 1u);
  last.triangles.clear();
  EXPECT_LT(psnr(view_of_facade(with(last, packed.facade), texels, view), by_all), 38.0);
}

TEST(ViewChoice, OneChoiceForATriangleShowsWhatEachPixelWouldChoose) {
  const PackedStreet packed(64);
  const FacadeTexels texels(packed.facade);
  const ViewChooser chooser(packed.facade);
  for (const glm::dvec3 eye : {glm::dvec3(0.4, 0.5, 0.2), packed.facade.photos[1].view.centre}) {
    const View view = test_view(160, 120, eye);
    const ItemBuffer seen = item_buffer(model_of(packed.facade), view);
    ViewChoice choice = chooser.choice(glm::vec3(eye), float(1.0 / view.fx));
    std::size_t of_model = 0, of_one_choice = 0;
    for (const std::uint32_t triangle : seen.triangles)
      if (triangle != no_triangle_seen) ++of_model, of_one_choice += choice.triangles[triangle].has_value();
    EXPECT_GT(of_one_choice, of_model / 2) << "of large squares the rest needs each pixel's choice";
    const ImageF by_all = view_of_facade(packed.facade, texels, view);
    EXPECT_GT(psnr(shown(choice, packed.facade, texels, view), by_all), 40.0);
    // The control: each photograph is looked up where the other one is.
    for (std::optional<ChosenTriangle>& one : choice.triangles)
      if (one)
        for (ChosenCorner& corner : one->corners)
          corner.at = {corner.at.z, corner.at.w, corner.at.x, corner.at.y};
    EXPECT_LT(psnr(shown(choice, packed.facade, texels, view), by_all), 38.0);
  }
}

TEST(ViewChoice, ATriangleThatFillsTheViewKeepsAllItsPhotographs) {
  const Photos input;
  const Result<PlaceLayers> made = place_layers(input.photos, street());
  ASSERT_TRUE(made);
  const PackedFacade facade = packed_facade(*made);
  const ViewChoice choice = ViewChooser(facade).choice({0.0f, 0.0f, 0.0f}, 0.01f);
  EXPECT_EQ(choice.lists, facade.lists);
  EXPECT_TRUE(choice.candidates.empty());
  for (const auto& one : choice.triangles) EXPECT_FALSE(one);
  EXPECT_TRUE(ViewChooser(PackedFacade{}).choice({}, 0.01f).lists.empty());
}

TEST(ViewChoice, ItHoldsForAPartOfTheWayToTheNextPhotograph) {
  const PackedStreet packed(24);
  const ViewChooser chooser(packed.facade);
  const glm::vec3 own(packed.facade.photos[0].view.centre);
  EXPECT_NEAR(chooser.step({0.0f, 100.0f, 0.0f}), 0.05f * 0.792f, 0.001f);
  EXPECT_NEAR(chooser.step(own), 0.005f * 0.792f, 0.0001f) << "there a photograph's weight changes fast";
}

}  // namespace
}  // namespace parvis::facades
