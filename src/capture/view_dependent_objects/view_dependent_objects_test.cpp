#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "base/image_io.h"
#include "capture/view_dependent_objects/blended_model.h"
#include "capture/view_dependent_objects/placed_object.h"
#include "capture/view_dependent_objects/view_lookup.h"
#include "formats/gltf/gltf_writer.h"
#include "graphics/gl/test_context.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/reference/tracer.h"
#include "graphics/render/drawables.h"
#include "graphics/render/frame_views.h"
#include "graphics/render/renderer.h"
#include "room_list.h"
#include "scene/data/test_scene.h"
#include "scene/script/test_script.h"

namespace parvis::view_dependent_objects {
namespace {

using glm::vec3;
using scene::Model;

/// A model with a texture of one colour.
std::shared_ptr<Model> painted(Mesh mesh, glm::u8vec3 colour, const std::string& name = "part") {
  scene::Material material = scene::matt(vec3(1.0f));
  material.base_colour_texture = 0;
  auto model = scene::model_of(std::move(mesh), material);
  model->parts[0].object = name;
  Image8 image(8, 8, 4, 255);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x)
      for (int c = 0; c < 3; ++c) image.at(x, y)[c] = colour[c];
  model->textures.push_back({"paint", image});
  return model;
}

const glm::u8vec3 red(255, 0, 0), green(0, 255, 0), blue(0, 0, 255);

Mesh wall() { return scene::quad({-1, 0, 0}, {1, 0, 0}, {1, 0, 2}, {-1, 0, 2}); }

/// Red seen from the left, green from the front, blue from the right.
std::vector<ViewedModel> three_views() {
  return {{painted(wall(), red), {-5, -5, 1}},
          {painted(wall(), green), {0, -7, 1}},
          {painted(wall(), blue), {5, -5, 1}}};
}

glm::vec4 colour_from(const BlendedModel& model, vec3 eye, int passes = 2, glm::vec2 at = {0.25f, 0.25f}) {
  const ViewLookup lookup(std::make_shared<const BlendedModel>(model));
  const vec3* c = model.corners.data();
  const vec3 position = (1.0f - at.x - at.y) * c[0] + at.x * c[1] + at.y * c[2];
  return lookup.colour(model.pieces[0], {0, at, glm::normalize(eye - position), 0.01f}, passes);
}

TEST(BlendedModel, ShowsTheTextureOfTheViewpointFromWhichItIsSeen) {
  const auto model = blended_model(three_views(), {});
  ASSERT_TRUE(model) << to_string(model.errors());
  EXPECT_EQ(model->triangle_count(), 2u) << "three models of the same two triangles";
  EXPECT_FALSE(model->has_holes);
  EXPECT_GT(colour_from(*model, {-5, -5, 1}).x, 0.99f);
  EXPECT_GT(colour_from(*model, {0, -7, 1}).y, 0.99f);
  EXPECT_GT(colour_from(*model, {5, -5, 1}).z, 0.99f);
  const glm::vec4 between = colour_from(*model, {-3.2f, -6.3f, 1});
  EXPECT_GT(between.x, 0.1f);
  EXPECT_GT(between.y, 0.1f);
  EXPECT_NEAR(between.x + between.y + between.z, 1.0f, 1e-3f);
}

/// Walks past all viewpoints: nothing jumps, and no more than N textures are ever seen.
TEST(BlendedModel, BlendsAtMostNAndNothingJumps) {
  const auto model = blended_model(three_views(), {});
  for (const int passes : {1, 2, 3, 4}) {
    glm::vec4 last(0.0f);
    float largest = 0.0f;
    for (int i = 0; i <= 800; ++i) {
      const float x = -8.0f + 0.02f * float(i);
      const glm::vec4 colour = colour_from(*model, {x, -6.0f, 1}, passes);
      if (i > 0) largest = std::max(largest, glm::length(colour - last));
      last = colour;
      int seen = 0;
      for (int c = 0; c < 3; ++c) seen += colour[c] > 1e-4f;
      EXPECT_LE(seen, passes) << x;
    }
    if (passes == 1)
      EXPECT_GT(largest, 0.5f) << "a control: one texture alone jumps";
    else
      EXPECT_LT(largest, 0.12f) << passes;
  }
}

TEST(BlendedModel, TheSameTrianglesInAnotherOrderAreTheSame) {
  Mesh turned = wall();
  turned.indices = {2, 3, 0, 1, 2, 0};
  for (vec3& position : turned.positions) position += vec3(2e-5f, -1e-5f, 1e-5f);
  for (glm::vec2& uv : turned.uvs) uv = glm::vec2(1.0f) - uv;
  const auto model =
      blended_model({{painted(wall(), red), {-5, -5, 1}}, {painted(turned, green), {5, -5, 1}}}, {});
  ASSERT_TRUE(model);
  EXPECT_EQ(model->triangle_count(), 2u);
  EXPECT_FALSE(model->has_holes);
  // The entry of the second view has the uvs of the corners as the first has numbered them.
  const int entry = model->pieces[0].first_entry + 2 + 2;
  const glm::vec4 first = model->table[std::size_t(entry)];
  EXPECT_NEAR(first.x, 1.0f - wall().uvs[0].x, 1e-5f);
  EXPECT_NEAR(first.y, 1.0f - wall().uvs[0].y, 1e-5f);
}

TEST(BlendedModel, WhatOneModelAloneHasIsSeenWhereThatModelCounts) {
  Mesh with_arm = wall();
  append(with_arm, scene::quad({1, 0, 1}, {2, 0, 1}, {2, 0, 1.2f}, {1, 0, 1.2f}));
  const auto model =
      blended_model({{painted(wall(), red), {-5, -5, 1}}, {painted(with_arm, green), {5, -5, 1}}}, {});
  ASSERT_TRUE(model);
  EXPECT_EQ(model->triangle_count(), 4u);
  EXPECT_TRUE(model->has_holes);
  const ViewLookup lookup(std::make_shared<const BlendedModel>(*model));
  const auto alpha = [&](vec3 eye) {
    return lookup
        .colour(model->pieces[0], {2, {0.3f, 0.3f}, glm::normalize(eye - vec3(1.5f, 0, 1)), 0.01f}, 2)
        .w;
  };
  EXPECT_GT(alpha({5, -5, 1}), 0.5f);
  EXPECT_LT(alpha({-5, -5, 1}), 0.5f);
}

TEST(BlendedModel, CleansAndMergesAsTheAppendixSays) {
  auto first = painted(wall(), red, "wall"), second = painted(wall(), green, "wall");
  for (const auto& model : {first, second}) {
    model->materials.push_back(scene::matt(vec3(0.2f, 0.4f, 0.6f)));
    model->parts.push_back({"plain", scene::box({3, 0, 0}, {4, 1, 1}), 1, 0, true});
  }
  second->parts.push_back({"extra", scene::box({6, 0, 0}, {7, 1, 1}), 0, 0, true});
  const std::vector<ViewedModel> models{{first, {-5, -5, 1}}, {second, {5, -5, 1}}};
  const auto pieces = [&](const Merging& merging) {
    const auto model = blended_model(models, merging);
    std::string text;
    for (const Piece& piece : model->pieces)
      text += fmt::format("{}:{}:{} ", piece.name, piece.views, piece.triangle_count);
    return text;
  };
  EXPECT_EQ(pieces({true, true}), "extra:1:12 wall:2:2 ");
  EXPECT_EQ(pieces({false, true}), "extra:1:12 plain:2:12 wall:2:2 ");
  EXPECT_EQ(pieces({true, false}), ":2:14 ");
  EXPECT_EQ(pieces({false, false}), ":2:26 ");
  first->materials[0].base_colour_texture = second->materials[0].base_colour_texture = scene::no_index;
  const auto none = blended_model(models, {});
  ASSERT_FALSE(none);
  EXPECT_NE(to_string(none.errors()).find("cleanModels=0"), std::string::npos);
}

TEST(BlendedModel, RefusesMoreThanItHolds) {
  std::vector<ViewedModel> many(max_views + 1, {painted(wall(), red), {0, -5, 1}});
  EXPECT_NE(to_string(blended_model(many, {}).errors()).find("65 models"), std::string::npos);
  many.resize(max_views);
  EXPECT_TRUE(blended_model(many, {}));
}

constexpr const char* thesis_vrml = R"(#VRML V2.0 utf8
DEF camera Viewpoint { position 6 1 6 orientation 0 1 0 0.785 }
DEF body Shape {
  appearance Appearance { texture PixelTexture { image 1 1 3 0x0000ff } }
  geometry IndexedFaceSet { coord Coordinate { point [ -1 0 0, 1 0 0, 1 2 0, -1 2 0 ] } coordIndex [ 0 1 2 3 -1 ] }
}
)";
constexpr const char* thesis_inventor = R"(#Inventor V2.1 ascii
DEF body Separator {
  Texture2 { image 1 1 3 0x00ff00 }
  Coordinate3 { point [ -1 0 0, 1 0 0, 1 2 0, -1 2 0 ] }
  FaceSet { numVertices 4 }
}
)";

