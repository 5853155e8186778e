#include "scene/script/script_format.h"

#include <fmt/format.h>

#include <algorithm>

namespace parvis::scene {
namespace {

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) switch (c) {
      case '"':
        result += "\\\"";
        break;
      case '\\':
        result += "\\\\";
        break;
      case '\n':
        result += "\\n";
        break;
      case '\t':
        result += "\\t";
        break;
      default:
        result += c;
    }
  return fmt::format("\"{}\"", result);
}

bool is_word(const std::string& text) {
  return !text.empty() && text.find_first_of(" \t\r\n(){}=,\"#") == std::string::npos &&
         text.find("//") == std::string::npos;
}

/// The value's written pieces, quoted.
std::vector<std::string> pieces_of(const ScriptAttribute& attribute) {
  std::vector<std::string> pieces;
  std::size_t start = 0;
  for (const std::size_t joint : attribute.joints) {
    pieces.push_back(escaped(std::string_view(attribute.value).substr(start, joint - start)));
    start = joint;
  }
  pieces.push_back(escaped(std::string_view(attribute.value).substr(start)));
  return pieces;
}

bool has_comment(const std::vector<std::string>& comments) {
  return std::any_of(comments.begin(), comments.end(), [](const std::string& each) { return !each.empty(); });
}

class Formatter {
 public:
  std::string file(const ScriptNode& root) {
    lines(root.comments_before, 0);
    nodes(root.children, 0);
    lines(root.comments_at_end, 0);
    while (text_.ends_with("\n\n")) text_.pop_back();
    return std::move(text_);
  }

 private:
  static std::string indent(std::size_t depth) { return std::string(2 * depth, ' '); }

  /// An empty one is a blank line, unless it would stand first in the file or in its block, or after another.
  void lines(const std::vector<std::string>& comments, std::size_t depth) {
    for (const std::string& comment : comments)
      if (!comment.empty())
        text_ += indent(depth) + comment + "\n";
      else if (text_.size() > block_start_ && !text_.ends_with("\n\n"))
        text_ += "\n";
  }
  /// The first on the present line, others below.
  void behind(const std::vector<std::string>& comments, std::size_t depth) {
    for (const std::string& comment : comments)
      text_ += (&comment == &comments.front() ? "  " : indent(depth)) + comment + "\n";
    if (comments.empty()) text_ += "\n";
  }

  void nodes(const std::vector<ScriptNode>& siblings, std::size_t depth) {
    block_start_ = text_.size();
    for (const ScriptNode& each : siblings) node(each, depth);
  }

  void node(const ScriptNode& node, std::size_t depth) {
    lines(node.comments_before, depth);
    text_ += indent(depth) + node.type + "(";
    attributes(node, depth);
    text_ += ")";
    const bool has_block =
        !node.children.empty() || !node.comments_behind_end.empty() || has_comment(node.comments_at_end);
    if (has_block) text_ += " {";
    behind(node.comments_behind, has_block ? depth + 1 : depth);
    if (!has_block) return;
    nodes(node.children, depth + 1);
    lines(node.comments_at_end, depth + 1);
    while (text_.ends_with("\n\n")) text_.pop_back();
    text_ += indent(depth) + "}";
    behind(node.comments_behind_end, depth);
  }

  /// Writes as many attributes to a line as fit; comments end theirs.
  void attributes(const ScriptNode& node, std::size_t depth) {
    const std::size_t inner = depth + 2;
    bool begins_line = false;
    const auto break_line = [&] {
      while (text_.back() == ' ') text_.pop_back();
      text_ += "\n";
      text_ += indent(inner);
      begins_line = true;
    };
    for (const ScriptAttribute& attribute : node.attributes) {
      const bool is_last = &attribute == &node.attributes.back();
      if (!attribute.comments_before.empty()) {
        if (!begins_line) break_line();
        while (text_.back() == ' ') text_.pop_back();
        lines(attribute.comments_before, inner);
        text_ += indent(inner);
        begins_line = true;
      }
      const std::vector<std::string> pieces = pieces_of(attribute);
      std::string head = attribute.name + "=";
      if (pieces.size() == 1)
        head += attribute.is_quoted || !is_word(attribute.value) ? pieces[0] : attribute.value;
      const std::size_t column = text_.size() - (text_.rfind('\n') + 1);
      if (!begins_line && column + head.size() + 1 > longest_line && &attribute != &node.attributes.front())
        break_line();
      text_ += head;
      begins_line = false;
      if (pieces.size() > 1)
        for (const std::string& piece : pieces) break_line(), text_ += piece;
      begins_line = false;
      if (!is_last) text_ += ", ";
      if (!attribute.comments_behind.empty()) {
        while (text_.back() == ' ') text_.pop_back();
        behind(attribute.comments_behind, inner);
        text_ += indent(is_last ? depth : inner);
        begins_line = true;
      }
    }
    if (node.comments_in_list.empty()) return;
    if (!begins_line) text_ += "\n";
    while (text_.back() == ' ') text_.pop_back();
    lines(node.comments_in_list, inner);
    text_ += indent(depth);
  }

  std::string text_;
  std::size_t block_start_ = 0;
};

}  // namespace

std::string format_script(const ScriptNode& file) { return Formatter().file(file); }

}  // namespace parvis::scene
