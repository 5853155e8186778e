// The Khronos validator, for tests of what Parvis writes.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>

#include "base/test_data.h"

namespace parvis::scene {

/// Expects that the validator finds no error in the .glb files of a folder. Where it cannot be had
/// (script/validate_gltf says why) the test is skipped by name, and goes on.
inline void expect_valid_gltf(const std::filesystem::path& folder) {
  constexpr int skipped = 77;  // the script's
  const std::string script = (source_folder() / "script" / "validate_gltf").string();
  const int status = std::system(("'" + script + "' '" + folder.string() + "'/*.glb").c_str());
  if (WIFEXITED(status) && WEXITSTATUS(status) == skipped)
    GTEST_SKIP() << "skipped: the Khronos validator is not here";
  EXPECT_EQ(status, 0);
}

}  // namespace parvis::scene
