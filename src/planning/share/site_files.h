// The files of a site while they are written. A page that was opened by a double click may load scripts and
// pictures, but no other files: data are scripts that hand text over.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/partial_file.h"
#include "base/result.h"

namespace parvis::share {

class SiteFiles {
 public:
  /// The site is to be `folder`. Errors: it is there and not empty, or is no folder; its parent cannot be
  /// written to.
  static Result<SiteFiles> create(const std::filesystem::path& folder);

  /// Writes a file of the site; `name` may begin with a folder's.
  Status write(const std::string& name, std::string_view bytes);
  /// Writes `NAME.js`, which hands the bytes to the page as part NAME: deflated, in base 64.
  Status write_part(const std::string& name, std::string_view bytes);
  /// Writes `NAME.js`, which hands the JSON to the page as it is.
  Status write_json(const std::string& name, const std::string& json);
  /// Moves all files to the folder. Errors: it has been filled meanwhile.
  Status keep();

  /// All bytes that were written.
  std::size_t bytes() const { return bytes_; }

 private:
  SiteFiles(std::filesystem::path folder, PartialFolder partial)
      : folder_(std::move(folder)), partial_(std::move(partial)) {}

  std::filesystem::path folder_;
  PartialFolder partial_;
  std::size_t bytes_ = 0;
};

/// Bytes as text of 64 letters.
std::string base64(std::string_view bytes);

}  // namespace parvis::share
