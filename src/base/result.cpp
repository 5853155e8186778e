#include "base/result.h"

namespace parvis {

std::string to_string(const Error& error) {
  std::string text;
  if (!error.where.file.empty()) text += error.where.file + ":";
  if (error.where.line > 0) text += fmt::format("{}:", error.where.line);
  if (error.where.line > 0 && error.where.column > 0) text += fmt::format("{}:", error.where.column);
  if (!text.empty()) text += " ";
  return text + error.message;
}

std::string to_string(const Errors& errors) {
  std::string text;
  for (const Error& error : errors) text += to_string(error) + "\n";
  return text;
}

}  // namespace parvis
