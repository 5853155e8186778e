#include "viewer/screenshots.h"

#include <algorithm>
#include <charconv>
#include <cstdio>

namespace parvis::viewer {
namespace {
namespace fs = std::filesystem;

/// The number of "NAME-0012.png"; 0 of any other file.
int number_of(const std::string& file, const std::string& name) {
  constexpr int max_number = 999'999;
  const std::string prefix = name + "-";
  if (!file.starts_with(prefix)) return 0;
  int number = 0;
  const char* end = file.data() + file.size();
  const auto read = std::from_chars(file.data() + prefix.size(), end, number);
  const bool is_number = read.ec == std::errc() && std::string_view(read.ptr, end) == ".png";
  return is_number && number <= max_number ? std::max(number, 0) : 0;
}

int highest_number(const fs::path& folder, const std::string& name) {
  int highest = 0;
  std::error_code failed;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, failed))
    highest = std::max(highest, number_of(entry.path().filename().string(), name));
  return highest;
}

/// Makes an empty file of that name; false where there is one.
bool reserve(const fs::path& file) {
  std::FILE* made = std::fopen(file.c_str(), "wx");
  return made && std::fclose(made) == 0;
}

}  // namespace

Result<fs::path> write_numbered(const fs::path& folder, const std::string& name,
                                const std::function<Status(const fs::path&)>& write) {
  constexpr int tries = 100;  // as many others may take numbers at the same moment
  std::error_code failed;
  fs::create_directories(folder, failed);
  const int first = highest_number(folder, name) + 1;
  for (int number = first; number < first + tries; ++number) {
    const fs::path file = folder / fmt::format("{}-{:04}.png", name, number);
    if (!reserve(file)) {
      if (fs::exists(file, failed)) continue;
      break;
    }
    if (Status status = write(file); !status) {
      fs::remove(file, failed);
      return status.errors();
    }
    return file;
  }
  return error("no picture can be written into {}: choose another folder by --output", folder.string());
}

}  // namespace parvis::viewer
