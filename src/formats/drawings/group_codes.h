// The groups of a DXF file: a code and a value each, from its text form or its binary form.
#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace parvis::formats {

/// A group of a DXF file.
struct Group {
  int code = 0;
  std::string_view value;  ///< without the line's end; numbers of binary files as text
  int line = 0;            ///< of the value in a text file; in a binary file the number of the group
};

/// All groups of a file in their order.
struct GroupCodes {
  std::vector<Group> groups;
  std::deque<std::string> made;  ///< values that the file does not hold as text
  bool is_binary = false;
};

/// Whether a file begins as DXF, in either form.
bool looks_like_dxf(std::string_view front);

/// `bytes` must outlive the groups. Errors at `file`: neither form; a code that is no number; a value that is
/// cut off; an end without EOF: the file was cut.
Result<GroupCodes> group_codes(std::string_view bytes, const std::string& file);

/// Puts text in the place of a value; the old one stays valid.
void replace_value(GroupCodes& codes, std::size_t group, std::string text);

/// The groups as a text file.
std::string as_text(const GroupCodes& codes);

/// The number that a value spells; `fallback` where it spells none, or one that is not finite.
double number_of(std::string_view value, double fallback = 0.0);
/// The same of whole numbers.
int integer_of(std::string_view value, int fallback = 0);

}  // namespace parvis::formats
