// Text as IFC++ holds it.
#pragma once

#include <string>

namespace parvis::scene {

/// The same in UTF-8.
std::string utf8(const std::wstring& text);

}  // namespace parvis::scene