class VdObject : public scene::ScriptTest<gl::ContextTest> {
 protected:
  VdObject() {
    script::register_room(registries_), gltf::register_room(registries_),
        inventor::register_room(registries_);
    view_dependent_objects::register_room(registries_);
    EXPECT_TRUE(scene::write_gltf(folder_.path() / "car.glb", *painted(wall(), red, "body")));
    folder_.write("car2.iv", thesis_inventor);
    folder_.write("car3.wrl", thesis_vrml);
    folder_.write("cameraIV.wrl", "#VRML V2.0 utf8\nViewpoint { position -6 1 6 }\n");
    folder_.write("none.wrl", "#VRML V2.0 utf8\nGroup { }\n");
    folder_.write("two.wrl", "#VRML V2.0 utf8\nDEF a Viewpoint { }\nDEF b Viewpoint { }\n");
  }
};

/// Appendix A.1, as printed: three kinds of cameras; the Performer file is replaced, and the user told.
TEST_F(VdObject, TheExampleOfTheThesisRuns) {
  const auto loaded = load(
      "vdobject(cleanModels=0, file=\"car.pfb\", camera=\"10 0 1 10 10 5.5 30 1\", file=\"car2.iv\", "
      "cameraFile=\"cameraIV.wrl\", file=\"car3.wrl\",cameraName=\"camera\")");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  EXPECT_NE(to_string(loaded->warnings).find("\"car.glb\" is used"), std::string::npos);
  const auto& objects = loaded->scene.items<PlacedObject>();
  ASSERT_EQ(objects.size(), 1u);
  const BlendedModel& model = *objects[0].model;
  ASSERT_EQ(model.pieces.size(), 1u);
  EXPECT_EQ(model.pieces[0].name, "body");
  EXPECT_EQ(model.pieces[0].views, 3);
  EXPECT_EQ(model.triangle_count(), 2u) << "a glb, an Inventor and a VRML file of the same square";
  EXPECT_FALSE(model.has_holes);
  const auto viewpoint = [&](int i) {
    return vec3(model.table[std::size_t(model.pieces[0].first_entry + i)]);
  };
  EXPECT_LT(glm::distance(viewpoint(0), vec3(10, 0, 1)), 1e-4f);
  EXPECT_LT(glm::distance(viewpoint(1), vec3(-6, -6, 1)), 1e-4f) << "VRML's y is up";
  EXPECT_LT(glm::distance(viewpoint(2), vec3(6, -6, 1)), 1e-4f);
  EXPECT_GT(colour_from(model, viewpoint(1)).y, 0.99f);
  EXPECT_GT(colour_from(model, viewpoint(2)).z, 0.99f);
}

