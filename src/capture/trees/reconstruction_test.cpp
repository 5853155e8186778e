#include "capture/trees/reconstruction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <filesystem>

#include "base/test_folder.h"
#include "capture/trees/test_volume.h"
#include "machines/test_processes.h"

namespace parvis::trees {
namespace {

using machines::in_two_processes, machines::Processes;

/// A ball whose colour changes with height, photographed from 10 places.
const std::vector<TreeView>& photographs() {
  static const std::vector<TreeView> views = [] {
    const TestVolume ball(27, 0.3f, 20.0f);
    TreeVolume volume{ball.grid, ball.extinction_per_m, {}};
    for (std::size_t i = 0; i < volume.grid.size(); ++i)
      volume.colour.emplace_back(0.8f * (volume.grid.centre(i).z - 0.5f), 0.7f, 0.2f);
    std::vector<TreeView> ring = ball.ring(10, 64);
    for (TreeView& view : ring) view.picture = photograph_of(render_volume(volume, view.camera));
    return ring;
  }();
  return views;
}

ReconstructionOptions options_of(const Processes& processes, int iterations = 8) {
  ReconstructionOptions options;
  options.grid.level = 3, options.opacity.iterations = iterations;
  options.coarse_epochs = 2, options.fine_epochs = 1, options.processes = processes;
  return options;
}

Reconstruction reconstructed(const ReconstructionOptions& options) {
  Result<Reconstruction> result = reconstruct(photographs(), options);
  EXPECT_TRUE(result) << to_string(result.errors());
  return *std::move(result);
}

void expect_same(const Reconstruction& found, const Reconstruction& wanted) {
  EXPECT_EQ(found.volume.grid.cells(), wanted.volume.grid.cells());
  EXPECT_EQ(found.volume.extinction_per_m, wanted.volume.extinction_per_m);
  EXPECT_EQ(found.volume.colour, wanted.volume.colour);
  EXPECT_EQ(found.opacities.extinction_per_m, wanted.opacities.extinction_per_m);
  EXPECT_EQ(found.opacities.mean_change, wanted.opacities.mean_change);
  EXPECT_EQ(found.cutoff, wanted.cutoff);
}

/// The notes without the seconds at their ends.
std::vector<std::string> findings(const Reconstruction& made) {
  std::vector<std::string> result = made.notes;
  for (std::string& note : result) note.resize(note.rfind(": "));
  return result;
}

TEST(Reconstruction, TwoProcessesFindTheTreeOfOne) {
  const Reconstruction one = reconstructed(options_of({}));
  EXPECT_GT(one.volume.grid.size(), 500u);
  for (const Reconstruction& found :
       in_two_processes([](const Processes& process) { return reconstructed(options_of(process)); })) {
    expect_same(found, one);
    EXPECT_EQ(findings(found), findings(one)) << "errors are those of all rows";
  }
  EXPECT_NE(reconstructed(options_of({}, 7)).volume.extinction_per_m, one.volume.extinction_per_m)
      << "the control";
}

TEST(Reconstruction, InterruptedAfterEveryStepItFindsTheSameTree) {
  const TestFolder folder;
  const std::atomic<bool> is_interrupted = true;
  std::vector<TreeView> views;
  for (std::size_t i = 0; i < photographs().size(); i += 2) views.push_back(photographs()[i]);
  ReconstructionOptions options;
  options.grid.level = 2, options.opacity.iterations = 3;
  options.coarse_epochs = 1, options.fine_epochs = 2;
  const Result<Reconstruction> whole = reconstruct(views, options);
  ASSERT_TRUE(whole) << to_string(whole.errors());
  options.is_interrupted = &is_interrupted;
  const Result<Reconstruction> unkept = reconstruct(views, options);
  ASSERT_FALSE(unkept);
  EXPECT_NE(to_string(unkept.errors()).find("interrupted"), std::string::npos);

  options.checkpoint = folder.path() / "steps";
  // The cutoff, each iteration, and each photograph of each pass.
  const std::size_t steps = 1 + 3 + views.size() * (1 + 2);
  for (std::size_t i = 0; i < steps; ++i) {
    const Result<Reconstruction> ended = reconstruct(views, options);
    ASSERT_FALSE(ended) << "after " << i << " interruptions";
    EXPECT_NE(to_string(ended.errors()).find(options.checkpoint.string()), std::string::npos)
        << to_string(ended.errors());
  }
  const Result<Reconstruction> last = reconstruct(views, options);
  ASSERT_TRUE(last) << to_string(last.errors());
  expect_same(*last, *whole);
  EXPECT_NE(last->notes.back().find("steps kept before: 10"), std::string::npos) << last->notes.back();
}

TEST(Reconstruction, WhatWasKeptOfOtherOptionsOrIsDamagedDoesNotCount) {
  const TestFolder folder;
  const auto of_iterations = [&](int iterations, const std::filesystem::path& checkpoint) {
    ReconstructionOptions options = options_of({}, iterations);
    options.grid.level = 2, options.checkpoint = checkpoint;
    options.keeping_interval = std::chrono::seconds(0);
    return reconstructed(options);
  };
  const std::filesystem::path checkpoint = folder.path() / "steps";
  const Reconstruction seven = of_iterations(7, {}), eight = of_iterations(8, {});
  expect_same(of_iterations(8, checkpoint), eight);
  expect_same(of_iterations(7, checkpoint), seven);
  for (const char* part : {"cutoff", "opacity", "colours", "finer"}) {
    const std::filesystem::path file = checkpoint / (std::string(part) + ".part");
    ASSERT_TRUE(std::filesystem::exists(file)) << part;
    std::filesystem::resize_file(file, std::filesystem::file_size(file) - 3);
  }
  expect_same(of_iterations(7, checkpoint), seven);
}

TEST(Reconstruction, WhatCannotBeKeptEndsTheWorkAndLeavesEarlierSteps) {
  const TestFolder folder;
  ReconstructionOptions options;
  options.grid.level = 2, options.opacity.iterations = 3, options.fine_epochs = 0;
  options.checkpoint = folder.path() / "steps";
  folder.write("steps/colours.part", "somebody's own");
  const Result<Reconstruction> ended = reconstruct(photographs(), options);
  ASSERT_FALSE(ended);
  EXPECT_NE(to_string(ended.errors()).find("colours.part"), std::string::npos) << to_string(ended.errors());
  EXPECT_TRUE(std::filesystem::exists(options.checkpoint / "opacity.part"));
  std::filesystem::remove(options.checkpoint / "colours.part");
  const Result<Reconstruction> found = reconstruct(photographs(), options);
  ASSERT_TRUE(found) << to_string(found.errors());
  EXPECT_NE(found->notes[2].find("steps kept before: 3"), std::string::npos) << found->notes[2];
}

TEST(Reconstruction, TwoProcessesGoOnWhereTheFirstOneHasKeptTheWork) {
  const TestFolder folder;
  const std::atomic<bool> is_interrupted = true, is_not_interrupted = false;
  const auto kept_by = [&](const Processes& process) {
    ReconstructionOptions options = options_of(process, 3);
    options.grid.level = 2, options.cutoff = 0.95f, options.coarse_epochs = 1;
    // As of machines that share no disk.
    options.checkpoint = folder.path() / ("of process " + std::to_string(process.rank()));
    return options;
  };
  for (int interruptions = 0; interruptions < 5; ++interruptions)
    for (const bool has_ended : in_two_processes([&](const Processes& process) {
           ReconstructionOptions options = kept_by(process);
           // The signal has reached the second one alone.
           options.is_interrupted = process.rank() == 1 ? &is_interrupted : &is_not_interrupted;
           return !reconstruct(photographs(), options).ok();
         }))
      EXPECT_TRUE(has_ended) << "all end when one of them is interrupted";
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "of process 1"));
  ReconstructionOptions of_one = kept_by({});
  of_one.checkpoint.clear();
  const Reconstruction whole = reconstructed(of_one);
  for (const Reconstruction& found :
       in_two_processes([&](const Processes& process) { return reconstructed(kept_by(process)); })) {
    expect_same(found, whole);
    EXPECT_NE(found.notes[2].find("steps kept before: 3"), std::string::npos) << found.notes[2];
  }
}

