// Where tests and benches find the shared photographs, cities and cars, which are no part of the repository.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

namespace parvis {

/// The checkout's root folder. Only test programs have it (cmake/test_main.cpp): as a function, since a path
/// among the compile definitions of tests would keep the compiler cache from serving another checkout.
std::filesystem::path source_folder();

/// The path of `relative` below $PARVIS_DATA, or below `../shared/data` beside the checkout `source_folder`;
/// nothing where it is absent: then the test says that it is skipped.
inline std::optional<std::filesystem::path> shared_data(const std::string& relative,
                                                        const std::filesystem::path& source_folder) {
  const char* given = std::getenv("PARVIS_DATA");
  const std::filesystem::path root = given ? std::filesystem::path(given) : source_folder / "../shared/data";
  std::error_code code;
  if (!std::filesystem::exists(root / relative, code)) return std::nullopt;
  return std::filesystem::canonical(root / relative, code);
}

/// The same beside the checkout of the test program.
inline std::optional<std::filesystem::path> shared_data(const std::string& relative) {
  return shared_data(relative, source_folder());
}

}  // namespace parvis
