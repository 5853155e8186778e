// Calibration by COLMAP of photographs whose cameras are known. Skipped where COLMAP is not installed.
#include "capture/photographs/calibrate.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/files.h"
#include "base/image_io.h"
#include "base/test_folder.h"
#include "capture/photographs/program.h"
#include "capture/photographs/set_file.h"
#include "capture/photographs/test_place.h"

namespace parvis::photographs {
namespace {

bool has_colmap(const TestFolder& folder) {
  return bool(run_program({"colmap", "help"}, folder.path() / "help.log", [] {}));
}

TEST(Program, SaysWhatFailed) {
  const TestFolder folder;
  const auto log = folder.path() / "log";
  const Status missing = run_program({"no-such-program-of-ours"}, log, [] {});
  ASSERT_FALSE(missing);
  EXPECT_NE(to_string(missing.errors()).find("cannot be started; install it"), std::string::npos);
  const Status failed = run_program({"ls", "/no/such/folder"}, log, [] {});
  ASSERT_FALSE(failed);
  EXPECT_NE(to_string(failed.errors()).find("No such file"), std::string::npos) << to_string(failed.errors());
  EXPECT_TRUE(run_program({"true"}, log, [] {}));
}

TEST(Calibrate, FindsCamerasAndNamesWhatItCannotUse) {
  const TestFolder folder;
  if (!has_colmap(folder)) GTEST_SKIP() << "colmap is not installed";
  const auto pictures = folder.path() / "pictures";
  std::filesystem::create_directories(pictures);
  const PhotographSet truth = test_photographs(5, 480, 360);
  for (const Photograph& photograph : truth.photographs)
    ASSERT_TRUE(write_image(pictures / photograph.name, test_picture(photograph, 1)));
  ASSERT_TRUE(write_image(pictures / "elsewhere.png", test_picture(truth.photographs[0], 77)));
  folder.write("pictures/damaged.jpg", "\xff\xd8\xff\xe0 and no more");
  CalibrationJob job;
  job.pictures = pictures;
  job.folder = folder.path() / "out";
  job.max_features = 1500;
  job.distance = {
      "place_0.png", "place_4.png",
      glm::distance(truth.photographs[0].position_in_world(), truth.photographs[4].position_in_world())};
  const auto calibrated = calibrate(job);
  ASSERT_TRUE(calibrated) << to_string(calibrated.errors());
  const std::string problems = to_string(calibrated->problems);
  EXPECT_NE(problems.find("damaged.jpg"), std::string::npos) << problems;
  EXPECT_NE(problems.find("elsewhere.png: no camera was found: it has nothing in common"), std::string::npos)
      << problems;
  ASSERT_EQ(calibrated->set.photographs.size(), 5u) << problems;
  for (const Photograph& photograph : calibrated->set.photographs) {
    EXPECT_GT(photograph.reprojection_error_px, 0.0);
    EXPECT_LT(photograph.reprojection_error_px, 1.0);
  }
  // All distances between cameras, as truth has them: the frame's heading and origin are free.
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const auto distance = [&](const PhotographSet& set) {
        return glm::distance(set.photographs[i].position_in_world(), set.photographs[j].position_in_world());
      };
      EXPECT_NEAR(distance(calibrated->set), distance(truth), 0.1) << i << ", " << j;
    }
  // A second run takes over what is there, with what somebody has added, and the folder reads back.
  PhotographSet masked = calibrated->set;
  masked.photographs[1].mask = job.folder / "masks" / "1.png";
  masked.photographs[2].gain = {1.25, 1.0, 0.75};
  const MasksAndGains of_others{{"elsewhere.png", {job.folder / "masks" / "e.png", {1.0, 2.0, 3.0}}}};
  ASSERT_TRUE(write_photograph_set(job.folder, masked, job.pictures, of_others));
  const auto again = calibrate(job);
  ASSERT_TRUE(again) << to_string(again.errors());
  EXPECT_EQ(again->set.points.size(), calibrated->set.points.size());
  const auto kept = read_photograph_set(job.folder);
  ASSERT_TRUE(kept) << to_string(kept.errors());
  EXPECT_EQ(kept->set.photographs.size(), 5u);
  EXPECT_EQ(kept->set.photographs[1].mask, job.folder / "masks" / "1.png");
  EXPECT_EQ(kept->set.photographs[2].gain, glm::dvec3(1.25, 1.0, 0.75));
  const auto given = read_masks_and_gains(job.folder);
  ASSERT_TRUE(given) << to_string(given.errors());
  ASSERT_TRUE(given->contains("elsewhere.png")) << "it has no camera, and may have one later";
  EXPECT_EQ(given->at("elsewhere.png").mask, job.folder / "masks" / "e.png");
  EXPECT_EQ(given->at("elsewhere.png").gain, glm::dvec3(1.0, 2.0, 3.0));
  EXPECT_GT(calibration_report(kept->set).size(), 200u);
}

/// Photographs of the test place in a folder; the third one is larger where `one_differs`.
std::filesystem::path written_photographs(const TestFolder& folder, int count, bool one_differs) {
  const auto pictures = folder.path() / "pictures";
  std::filesystem::create_directories(pictures);
  PhotographSet set = test_photographs(count, 480, 360);
  if (one_differs) set.photographs[2] = test_photographs(count, 600, 450).photographs[2];
  for (const Photograph& photograph : set.photographs)
    EXPECT_TRUE(write_image(pictures / photograph.name, test_picture(photograph, 1)));
  return pictures;
}

TEST(Calibrate, APhotographOfAnotherSizeHasALensOfItsOwn) {
  const TestFolder folder;
  if (!has_colmap(folder)) GTEST_SKIP() << "colmap is not installed";
  CalibrationJob job;
  job.pictures = written_photographs(folder, 5, true);
  job.folder = folder.path() / "out";
  job.max_features = 1500;
  const auto calibrated = calibrate(job);
  ASSERT_TRUE(calibrated) << to_string(calibrated.errors());
  ASSERT_EQ(calibrated->set.photographs.size(), 5u) << to_string(calibrated->problems);
  const double shared = focal_px(calibrated->set.photographs[0].lens).x;
  for (const Photograph& photograph : calibrated->set.photographs) {
    const double focal = focal_px(photograph.lens).x;
    if (photograph.name == "place_2.png")
      EXPECT_NEAR(focal / shared, 600.0 / 480.0, 0.02 * 600.0 / 480.0);
    else
      EXPECT_EQ(focal, shared) << photograph.name;
  }
}

TEST(Calibrate, TheSamePhotographsGiveTheSameCameras) {
  const TestFolder folder;
  if (!has_colmap(folder)) GTEST_SKIP() << "colmap is not installed";
  CalibrationJob job;
  job.pictures = written_photographs(folder, 6, false);
  job.max_features = 1500;
  std::vector<std::string> written;
  for (const char* name : {"once", "twice"}) {
    job.folder = folder.path() / name;
    const auto calibrated = calibrate(job);
    ASSERT_TRUE(calibrated) << to_string(calibrated.errors());
    for (const char* file : {"cameras.bin", "images.bin", "points3D.bin"}) {
      const auto bytes = read_file(job.folder / file);
      ASSERT_TRUE(bytes) << to_string(bytes.errors());
      written.push_back(*bytes);
    }
  }
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(written[i], written[i + 3]) << i;
}

TEST(Calibrate, KeepsAFileOfMasksThatCannotBeRead) {
  const TestFolder folder;
  const auto pictures = folder.path() / "pictures", file = folder.path() / "out" / "photographs.json";
  std::filesystem::create_directories(pictures);
  for (const Photograph& photograph : test_photographs(2, 80, 60).photographs)
    ASSERT_TRUE(write_image(pictures / photograph.name, test_picture(photograph, 1)));
  CalibrationJob job;
  job.pictures = pictures;
  job.folder = folder.path() / "out";
  const std::string begin =
      "{\"pictures\": \"../pictures\",\n \"photographs\": [\n  {\"name\": \"a.jpg\"},\n  ";
  const std::pair<std::string, std::string> slips[] = {
      {begin + "{\"name\": \"b.jpg\" \"mask\": \"b.png\"}]}", ":4:25: this is no JSON"},  // a comma lacks
      {begin + "{\"name\": \"b.jpg\", \"gain\": [1.2, 1.0]}]}", ":4:12: expected a name and three gains"},
      {begin + "{\"name\": \"b.jpg\", \"gain\": [1.2, 1.0, \"1\"]}]}", ":4:12: expected a name"},
      {begin + "{\"name\": \"b.jpg\", \"mask\": 7}]}", ":4:12: expected the path of a picture"},
      {begin + "{\"name\": \"b.jpg\", \"mask\": \"/etc/b.png\"}]}", "/etc/b.png: a mask outside"},
      {"", ":1:1: this is no JSON"},
  };
  for (const auto& [text, message] : slips) {
    folder.write("out/photographs.json", text);
    const auto calibrated = calibrate(job);
    ASSERT_FALSE(calibrated) << text;
    const std::string errors = to_string(calibrated.errors());
    EXPECT_NE(errors.find(message), std::string::npos) << errors;
    EXPECT_NE(errors.find(file.string() + ": its masks and gains would be lost"), std::string::npos)
        << errors;
    const auto kept = read_file(file);
    ASSERT_TRUE(kept);
    EXPECT_EQ(*kept, text);
    EXPECT_FALSE(std::filesystem::exists(job.folder / "colmap")) << "before any work";
  }
}

TEST(Calibrate, TwoPlacesAreDistinguished) {
  const TestFolder folder;
  if (!has_colmap(folder)) GTEST_SKIP() << "colmap is not installed";
  const auto pictures = folder.path() / "pictures";
  std::filesystem::create_directories(pictures);
  const PhotographSet truth = test_photographs(2, 320, 240);
  ASSERT_TRUE(write_image(pictures / "here.png", test_picture(truth.photographs[0], 1)));
  ASSERT_TRUE(write_image(pictures / "there.png", test_picture(truth.photographs[1], 99)));
  CalibrationJob job;
  job.pictures = pictures;
  job.folder = folder.path() / "out";
  job.max_features = 800;
  const auto calibrated = calibrate(job);
  ASSERT_FALSE(calibrated);
  const std::string errors = to_string(calibrated.errors());
  EXPECT_NE(errors.find("no two photographs show one place"), std::string::npos) << errors;
  EXPECT_NE(errors.find("here.png: no camera was found"), std::string::npos) << errors;
  EXPECT_NE(errors.find("there.png: no camera was found"), std::string::npos) << errors;
}

}  // namespace
}  // namespace parvis::photographs
