#include "capture/photographs/colmap_model.h"

#include <filesystem>

#include "base/file_set.h"
#include "base/files.h"

namespace parvis::photographs {
namespace {
namespace fs = std::filesystem;

Result<ColmapFiles> read_files(const fs::path& folder, const std::string& extension) {
  ColmapFiles files;
  for (const auto& [stem, text] :
       {std::pair{"cameras", &files.cameras}, {"images", &files.images}, {"points3D", &files.points}}) {
    Result<std::string> read = read_file(folder / (stem + extension));
    if (!read) return read.errors();
    *text = std::move(*read);
  }
  return files;
}

bool has_model(const fs::path& folder, const std::string& extension) {
  std::error_code ignored;
  return fs::is_regular_file(folder / ("cameras" + extension), ignored) &&
         fs::is_regular_file(folder / ("images" + extension), ignored);
}

}  // namespace

Result<ColmapModel> read_colmap_model(const fs::path& folder) {
  const bool is_binary = has_model(folder, ".bin");
  if (!is_binary && !has_model(folder, ".txt"))
    return error("{}: holds no COLMAP model; expected cameras, images and points3D, all .bin or all .txt",
                 folder.string());
  const Result<ColmapFiles> files = read_files(folder, is_binary ? ".bin" : ".txt");
  if (!files) return files.errors();
  return is_binary ? parse_colmap_binary(*files, folder) : parse_colmap_text(*files, folder);
}

Status write_colmap_model(const fs::path& folder, const ColmapModel& model, ColmapFormat format) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (code) return error("{}: cannot be made ({})", folder.string(), code.message());
  const bool is_binary = format == ColmapFormat::binary;
  const ColmapFiles files = is_binary ? colmap_binary(model) : colmap_text(model);
  const std::string extension = is_binary ? ".bin" : ".txt";
  return write_together({{folder / ("cameras" + extension), files.cameras},
                         {folder / ("images" + extension), files.images},
                         {folder / ("points3D" + extension), files.points}});
}

}  // namespace parvis::photographs
