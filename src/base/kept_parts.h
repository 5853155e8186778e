// The one store of results that took long: baked maps, steps of interrupted work, layers of a place. Each
// part is a sealed file (sealed_file.h) in a folder, found again by its name and by a hash of all that it
// depends on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "base/result.h"
#include "base/sealed_file.h"

namespace parvis {

/// Parts of work that goes on where it was interrupted.
inline constexpr SealedKind unfinished_work{"PVPART_1", "part of unfinished work"};

/// Whose folder parts lie in: one that the program made for them alone, where whatever has a part's name may
/// be replaced, or one of the user's, where a file that is no part stays as it is.
enum class FolderOf { program, user };

/// A folder of parts. Nothing is stored, found or removed through a link; several processes may store the
/// same part at the same time.
class KeptParts {
 public:
  /// Stores nothing and finds nothing.
  KeptParts() = default;
  /// Stores parts in `folder`, which the first of them creates; an empty path stores nothing.
  explicit KeptParts(std::filesystem::path folder) : folder_(std::move(folder)) {}
  /// The same of another kind. The texts of `kind` and `extension` must be static.
  KeptParts(std::filesystem::path folder, const SealedKind& kind, std::string_view extension, FolderOf owner)
      : folder_(std::move(folder)), kind_(kind), extension_(extension), owner_(owner) {}

  bool keeps_parts() const { return !folder_.empty(); }            ///< false: no folder
  const std::filesystem::path& folder() const { return folder_; }  ///< empty: none
  std::filesystem::path file(const std::string& part) const;       ///< empty: nothing is stored

  /// The content that was stored under this name and key. None where nothing was, where it is of another key,
  /// and, with a warning that ends with `consequence`, where the file is damaged or a link.
  std::optional<std::string> find(const std::string& part, std::uint64_t key,
                                  std::string_view consequence = "this part is computed again") const;
  /// Stores a part in place of what had its name, completely or not at all. Any thread may. Errors: what the
  /// disk reports; a link, or a file of another kind, lies in its place. What was stored before stays.
  Status keep(const std::string& part, std::uint64_t key, std::string_view content) const;
  /// Removes all parts but the files `kept`. The folder goes, too, where nothing else is in it.
  void remove(const std::set<std::filesystem::path>& kept = {}) const;

 private:
  std::filesystem::path folder_;
  SealedKind kind_ = unfinished_work;
  std::string_view extension_ = ".part";
  FolderOf owner_ = FolderOf::user;
};

}  // namespace parvis