TEST_F(VdObject, SaysWhatIsWrong) {
  const auto holds = [&](const std::string& script, const char* piece) {
    const std::string errors = errors_of(script);
    EXPECT_NE(errors.find(piece), std::string::npos) << piece << "\nin\n" << errors;
  };
  holds("vdobject()", "vdobject needs file=");
  holds("vdobject(file=\"car.glb\")", "this model has no camera");
  holds("vdobject(camera=\"0 0 0 0 0 0 30 1\", file=\"car.glb\")", "stands before any file=");
  holds("vdobject(file=\"car.glb\", camera=\"1 2 3\")", "8 numbers");
  holds("vdobject(file=\"car.glb\", camera=\"0 0 0 0 0 0 30 1\", cameraName=\"x\")", "second camera");
  holds("vdobject(file=\"car.glb\", cameraFile=\"missing.wrl\")", "there is no file \"missing.wrl\"");
  holds("vdobject(file=\"car.glb\", cameraFile=\"none.wrl\")", "holds no Viewpoint");
  holds("vdobject(file=\"car.glb\", cameraFile=\"two.wrl\")", "holds 2 viewpoints");
  holds("vdobject(file=\"car.glb\", cameraFile=\"two.wrl\", cameraName=\"c\")", "it has \"a\", \"b\"");
  holds("vdobject(file=\"car3.wrl\", cameraName=\"Camera\")", "it has \"camera\"");
  holds("vdobject(file=\"bus.pfb\", camera=\"0 0 0 0 0 0 30 1\")",
        "no .glb, .gltf, .iv or .wrl of that name");
  holds("vdobject(file=\"car.glb\", camera=\"0 0 0 0 0 0 30 1\", numBlendPass=5)", "from 1 to 4");
  holds("vdobject(file=\"car.glb\", camera=\"1e30 0 0 0 0 0 30 1\")", "further than 1e+09 m away");
  folder_.write("blind.wrl", "#VRML V2.0 utf8\nDEF c Viewpoint { position 0 2 5 fieldOfView 0 }\n");
  holds("vdobject(file=\"car.glb\", cameraFile=\"blind.wrl\")", "\"c\" sees 0 degrees");
  EXPECT_TRUE(load("vdobject(file=\"car.glb\", cameraFile=\"two.wrl\", cameraName=\"b\")"));
  EXPECT_TRUE(
      load("vdobject(file=\"car.glb\", cameraFile=\"two.wrl\", cameraName=\"b\", "
           "file=\"car.glb\", cameraFile=\"two.wrl\", cameraName=\"a\")"));
}

