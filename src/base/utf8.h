// Text of users' files as valid UTF-8.
#pragma once

#include <string>
#include <string_view>

namespace parvis {

/// Whether all bytes are characters of UTF-8 (RFC 3629): no overlong forms, surrogates or codes beyond
/// 0x10ffff.
bool is_utf8(std::string_view text);

/// Replaces each byte that begins no character by U+FFFD, the replacement character.
void repair_utf8(std::string& text);

}  // namespace parvis
