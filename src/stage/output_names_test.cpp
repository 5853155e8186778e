#include "stage/output_names.h"

#include <gtest/gtest.h>

#include <set>

namespace parvis::stage {
namespace {
namespace fs = std::filesystem;

using Files = std::vector<fs::path>;

TEST(OutputNames, ASeriesIsNamedAfterItsCamerasOrStates) {
  EXPECT_EQ(series_files("out/p.png", '-', {"oaks", "no_oaks"}),
            (Files{"out/p-oaks.png", "out/p-no_oaks.png"}));
  EXPECT_EQ(series_files("p.exr", '_', {"front door", "a/b", "../c", "Plätze", "v1.2"}),
            (Files{"p_front_door.exr", "p_a-b.exr", "p_..-c.exr", "p_Plätze.exr", "p_v1.2.exr"}));
}

TEST(OutputNames, NoTwoShareAFileAndTheRightNameHasItsOwn) {
  EXPECT_EQ(series_files("p.png", '-', {"a/b", "a-b"}), (Files{"p-a-b-2.png", "p-a-b.png"}));
  EXPECT_EQ(series_files("p.png", '-', {"a-b", "a/b"}), (Files{"p-a-b.png", "p-a-b-2.png"}));
  EXPECT_EQ(series_files("p.png", '_', {"a b", "a_b", "a:b", "a_b-2"}),
            (Files{"p_a_b-3.png", "p_a_b.png", "p_a_b-4.png", "p_a_b-2.png"}));
  EXPECT_EQ(series_files("p.png", '_', {"", "", "same", "same"}),
            (Files{"p_.png", "p_-2.png", "p_same.png", "p_same-2.png"}));
}

TEST(OutputNames, LongNamesAreCutAndStayApart) {
  const std::string front(250, 'a');
  const Files files = series_files("out/p.png", '-', {front + "1", front + "2", "short"});
  EXPECT_NE(files[0], files[1]);
  for (const fs::path& file : files) {
    EXPECT_LE(file.filename().string().size(), 255u);
    EXPECT_EQ(file.parent_path(), "out");
    EXPECT_EQ(file.extension(), ".png");
  }
  const fs::path one = fs::path("out") / (front + "1.p"), two = fs::path("out") / (front + "2.p");
  EXPECT_EQ(file_beside("out/p.png", ".checkpoint"), "out/p.png.checkpoint");
  EXPECT_EQ(file_beside(one, ".checkpoint").filename().string().size(), 255u);
  EXPECT_EQ(file_beside(one, ".checkpoint").extension(), ".checkpoint");
  EXPECT_NE(file_beside(one, ".checkpoint"), file_beside(two, ".checkpoint"));
}

}  // namespace
}  // namespace parvis::stage
