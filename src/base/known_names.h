// The names that exist, for messages about one that does not: the nearest first, and never more than fit on a
// line or two.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace parvis {

/// Insertions, deletions, replacements and swaps of neighbours that turn `a` into `b` (Damerau 1964,
/// restricted), without regard to case.
int edit_distance(std::string_view a, std::string_view b);

/// `; did you mean "NAME"?` for the known name that is near enough to `word`, else nothing. For messages that
/// list all names by themselves.
std::string did_you_mean(std::string_view word, std::span<const std::string> known);

/// The end of a message about a `word` that is no name or matches none: `; there are "quarter", "hill"`,
/// `; did you mean "hill"? There are also "quarter", "lake" and 12 others`, `; there is none`. Each name
/// stands once; those that hold the word come first, then by their edit distance, then in the order given.
/// The word may be a pattern, whose * and ? do not count. Empty names are no names.
std::string names_that_exist(std::string_view word, std::span<const std::string> known);

/// A message about a folder that does not exist: which part of its path is missing, in which folder, and the
/// names of the folders there; hidden ones (".git") are left out. Empty where `folder` exists.
std::string missing_folder(const std::filesystem::path& folder);

}  // namespace parvis
