// Any bytes as a captured tree, and as a volume: with the checksum that they lack, so that the checks behind
// it are reached.
#include <filesystem>

#include "base/fuzz_file.h"
#include "base/sealed_file.h"
#include "capture/trees/tree_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static parvis::FuzzFile raw(".tree");
  const std::filesystem::path& file = raw.with(data, size);
  (void)parvis::trees::read_tree(file);
  (void)parvis::trees::read_volume(file);
  const std::string_view content(reinterpret_cast<const char*>(data), size);
  for (const std::string_view magic : {"PVTREE_2", "PVTREE_3"})
    if (parvis::write_sealed(file, {magic, "captured tree"}, content)) (void)parvis::trees::read_tree(file);
  if (parvis::write_sealed(file, {"PVTVOL_2", "tree volume"}, content))
    (void)parvis::trees::read_volume(file);
  return 0;
}
