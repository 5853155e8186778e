// Facades on the graphics hardware against the same facades as rays see them.
#include "capture/facades/facade_drawable.h"

#include <gtest/gtest.h>

#include "capture/facades/placed_facade.h"
#include "capture/facades/test_street.h"
#include "graphics/gl/context.h"
#include "graphics/gl/test_context.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/reference/photograph.h"
#include "graphics/reference/tracer.h"
#include "graphics/render/frame_views.h"
#include "graphics/render/renderer.h"
#include "graphics/shading/sky.h"
#include "graphics/shading/tone_curve.h"
#include "scene/data/sun_shadows.h"
#include "scene/data/test_scene.h"

namespace parvis::facades {
namespace {

constexpr int drawn_width = 160, drawn_height = 120;

class FacadeDrawableTest : public gl::ContextTest {
 protected:
  FacadeDrawableTest() {
    const Photos input;
    const Result<PlaceLayers> place = place_layers(input.photos, street());
    placed_.facade = std::make_shared<const PackedFacade>(packed_facade(*place));
    views_ = place->views;
    for (const photographs::Photograph& photo : input.photos) photos_.push_back(*read_image8(photo.file));
    scene_.sky.picture = ImageF(16, 8, 3, 0.1f);
    drawables_.add(facades_kind());
    drawables_.attach(scene_);
    camera_.vertical_fov = 2.0f * std::atan(0.5f * float(drawn_height) / (0.5f * float(drawn_width)));
    look_from({0.4f, 0.5f, 0.2f});
  }
  void look_from(glm::vec3 eye) { camera_.world_from_camera = look_at(eye, eye + glm::vec3(0, 1, 0)); }
  void place(PlacedFacade placed) { scene_.data<scene::ItemsOf<PlacedFacade>>().add(std::move(placed), 0); }

  ImageF draw() {
    Result<std::unique_ptr<render::Renderer>> renderer =
        render::Renderer::create(scene_, drawables_, light::sun_and_sky);
    EXPECT_TRUE(renderer) << to_string(renderer.errors());
    EXPECT_TRUE(render::draw_frame(**renderer, scene_, {camera_, drawn_width, drawn_height}));
    picked_ = (*renderer)->pick(camera_, drawn_width, drawn_height, true);
    return (*renderer)->read_radiance();
  }
  ImageF trace() const {
    const reference::RayScene rays(scene_);
    const shading::SkyLight sky = shading::make_sky_light(scene_.sky.picture, 1.0f, 0.0f);
    reference::TraceOptions options;
    options.samples_per_pixel = 4;
    return reference::trace_picture(rays, scene_, sky, camera_, drawn_width, drawn_height, options).radiance;
  }
  ImageF photograph() const {
    const reference::RayScene rays(scene_);
    const shading::SkyLight sky = shading::make_sky_light(scene_.sky.picture, 1.0f, 0.0f);
    reference::PhotographOptions options;
    options.samples_per_pixel = 4;
    options.paths.bounces = 0;
    return reference::take_photograph(rays, scene_, sky, camera_, drawn_width, drawn_height, options)
        ->radiance;
  }
  static double psnr(const Image8& a, const Image8& b) {
    double sum = 0.0;
    std::size_t count = 0;
    for (int y = 0; y < a.height; ++y)
      for (int x = 0; x < a.width; ++x, count += 3)
        for (int c = 0; c < 3; ++c) sum += std::pow(double(a.at(x, y)[c]) - double(b.at(x, y)[c]), 2);
    return 10.0 * std::log10(255.0 * 255.0 * double(count) / sum);
  }
  Image8 display(const ImageF& radiance) const {
    return shading::tone_mapped_picture(radiance, scene_.exposure);
  }

