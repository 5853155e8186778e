// An OpenGL context for tests. Where there is none they are skipped, unless PARVIS_REQUIRE_GL is set
// (script/test).
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>

#include "graphics/gl/context.h"

namespace parvis::gl {

class ContextTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    Result<Context> made = Context::create_headless();
    if (made) context_ = std::make_unique<Context>(*std::move(made));
  }
  static void TearDownTestSuite() { context_.reset(); }
  void SetUp() override {
    if (context_) return;
    ASSERT_EQ(std::getenv("PARVIS_REQUIRE_GL"), nullptr) << "no OpenGL 4.5 here";
    GTEST_SKIP() << "skipped: no OpenGL 4.5 here";
  }

 private:
  static inline std::unique_ptr<Context> context_;
};

}  // namespace parvis::gl
