#include "base/module.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "base/image_io.h"
#include "base/isolated_process.h"
#include "base/test_folder.h"

namespace parvis {
namespace {

struct NoFunctions {};
constexpr Module<NoFunctions> absent("absent");

Status ask_for_absent(std::string_view, IsolatedOutput&) {
  const Result<const NoFunctions*> functions = absent.functions();
  return functions ? Status(Ok{}) : functions.errors();
}

std::string mapped_files() {
  std::ostringstream text;
  text << std::ifstream("/proc/self/maps").rdbuf();
  return text.str();
}

TEST(Module, OneThatIsMissingIsAnErrorThatNamesItsFile) {
  for (int asked = 0; asked < 2; ++asked) {
    const Result<const NoFunctions*> functions = absent.functions();
    ASSERT_FALSE(functions);
    EXPECT_NE(to_string(functions.errors()).find("parvis_absent.so"), std::string::npos)
        << to_string(functions.errors());
  }
}

TEST(Module, WorkersReportOneThatIsMissing) {
  const std::uint64_t before = begun_workers();
  const Result<IsolatedBytes> made = run_isolated(ask_for_absent, "", "car.obj");
  ASSERT_FALSE(made);
  EXPECT_NE(to_string(made.errors()).find("parvis_absent.so"), std::string::npos) << to_string(made.errors());
  EXPECT_EQ(begun_workers(), before + 2) << "one that asks, and one that has the answer";
  EXPECT_FALSE(run_isolated(ask_for_absent, "", "car.obj"));
  EXPECT_EQ(begun_workers(), before + 3) << "the server knows";
}

TEST(Module, LibrariesOfPicturesStayOutOfTheProgram) {
  const TestFolder folder;
  ASSERT_TRUE(write_image(folder.path() / "p.png", Image8(5, 4, 3, 120)));
  ASSERT_TRUE(read_image8(folder.path() / "p.png"));
  EXPECT_NE(mapped_files().find("libparvis_base"), std::string::npos);
  EXPECT_EQ(mapped_files().find("libOpenImageIO"), std::string::npos);
}

}  // namespace
}  // namespace parvis
