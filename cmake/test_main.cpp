// The main function of every room's tests. As in the program, the server of isolated readers is forked before
// there are threads: a child forked later may inherit the allocator's locks, which sanitizers do not free.
#include <gtest/gtest.h>

#include "base/isolated_process.h"
#include "base/test_data.h"

std::filesystem::path parvis::source_folder() { return PARVIS_SOURCE_DIR; }

int main(int count, char** arguments) {
  testing::InitGoogleTest(&count, arguments);
  parvis::start_isolation();
  return RUN_ALL_TESTS();
}
