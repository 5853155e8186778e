#include "planning/share/site_files.h"

#include <zlib.h>

#include "base/files.h"

namespace parvis::share {
namespace fs = std::filesystem;
namespace {

Status expect_empty(const fs::path& folder) {
  std::error_code code;
  if (!fs::exists(folder, code)) return Ok{};
  if (!fs::is_directory(folder, code))
    return error("{}: is there already, and is no folder; name another", folder.string());
  if (!fs::is_empty(folder, code))
    return error("{}: is not empty; name a folder that is absent or empty, so that no file of yours is lost",
                 folder.string());
  return Ok{};
}

Result<std::string> deflated(std::string_view bytes) {
  uLongf size = compressBound(uLong(bytes.size()));
  std::string packed(size, '\0');
  const int code = compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                             reinterpret_cast<const Bytef*>(bytes.data()), uLong(bytes.size()), 9);
  if (code != Z_OK) return error("{} bytes cannot be compressed: memory ends", bytes.size());
  packed.resize(size);
  return packed;
}

}  // namespace

std::string base64(std::string_view bytes) {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? letters[word >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

Result<SiteFiles> SiteFiles::create(const fs::path& folder) {
  if (Status status = expect_empty(folder); !status) return status.errors();
  const fs::path parent = fs::absolute(folder).lexically_normal().parent_path();
  std::error_code code;
  fs::create_directories(parent, code);
  Result<PartialFolder> partial = PartialFolder::create(parent);
  if (!partial) return partial.errors();
  return SiteFiles(folder, *std::move(partial));
}

Status SiteFiles::write(const std::string& name, std::string_view bytes) {
  bytes_ += bytes.size();
  return write_file(partial_.path() / name, bytes);
}

Status SiteFiles::write_part(const std::string& name, std::string_view bytes) {
  const Result<std::string> packed = deflated(bytes);
  if (!packed) return packed.errors();
  return write(name + ".js", fmt::format("parvis_part(\"{}\",\"{}\");\n", name, base64(*packed)));
}

Status SiteFiles::write_json(const std::string& name, const std::string& json) {
  return write(name + ".js", fmt::format("parvis_part(\"{}\",{});\n", name, json));
}

Status SiteFiles::keep() {
  if (Status status = expect_empty(folder_); !status) return status;
  std::error_code code;
  fs::create_directories(folder_, code);
  for (const fs::directory_entry& entry : fs::directory_iterator(partial_.path(), code)) {
    if (code) break;
    fs::rename(entry.path(), folder_ / entry.path().filename(), code);
    if (code) break;
  }
  if (code) return error("{}: cannot be written: {}", folder_.string(), code.message());
  return Ok{};
}

}  // namespace parvis::share
