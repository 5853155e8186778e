// COLMAP's models: text and binary, into sets and back; hostile and damaged files.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "base/test_data.h"
#include "base/test_folder.h"
#include "capture/photographs/colmap_set.h"

namespace parvis::photographs {
namespace {

/// Two photographs of one lens and a third of another, with points that they share.
PhotographSet example() {
  PhotographSet set;
  for (int i = 0; i < 3; ++i) {
    Camera camera;
    camera.world_from_camera = look_at({float(3 * i), -10.0f, 2.0f}, {1.0f, 0.0f, 3.0f});
    camera.vertical_fov = 0.9f;
    set.photographs.push_back(photograph_of(camera, fmt::format("day 1/{}.jpg", i), 800, 600));
  }
  set.photographs[2].lens = {LensModel::opencv, 640, 480, {500, 510, 320, 240, -0.1, 0.02, 0.001, -0.001}};
  for (int p = 0; p < 20; ++p) {
    SparsePoint point;
    point.position_in_world = {0.3 * p - 2.0, 0.1 * p, 1.0 + 0.2 * p};
    point.colour = glm::u8vec3(10 * p, 255 - p, p);
    for (int i = 0; i < 3; ++i)
      if (const auto pixel = pixel_of_world(set.photographs[std::size_t(i)], point.position_in_world))
        point.observations.push_back({i, *pixel + glm::dvec2(0.3, -0.4)});
    set.points.push_back(std::move(point));
  }
  return set;
}

void expect_equal(const PhotographSet& a, const PhotographSet& b) {
  ASSERT_EQ(a.photographs.size(), b.photographs.size());
  for (std::size_t i = 0; i < a.photographs.size(); ++i) {
    EXPECT_EQ(a.photographs[i].name, b.photographs[i].name);
    EXPECT_EQ(a.photographs[i].lens, b.photographs[i].lens);
    for (int column = 0; column < 4; ++column)
      EXPECT_LT(glm::distance(a.photographs[i].world_from_camera[column],
                              b.photographs[i].world_from_camera[column]),
                1e-6);
  }
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t p = 0; p < a.points.size(); ++p) {
    EXPECT_EQ(a.points[p].position_in_world, b.points[p].position_in_world);
    EXPECT_EQ(a.points[p].colour, b.points[p].colour);
    ASSERT_EQ(a.points[p].observations.size(), b.points[p].observations.size());
    for (std::size_t k = 0; k < a.points[p].observations.size(); ++k) {
      EXPECT_EQ(a.points[p].observations[k].photograph, b.points[p].observations[k].photograph);
      EXPECT_EQ(a.points[p].observations[k].pixel, b.points[p].observations[k].pixel);
    }
  }
}

TEST(Colmap, TextAndBinaryKeepASet) {
  const PhotographSet set = example();
  for (const ColmapFormat format : {ColmapFormat::text, ColmapFormat::binary}) {
    const TestFolder folder;
    const Status written = write_colmap_model(folder.path(), colmap_model_of(set), format);
    ASSERT_TRUE(written) << to_string(written.errors());
    const auto model = read_colmap_model(folder.path());
    ASSERT_TRUE(model) << to_string(model.errors());
    EXPECT_EQ(model->cameras.size(), 2u) << "equal lenses share a camera";
    const LoadedSet loaded = photograph_set_of(*model, "pictures");
    EXPECT_TRUE(loaded.problems.empty()) << to_string(loaded.problems);
    expect_equal(set, loaded.set);
    EXPECT_EQ(loaded.set.photographs[1].file, std::filesystem::path("pictures/day 1/1.jpg"));
    for (const Photograph& photograph : loaded.set.photographs)
      EXPECT_NEAR(photograph.reprojection_error_px, 0.5, 1e-4)
          << "moved by (.3, -.4); house cameras are rigid to a float";
  }
}

TEST(Colmap, EveryLensModelIsKept) {
  for (const LensModelInfo& lens_model : lens_models()) {
    ColmapModel model;
    Lens lens{lens_model.model, 100, 80, {}};
    for (int i = 0; i < lens_model.parameter_count; ++i) lens.parameters[std::size_t(i)] = 0.1 * (i + 1);
    model.cameras.emplace(7, lens);
    const auto text = parse_colmap_text(colmap_text(model), "");
    const auto binary = parse_colmap_binary(colmap_binary(model), "");
    ASSERT_TRUE(text && binary) << lens_model.name;
    EXPECT_EQ(text->cameras.at(7), lens);
    EXPECT_EQ(binary->cameras.at(7), lens);
  }
}

TEST(Colmap, WhatIsMissingIsNamedAndTheRestGoesOn) {
  ColmapModel model = colmap_model_of(example());
  model.images[0].camera_id = 99;
  model.images[1].rotation_wxyz = glm::dvec4(0.0);
  model.cameras[50] = pinhole_lens(10, 10, 5, 5, 5, 5);
  const LoadedSet loaded = photograph_set_of(model, "");
  ASSERT_EQ(loaded.set.photographs.size(), 1u);
  EXPECT_EQ(loaded.set.photographs[0].name, "day 1/2.jpg");
  for (const SparsePoint& point : loaded.set.points)
    for (const Observation& observation : point.observations) EXPECT_EQ(observation.photograph, 0);
  const std::string problems = to_string(loaded.problems);
  EXPECT_NE(problems.find("day 1/0.jpg: has no camera: the model has none with the number 99"),
            std::string::npos)
      << problems;
  EXPECT_NE(problems.find("day 1/1.jpg: its pose"), std::string::npos) << problems;
  EXPECT_NE(problems.find("camera 50: no photograph"), std::string::npos) << problems;
}

TEST(Colmap, NamesMayNotLeadOutOfTheFolder) {
  ColmapModel model = colmap_model_of(example());
  model.images[0].name = "../../etc/passwd";
  model.images[1].name = "/etc/passwd";
  model.images[2].name = "a/../../b";
  const LoadedSet loaded = photograph_set_of(model, "pictures");
  EXPECT_TRUE(loaded.set.photographs.empty());
  EXPECT_EQ(loaded.problems.size(), 5u) << "three names, and two cameras that are left over";
}

TEST(Colmap, TextErrorsNameTheLine) {
  const ColmapFiles files{
      "# a comment\n1 PINHOLE 100 100 50 50 50\n2 NEW_MODEL 1 1 1\n3 PINHOLE 10 10 5 5 5 5\n",
      "1 1 0 0 0 0 0 0 3 a.jpg\n1 2 x\n", "1 0 0 0 300 0 0 0.5\n"};
  const auto model = parse_colmap_text(files, "m");
  ASSERT_FALSE(model);
  const std::string problems = to_string(model.errors());
  EXPECT_NE(problems.find("m/cameras.txt:2: PINHOLE takes 4 parameters: fx, fy, cx, cy"), std::string::npos)
      << problems;
  EXPECT_NE(problems.find("m/cameras.txt:3: camera model \"NEW_MODEL\""), std::string::npos) << problems;
  EXPECT_NE(problems.find("m/images.txt:2:"), std::string::npos) << problems;
  EXPECT_NE(problems.find("m/points3D.txt:1:"), std::string::npos) << problems;
}

TEST(Colmap, FilesCutAnywhereAreErrors) {
  const ColmapFiles whole = colmap_binary(colmap_model_of(example()));
  for (std::size_t size = 0; size < whole.images.size(); size += 7) {
    ColmapFiles cut = whole;
    cut.images.resize(size);
    EXPECT_FALSE(parse_colmap_binary(cut, "")) << size;
  }
  for (std::size_t size = 0; size < whole.points.size(); ++size) {
    ColmapFiles cut = whole;
    cut.points.resize(size);
    EXPECT_FALSE(parse_colmap_binary(cut, "")) << size;
  }
}

TEST(Colmap, HugeCountsTakeNoMemory) {
  ColmapFiles files = colmap_binary(colmap_model_of(example()));
  for (std::string* file : {&files.cameras, &files.images, &files.points}) {
    const std::string kept = *file;
    for (int i = 0; i < 8; ++i) (*file)[std::size_t(i)] = '\x7f';
    EXPECT_FALSE(parse_colmap_binary(files, ""));
    *file = kept;
  }
  EXPECT_TRUE(parse_colmap_binary(files, ""));
}

TEST(Colmap, ReadsTheCourtyard) {
  const auto folder = shared_data("photos_castle_p30");
  if (!folder) GTEST_SKIP() << "photos_castle_p30 is not there";
  const auto model = read_colmap_model(*folder / "colmap");
  ASSERT_TRUE(model) << to_string(model.errors());
  const LoadedSet loaded = photograph_set_of(*model, *folder / "images");
  EXPECT_TRUE(loaded.problems.empty()) << to_string(loaded.problems);
  EXPECT_EQ(loaded.set.photographs.size(), 30u);
  EXPECT_EQ(loaded.set.points.size(), 17095u) << "ORIGIN.txt";
  double seen_inside = 0.0;  // its points have no tracks, but each lies in some picture
  for (const SparsePoint& point : loaded.set.points)
    seen_inside += std::ranges::any_of(loaded.set.photographs, [&](const Photograph& photograph) {
      const auto pixel = pixel_of_world(photograph, point.position_in_world);
      return pixel && is_inside(photograph.lens, *pixel);
    });
  EXPECT_EQ(seen_inside, double(loaded.set.points.size()));
}

}  // namespace
}  // namespace parvis::photographs