/// A wall whose texture is in the sun on its left half, and in a bluish shadow on its right one.
std::shared_ptr<Model> half_shaded_wall() {
  auto model = painted(wall(), {200, 195, 185});
  Image8& image = model->textures[0].image;
  for (int y = 0; y < 8; ++y)
    for (int x = 4; x < 8; ++x) {
      const glm::u8vec3 shade(112, 112, 116);
      for (int c = 0; c < 3; ++c) image.at(x, y)[c] = shade[c];
    }
  return model;
}

TEST_F(VdObject, ReceivesShadowsAsDarkAsThoseOfItsTexturesAndNoneTwice) {
  ASSERT_TRUE(scene::write_gltf(folder_.path() / "wall.glb", *half_shaded_wall()));
  const auto picture = [&](const char* strength, bool has_board, bool traces) {
    auto loaded = load(fmt::format("vdobject(file=\"wall.glb\", camera=\"0 -5 1 0 0 0 30 1\"{})", strength));
    EXPECT_TRUE(loaded) << to_string(loaded.errors());
    scene::Scene& scene = loaded->scene;
    scene.sky.picture = ImageF(16, 8, 3, 0.1f);
    scene.sun.direction_to_sun = glm::normalize(vec3(0, -1, 1));
    scene.sun.irradiance = vec3(1.0f);
    if (has_board)
      scene::add(scene, scene::model_of(scene::box({-2, -2.1f, 2}, {2, -2, 4}), scene::matt(vec3(0.5f))));
    const auto& drawables = registries_.get<render::Drawables>();
    drawables.attach(scene);
    Camera camera;
    camera.world_from_camera = look_at({0, -5, 1}, {0, 0, 1});
    camera.vertical_fov = 0.35f;
    constexpr int size = 64;
    if (traces) {
      const reference::RayScene rays(scene);
      const shading::SkyLight sky = shading::make_sky_light(scene.sky.picture, 1.0f, 0.0f);
      return reference::trace_picture(rays, scene, sky, camera, size, size, {}).radiance;
    }
    auto renderer = render::Renderer::create(scene, drawables, light::sun_and_sky);
    EXPECT_TRUE(renderer) << to_string(renderer.errors());
    EXPECT_TRUE(render::draw_frame(**renderer, scene, {camera, size, size}));
    return (*renderer)->read_radiance();
  };
  for (const bool traces : {false, true}) {
    const ImageF open = picture("", false, traces), found = picture("", true, traces),
                 set = picture(", shadow_strength=0.5", true, traces),
                 none = picture(", shadow_strength=0", true, traces);
    const auto share = [&](const ImageF& shaded, int x) { return shaded.at(x, 32)[1] / open.at(x, 32)[1]; };
    const float recorded = open.at(48, 32)[1] / open.at(16, 32)[1];
    EXPECT_GT(recorded, 0.1f);
    EXPECT_LT(recorded, 0.6f);
    EXPECT_NEAR(share(found, 16), recorded, 0.06f * recorded) << "as dark as the shadow in the texture";
    EXPECT_NEAR(share(found, 48), 1.0f, 0.02f) << "darkened twice";
    EXPECT_NEAR(share(set, 16), 0.5f, 0.02f);
    EXPECT_NEAR(share(none, 16), 1.0f, 1e-3f);
  }
}

