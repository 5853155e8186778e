// The names by which scripts of the thesis (appendix A) call node types.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace parvis::scene {

/// The class of a node type as the thesis's scripts may write it (appendix A): xpShadowMap for shadowMap.
std::string thesis_class(std::string_view type);
/// How references and messages name the one node of a unique type: "%TYPE", of both spellings.
std::array<std::string, 2> unique_names(std::string_view type);

}  // namespace parvis::scene