TEST(Reconstruction, ThePhotographThatContradictsAllOthersIsNamedAndLeftOutUnlessItIsKept) {
  ReconstructionOptions options;
  options.grid.level = 2, options.coarse_epochs = 1, options.fine_epochs = 0;
  std::vector<TreeView> views = photographs();
  const Result<Reconstruction> of_right_ones = reconstruct(views, options);
  ASSERT_TRUE(of_right_ones) << to_string(of_right_ones.errors());
  EXPECT_EQ(of_right_ones->notes.front().find("contradicts"), std::string::npos);

  views[4].camera.position_in_world += glm::vec3(0.6f, 0.3f, 0.4f);
  const Result<Reconstruction> found = reconstruct(views, options);
  ASSERT_TRUE(found) << to_string(found.errors());
  EXPECT_NE(found->notes[0].find("view 4"), std::string::npos) << found->notes[0];
  EXPECT_NE(found->notes[0].find("left out"), std::string::npos) << found->notes[0];
  EXPECT_NE(found->notes[1].find("9 photographs"), std::string::npos) << found->notes[1];
  std::vector<TreeView> nine = photographs();
  nine.erase(nine.begin() + 4);
  const Result<Reconstruction> of_nine = reconstruct(nine, options);
  ASSERT_TRUE(of_nine) << to_string(of_nine.errors());
  expect_same(*found, *of_nine);

  options.keeps_inconsistent = true;
  const Result<Reconstruction> kept = reconstruct(views, options);
  ASSERT_TRUE(kept) << to_string(kept.errors());
  EXPECT_NE(kept->notes[0].find("view 4"), std::string::npos) << kept->notes[0];
  EXPECT_NE(kept->notes[1].find("10 photographs"), std::string::npos) << kept->notes[1];
  EXPECT_LT(kept->volume.grid.size(), found->volume.grid.size()) << "the wrong one carves the hull";
}

}  // namespace
}  // namespace parvis::trees