TEST_F(VdObject, CastsAShadowWhereItIsAmongTheCasters) {
  light::register_room(registries_);
  constexpr int size = 64;
  Camera camera;  // the ground before the wall, which stands between it and the sun
  camera.world_from_camera = look_at({0, -1.2f, 6}, {0, -1.2f, 0}, {0, 1, 0});
  camera.vertical_fov = 0.25f;
  const auto mean_of = [](const ImageF& picture) {
    double sum = 0.0;
    for (std::size_t i = 0; i < picture.pixels.size(); i += std::size_t(picture.channels))
      sum += double(picture.pixels[i]);
    return sum;
  };
  const auto brightness = [&](const char* casters, bool traces) {
    const auto object = [](const char* name, int x) {
      return fmt::format(
          "vdobject(name=\"{}\", file=\"car.glb\", camera=\"0 -5 1 0 0 0 30 1\", position=\"{} 0 0\")\n",
          name, x);
    };
    auto loaded = load(object("wall", 0) + object("aside", 40) + fmt::format("shadowMap({})\n", casters));
    EXPECT_TRUE(loaded) << to_string(loaded.errors());
    scene::Scene& scene = loaded->scene;
    scene.sky.picture = ImageF(16, 8, 3, 0.1f);
    scene.sun.direction_to_sun = glm::normalize(vec3(0, 1, 1));
    scene.sun.irradiance = vec3(3.0f);
    scene::add(scene, scene::model_of(scene::ground(60), scene::matt(vec3(0.5f))));
    const auto& drawables = registries_.get<render::Drawables>();
    drawables.attach(scene);
    if (traces) {
      const reference::RayScene rays(scene);
      const shading::SkyLight sky = shading::make_sky_light(scene.sky.picture, 1.0f, 0.0f);
      return mean_of(reference::trace_picture(rays, scene, sky, camera, size, size, {}).radiance);
    }
    auto renderer = render::Renderer::create(scene, drawables, light::sun_and_sky);
    EXPECT_TRUE(renderer) << to_string(renderer.errors());
    EXPECT_TRUE(render::draw_frame(**renderer, scene, {camera, size, size}));
    return mean_of((*renderer)->read_radiance());
  };
  for (const bool traces : {false, true}) {
    const double among_all = brightness("", traces), by_name = brightness("casters=wall", traces),
                 left_out = brightness("casters=aside", traces);
    EXPECT_NEAR(by_name / among_all, 1.0, 0.02) << traces;
    EXPECT_GT(left_out, 2.0 * among_all) << traces;
  }
}

