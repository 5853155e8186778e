#include "graphics/gl/context.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "graphics/gl/objects.h"
#include "graphics/gl/test_context.h"

namespace parvis::gl {
namespace {

class ContextOfTest : public ContextTest {};

TEST_F(ContextOfTest, IsOfVersion45OrLater) {
  EXPECT_TRUE(check_current());
  EXPECT_FALSE(driver_name().empty());
}

TEST_F(ContextOfTest, OwnersHandTheirNamesOn) {
  Buffer first = Buffer::create();
  const GLuint name = first.name();
  Buffer second = std::move(first);
  EXPECT_EQ(first.name(), 0u);
  EXPECT_EQ(second.name(), name);
  {
    const Buffer last = std::move(second);
    EXPECT_TRUE(glIsBuffer(name));
  }
  EXPECT_FALSE(glIsBuffer(name));
}

/// Prints on standard error the answer to a driver of OpenGL 3.3, and exits. Only Mesa can imitate an older
/// driver.
[[noreturn]] void start_on_an_old_driver() {
  setenv("MESA_GL_VERSION_OVERRIDE", "3.3", 1);
  const Result<Context> context = Context::create_headless();
  const bool is_mesa = !context || is_software();
  fmt::print(stderr, "{}\n", context ? "4.5 of a GPU" : to_string(context.errors()));
  std::exit(context && is_mesa ? 1 : 0);
}

TEST(OldDriver, IsRefusedWithItsVersionAndTheOneThatIsNeeded) {
  ::testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_EXIT(start_on_an_old_driver(), ::testing::ExitedWithCode(0),
              "offers OpenGL 3\\.3 .*needs OpenGL 4\\.5|4\\.5 of a GPU");
}

}  // namespace
}  // namespace parvis::gl
