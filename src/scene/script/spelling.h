// "Did you mean": the known name nearest to a misspelt one.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

namespace parvis::scene {

/// Insertions, deletions, replacements and swaps of neighbours that turn `a` into `b` (Damerau 1964,
/// restricted), without regard to case.
int edit_distance(std::string_view a, std::string_view b);

/// `; did you mean "NAME"?` for the known name that is near enough to `word`, else nothing.
std::string did_you_mean(std::string_view word, std::span<const std::string> known);

/// The class of a node type as the thesis's scripts may write it (appendix A): xpShadowMap for shadowMap.
std::string thesis_class(std::string_view type);
/// How references and messages name the one node of a unique type: "%TYPE", of both spellings.
std::array<std::string, 2> unique_names(std::string_view type);

}  // namespace parvis::scene