TEST_F(VdObject, IsDrawnAndTracedAlikeFromEverySide) {
  auto loaded = load(
      "vdobject(file=\"car.glb\", camera=\"0 -7 1 0 0 0 30 1\", file=\"car2.iv\", "
      "cameraFile=\"cameraIV.wrl\", "
      "file=\"car3.wrl\", cameraName=\"camera\", numBlendPass=3, position=\"1 2 0\", heading_deg=20)");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  scene::Scene& scene = loaded->scene;
  scene.sky.picture = ImageF(16, 8, 3, 0.1f);
  const auto& drawables = registries_.get<render::Drawables>();
  drawables.attach(scene);
  Result<std::unique_ptr<render::Renderer>> renderer =
      render::Renderer::create(scene, drawables, light::sun_and_sky);
  ASSERT_TRUE(renderer) << to_string(renderer.errors());
  constexpr int size = 96;
  std::vector<vec3> seen;
  for (const float x : {-6.0f, -1.0f, 4.0f}) {
    Camera camera;
    camera.world_from_camera = look_at({x, -5, 1.5f}, {1, 2, 1});
    camera.vertical_fov = 0.5f;
    EXPECT_TRUE(render::draw_frame(**renderer, scene, {camera, size, size}));
    const ImageF drawn = (*renderer)->read_radiance();
    const reference::RayScene rays(scene);
    const shading::SkyLight sky = shading::make_sky_light(scene.sky.picture, 1.0f, 0.0f);
    const reference::ObjectPicture objects = reference::trace_objects(rays, camera, size, size);
    const ImageF traced = reference::trace_picture(rays, scene, sky, camera, size, size, {}).radiance;
    int wrong = 0, count = 0;
    vec3 mean(0.0f);
    for (int y = 1; y + 1 < size; ++y)
      for (int x2 = 1; x2 + 1 < size; ++x2) {
        bool is_inside = true;
        for (int d = 0; d < 9; ++d) is_inside &= *objects.at(x2 + d % 3 - 1, y + d / 3 - 1) != 0;
        if (!is_inside) continue;
        ++count;
        for (int c = 0; c < 3; ++c) {
          mean[c] += drawn.at(x2, y)[c];
          wrong += std::abs(drawn.at(x2, y)[c] - traced.at(x2, y)[c]) > 0.03f * traced.at(x2, y)[c] + 0.02f;
        }
      }
    ASSERT_GT(count, 500);
    EXPECT_LT(100.0 * wrong / (3 * count), 1.0) << x;
    seen.push_back(mean / float(count));
    const auto picked = (*renderer)->pick(camera, size, size, true);
    EXPECT_EQ(*picked.at(size / 2, size / 2), *objects.at(size / 2, size / 2));
  }
  EXPECT_GT(glm::distance(seen[0], seen[2]), 0.2f) << "it looks different from different sides";
}

}  // namespace
}  // namespace parvis::view_dependent_objects