  PlacedFacade placed_;
  std::vector<View> views_;
  std::vector<Image8> photos_;
  scene::Scene scene_;
  render::Drawables drawables_;
  render::ObjectPicture picked_;
  Camera camera_;
};

TEST_F(FacadeDrawableTest, ItsPictureIsWhatRaysSee) {
  scene_.exposure = 0.7f;
  place(placed_);
  const Image8 drawn = display(draw()), traced = display(trace());
  EXPECT_GT(psnr(drawn, traced), 33.0) << "edges of the near walls are sampled differently";
  EXPECT_EQ(*picked_.at(drawn_width / 2, drawn_height / 2), 1u);
  scene_.data<scene::ItemsOf<PlacedFacade>>().items[0].brightness = 0.5f;
  EXPECT_LT(psnr(display(draw()), traced), 25.0) << "the control: half as bright";
}

TEST_F(FacadeDrawableTest, TrianglesOfOneChoiceAreWhatRaysSee) {
  const Photos input;
  const Result<PlaceLayers> made = place_layers(input.photos, fine_street(64));
  ASSERT_TRUE(made) << to_string(made.errors());
  placed_.facade = std::make_shared<const PackedFacade>(packed_facade(*made));
  const ViewChoice choice = ViewChooser(*placed_.facade).choice({0.4f, 0.5f, 0.2f}, 0.01f);
  EXPECT_GT(std::ranges::count_if(choice.triangles, [](const auto& one) { return one.has_value(); }),
            std::ptrdiff_t(choice.triangles.size() / 2));
  place(placed_);
  const Image8 drawn = display(draw());
  EXPECT_GT(psnr(drawn, display(trace())), 33.0) << "edges of the near walls are sampled differently";
  EXPECT_EQ(*picked_.at(drawn_width / 2, drawn_height / 2), 1u);
  // The same where other things make it receive their shadows.
  scene::add(scene_, scene::model_of(scene::box({50, -50, 0}, {51, -49, 1}), scene::matt(glm::vec3(0.5f))));
  EXPECT_GT(psnr(display(draw()), drawn), 50.0);
  scene_.data<scene::ItemsOf<PlacedFacade>>().items[0].brightness = 0.5f;
  EXPECT_LT(psnr(display(draw()), drawn), 25.0) << "the control: half as bright";
}

TEST_F(FacadeDrawableTest, APhotographsOwnViewpointIsThePhotograph) {
  place(placed_);
  look_from(glm::vec3(views_[1].centre));
  EXPECT_GT(psnr(display(draw()), photos_[1]), 38.0);
  EXPECT_LT(psnr(display(draw()), photos_[2]), 25.0) << "the control: another photograph";
}

/// Radiance of one picture over that of another, in each pixel; 1 where there is none.
ImageF ratio(const ImageF& a, const ImageF& b) {
  ImageF share(a.width, a.height, 1, 1.0f);
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x)
      if (b.at(x, y)[1] > 1e-3f) *share.at(x, y) = a.at(x, y)[1] / b.at(x, y)[1];
  return share;
}

int count_below(const ImageF& share, float limit) {
  return int(std::ranges::count_if(share.pixels, [&](float value) { return value < limit; }));
}

TEST_F(FacadeDrawableTest, WhatIsInsertedCastsItsShadowOnThePhotographs) {
  constexpr float kept = 0.3f;
  scene_.sun.direction_to_sun = glm::normalize(glm::vec3(0.3f, -1.0f, 0.8f));
  scene_.sun.irradiance = glm::vec3(1.0f);
  placed_.kept_in_shadow = kept;
  place(placed_);
  PlacedFacade& shown = scene_.data<scene::ItemsOf<PlacedFacade>>().items[0];
  const ImageF alone = draw();
  shown.kept_in_shadow = 1.0f;
  EXPECT_EQ(count_below(ratio(alone, draw()), 0.99f), 0)
      << "the near wall's shadow on the far one is in the photographs, if anywhere";
  scene::add(scene_, scene::model_of(scene::box({-2.5f, 2.8f, 2.2f}, {-1.0f, 3.2f, 3.2f}),
                                     scene::matt(glm::vec3(0.5f))));
  const ImageF lit_drawn = draw(), lit_traced = trace(), lit_photographed = photograph();
  shown.kept_in_shadow = kept;
  const ImageF drawn = ratio(draw(), lit_drawn), traced = ratio(trace(), lit_traced),
               photographed = ratio(photograph(), lit_photographed);
  const int shaded = count_below(traced, 0.5f);
  ASSERT_GT(shaded, 200);
  EXPECT_NEAR(*std::ranges::min_element(drawn.pixels), kept, 0.01f);
  EXPECT_NEAR(*std::ranges::min_element(traced.pixels), kept, 0.01f);
  EXPECT_NEAR(*std::ranges::min_element(photographed.pixels), kept, 0.01f);
  int wrong = 0, wrong_in_photograph = 0;
  for (std::size_t i = 0; i < drawn.pixels.size(); ++i) {
    wrong += (drawn.pixels[i] < 0.6f) != (traced.pixels[i] < 0.6f);
    wrong_in_photograph += (photographed.pixels[i] < 0.6f) != (traced.pixels[i] < 0.6f);
  }
  EXPECT_LT(wrong, shaded / 8) << "pixels at the shadow's edge alone";
  EXPECT_LT(wrong_in_photograph, shaded / 8) << "pixels at the shadow's edge alone";
  // The control: a sun a little to the side.
  scene_.sun.direction_to_sun = glm::normalize(glm::vec3(0.5f, -1.0f, 0.8f));
  const ImageF aside = ratio(draw(), lit_drawn);
  int moved = 0;
  for (std::size_t i = 0; i < drawn.pixels.size(); ++i)
    moved += (aside.pixels[i] < 0.6f) != (traced.pixels[i] < 0.6f);
  EXPECT_GT(moved, shaded / 4);
}

TEST_F(FacadeDrawableTest, CastsNoShadowWhereOthersAloneDo) {
  scene_.sun.direction_to_sun = glm::normalize(glm::vec3(0.0f, 1.0f, 0.8f));  // behind the walls
  scene_.sun.irradiance = glm::vec3(3.0f);
  scene::add(scene_, scene::model_of(scene::box({-3.0f, 0.6f, -0.9f}, {3.0f, 3.6f, -0.8f}),
                                     scene::matt(glm::vec3(0.5f))));
  place(placed_);
  std::vector<scene::NodeRange>& casters = scene_.data<scene::SunShadows>().caster_nodes;
  casters = {{0, 0}};
  const ImageF with_drawn = draw(), with_traced = trace();
  casters = {{1, 4}};  // it is of node 0
  const ImageF drawn = ratio(with_drawn, draw()), traced = ratio(with_traced, trace());
  const int shaded = count_below(traced, 0.7f);
  ASSERT_GT(shaded, 500) << "the slab before the walls";
  int wrong = 0;
  for (std::size_t i = 0; i < drawn.pixels.size(); ++i)
    wrong += (drawn.pixels[i] < 0.7f) != (traced.pixels[i] < 0.7f);
  EXPECT_LT(wrong, shaded / 8) << "pixels at the slab's edge alone";
}

TEST_F(FacadeDrawableTest, ItMayStandAnywhereAndBeHidden) {
  place(placed_);
  const Image8 before = display(draw());
  const glm::mat4 moved = glm::rotate(glm::translate(glm::mat4(1.0f), {100, -50, 3}), 0.8f, {0, 0, 1});
  PlacedFacade& placed = scene_.data<scene::ItemsOf<PlacedFacade>>().items[0];
  placed.world_from_facade = moved;
  camera_.world_from_camera = moved * camera_.world_from_camera;
  EXPECT_GT(psnr(display(draw()), before), 40.0);
  placed.is_visible = false;
  draw();
  EXPECT_EQ(*picked_.at(drawn_width / 2, drawn_height / 2), 0u);
}

TEST_F(FacadeDrawableTest, BlocksAndDecodedTexelsShowTheSame) {
  place(placed_);
  Image8 pictures[2];
  for (const HeldTexels held : {HeldTexels::blocks, HeldTexels::decoded}) {
    const Result<FacadeTextures> textures = FacadeTextures::create(*placed_.facade, held);
    ASSERT_TRUE(textures) << to_string(textures.errors());
    EXPECT_EQ(textures->holds_blocks(), held == HeldTexels::blocks);
    drawables_ = {};
    drawables_.add(facades_kind(Compared::chosen, held));
    pictures[held == HeldTexels::decoded ? 1 : 0] = display(draw());
  }
  EXPECT_GT(psnr(pictures[0], pictures[1]), 50.0) << "the hardware's decoder against our own";
  const Result<FacadeTextures> chosen = FacadeTextures::create(*placed_.facade);
  ASSERT_TRUE(chosen) << to_string(chosen.errors());
  EXPECT_EQ(chosen->holds_blocks(), !gl::is_software());
  // The control: with one bit of each block wrong the pictures must differ.
  PackedFacade damaged = *placed_.facade;
  for (Bc7Block& block : damaged.blocks) block[0] ^= 0x80;
  scene_.data<scene::ItemsOf<PlacedFacade>>().items[0].facade =
      std::make_shared<const PackedFacade>(std::move(damaged));
  EXPECT_LT(psnr(display(draw()), pictures[1]), 45.0);
}

TEST_F(FacadeDrawableTest, AWalkStaysWithinItsMemory) {
  // Photographs of 3 x 2 tiles take a strip of 16 slots each; a page holds 16 strips, so eight copies of the
  // row of four, side by side, need two pages.
  PackedFacade row = *placed_.facade;
  const std::size_t photos = row.photos.size(), layers = row.layers.size(), tiles = row.tiles.size();
  const std::vector<std::uint16_t> depths = row.depths;
  const std::vector<Bc7Block> blocks = row.blocks;
  const std::uint32_t slots = std::uint32_t(row.slot_count());
  for (std::uint32_t copy = 1; copy < 8; ++copy) {
    for (std::size_t p = 0; p < photos; ++p) {
      row.photos.push_back(row.photos[p]);
      row.photos.back().view.centre.x += 100.0 * copy;
    }
    for (std::size_t l = 0; l < layers; ++l) {
      row.layers.push_back(row.layers[l]);
      row.layers.back().photo += copy * std::uint32_t(photos);
      row.layers.back().first_tile += copy * std::uint32_t(tiles);
    }
    for (std::size_t t = 0; t < tiles; ++t)
      row.tiles.push_back((row.tiles[t] & 3u) == 0 ? 0 : row.tiles[t] + (copy * slots << 2));
    row.depths.insert(row.depths.end(), depths.begin(), depths.end());
    row.blocks.insert(row.blocks.end(), blocks.begin(), blocks.end());
  }
  Result<FacadeTextures> textures = FacadeTextures::create(row, HeldTexels::decoded, 1);
  ASSERT_TRUE(textures) << to_string(textures.errors());
  const Result<FacadeTextures> whole = FacadeTextures::create(row, HeldTexels::decoded);
  ASSERT_TRUE(whole) << to_string(whole.errors());
  EXPECT_LT(textures->texture_bytes(), whole->texture_bytes());
  EXPECT_EQ(std::ranges::count(textures->resident(), 1), 0);
  const glm::vec3 begin(0.0f), end(700.0f, 0.0f, 0.0f);
  EXPECT_TRUE(textures->follow({&begin, 1}));
  EXPECT_TRUE(textures->resident()[1]);
  EXPECT_FALSE(textures->resident()[29]);
  EXPECT_TRUE(textures->follow({&end, 1}));
  EXPECT_TRUE(textures->resident()[29]);
  EXPECT_FALSE(textures->resident()[1]) << "the control: what is far behind was given up";
  EXPECT_FALSE(textures->follow({&end, 1}));

  // What is drawn at the beginning of the walk is the same with the memory for a part of it, and after a walk
  // to its end and back.
  PlacedFacade placed = placed_;
  placed.facade = std::make_shared<const PackedFacade>(row);
  place(placed);
  const Image8 with_all = display(draw());
  scene_.data<scene::ItemsOf<PlacedFacade>>().items[0].max_texture_bytes = 1;
  Result<std::unique_ptr<render::Renderer>> renderer =
      render::Renderer::create(scene_, drawables_, light::sun_and_sky);
  ASSERT_TRUE(renderer) << to_string(renderer.errors());
  const auto shown = [&] {
    EXPECT_TRUE(render::draw_frame(**renderer, scene_, {camera_, drawn_width, drawn_height}));
    return display((*renderer)->read_radiance());
  };
  EXPECT_GT(psnr(shown(), with_all), 50.0);
  look_from({700.4f, 0.5f, 0.2f});
  shown();
  look_from({0.4f, 0.5f, 0.2f});
  EXPECT_GT(psnr(shown(), with_all), 50.0);
}

TEST_F(FacadeDrawableTest, ItsHashIsOfItsContent) {
  const auto hash_of = [](const PlacedFacade& placed) {
    ContentHash hash;
    placed.hash(hash);
    return hash.value();
  };
  PlacedFacade other = placed_;
  EXPECT_EQ(hash_of(other), hash_of(placed_));
  other.brightness = 0.9f;
  EXPECT_NE(hash_of(other), hash_of(placed_));
  PackedFacade repainted = *placed_.facade;
  repainted.blocks[0][3] ^= 1;
  other = placed_, other.facade = std::make_shared<const PackedFacade>(repainted);
  EXPECT_NE(hash_of(other), hash_of(placed_));
}

}  // namespace
}  // namespace parvis::facades
