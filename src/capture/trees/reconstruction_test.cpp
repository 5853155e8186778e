#include "capture/trees/reconstruction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <barrier>
#include <thread>

#include "capture/trees/test_volume.h"

namespace parvis::trees {
namespace {

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

Reconstruction reconstructed(const Processes& processes, int iterations = 8) {
  ReconstructionOptions options;
  options.grid.level = 3, options.opacity.iterations = iterations;
  options.coarse_epochs = 2, options.fine_epochs = 1, options.processes = processes;
  Result<Reconstruction> result = reconstruct(photographs(), options);
  EXPECT_TRUE(result) << to_string(result.errors());
  return *std::move(result);
}

/// Two threads in the place of two processes: each waits for the other's sums.
class Meeting {
 public:
  Processes process(int rank) {
    return {rank, 2, [this, rank](std::span<double> sums) {
              sums_[std::size_t(rank)] = sums;
              barrier_.arrive_and_wait();
              std::vector<double> all(sums.size());
              for (std::size_t i = 0; i < all.size(); ++i) all[i] = sums_[0][i] + sums_[1][i];
              barrier_.arrive_and_wait();
              std::ranges::copy(all, sums.begin());
            }};
  }

 private:
  std::barrier<> barrier_{2};
  std::array<std::span<double>, 2> sums_;
};

TEST(Reconstruction, TwoProcessesFindTheTreeOfOne) {
  const Reconstruction one = reconstructed({});
  Meeting meeting;
  std::array<Reconstruction, 2> two;
  {
    std::jthread other([&] { two[1] = reconstructed(meeting.process(1)); });
    two[0] = reconstructed(meeting.process(0));
  }
  EXPECT_GT(one.volume.grid.size(), 500u);
  for (const Reconstruction& found : two) {
    EXPECT_EQ(found.volume.grid.cells(), one.volume.grid.cells());
    EXPECT_EQ(found.volume.extinction_per_m, one.volume.extinction_per_m);
    EXPECT_EQ(found.volume.colour, one.volume.colour);
    EXPECT_EQ(found.opacities.extinction_per_m, one.opacities.extinction_per_m);
  }
  EXPECT_NE(reconstructed({}, 7).volume.extinction_per_m, one.volume.extinction_per_m) << "the control";
}

TEST(Reconstruction, ThePhotographThatContradictsAllOthersIsNamedOrLeftOut) {
  std::vector<TreeView> views = photographs();
  views[4].camera.position_in_world += glm::vec3(0.6f, 0.3f, 0.4f);
  ReconstructionOptions options;
  options.grid.level = 2, options.coarse_epochs = 1, options.fine_epochs = 0;
  const Result<Reconstruction> refused = reconstruct(views, options);
  ASSERT_FALSE(refused);
  EXPECT_NE(to_string(refused.errors()).find("view 4"), std::string::npos) << to_string(refused.errors());
  options.leaves_out_inconsistent = true;
  const Result<Reconstruction> found = reconstruct(views, options);
  ASSERT_TRUE(found) << to_string(found.errors());
  EXPECT_NE(found->notes.front().find("view 4"), std::string::npos) << found->notes.front();
}

}  // namespace
}  // namespace parvis::trees
