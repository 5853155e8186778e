#include "scene/script/script_reader.h"

#include <algorithm>

#include "scene/script/script_tokens.h"

namespace parvis::scene {
namespace {

class Parser {
 public:
  Parser(std::string_view text, const std::string& file) : file_(file), tokens_(text, file, errors_) {
    current_ = tokens_.next(), following_ = tokens_.next();
  }

  Result<ScriptNode> script() {
    ScriptNode file;
    behind_ = &file.comments_before;
    file.children = node_list(0);
    if (errors_.size() >= max_script_errors) fail(current_.place, "too many errors; reading stopped here");
    if (!errors_.empty()) return std::move(errors_);
    take_comments(file.comments_at_end, true);
    return file;
  }

 private:
  std::vector<ScriptNode> node_list(int depth);
  void node(std::vector<ScriptNode>& siblings, int depth);
  void children(ScriptNode& parent, int depth);
  void attribute_list(ScriptNode& owner);
  bool attribute(ScriptNode& owner);
  void skip_to_end_of_list();
  void skip_to_next_node(int depth);
  bool count_item();

  /// Moves the comments before the present token: those on the line of what came before to that, others to
  /// `own`, where an empty one stands for a blank line.
  void take_comments(std::vector<std::string>& own, bool keeps_blanks = false) {
    for (Comment& comment : current_.comments) {
      if (comment.has_blank_before && keeps_blanks) own.emplace_back();
      (comment.begins_line ? own : *behind_).push_back(std::move(comment.text));
    }
    current_.comments.clear();
    if (current_.has_blank_before && keeps_blanks) own.emplace_back();
  }
  void take() { current_ = std::move(following_), following_ = tokens_.next(); }
  bool at_end() const {
    return current_.kind == TokenKind::end || is_stopped_ || errors_.size() >= max_script_errors;
  }
  bool at_node() const { return current_.kind == TokenKind::word && following_.is('('); }

  template <class... Args>
  void fail(TextPlace place, fmt::format_string<Args...> format, Args&&... args) {
    errors_.push_back(error_at({file_, place.line, place.column}, format, std::forward<Args>(args)...));
  }

  template <class... Args>
  void stop(TextPlace place, fmt::format_string<Args...> format, Args&&... args) {
    fail(place, format, std::forward<Args>(args)...);
    is_stopped_ = true;
  }

  const std::string& file_;
  Errors errors_;
  TokenReader tokens_;
  Token current_, following_;
  std::vector<std::string>* behind_ = nullptr;  ///< of what was read last: where comments on its line go
  std::size_t items_ = 0;
  bool is_stopped_ = false;  ///< an error after which going on would only repeat it
};

bool Parser::count_item() {
  if (++items_ <= max_script_items) return true;
  stop(current_.place,
       "the script holds more than {} nodes and attributes; split it or put geometry in a model file",
       max_script_items);
  return false;
}

std::vector<ScriptNode> Parser::node_list(int depth) {
  std::vector<ScriptNode> nodes;
  while (!at_end()) {
    if (at_node()) {
      node(nodes, depth);
    } else if (current_.is('}')) {
      if (depth > 0) return nodes;
      fail(current_.place, "this '}}' closes nothing; remove it or look for a missing '{{'");
      skip_to_next_node(depth);
    } else {
      if (current_.kind == TokenKind::word)
        fail(current_.place, "expected '(' after the node type {}, found {}", quoted(current_),
             quoted(following_));
      else
        fail(current_.place, "expected a node such as group(name=\"trees\"), found {}", quoted(current_));
      skip_to_next_node(depth);
    }
  }
  return nodes;
}

void Parser::node(std::vector<ScriptNode>& siblings, int depth) {
  if (!count_item()) return;
  ScriptNode result;
  result.type = current_.text;
  result.place = current_.place;
  take_comments(result.comments_before, true);
  behind_ = &result.comments_behind;
  take(), take_comments(result.comments_before), take();
  attribute_list(result);
  const bool has_children = !is_stopped_ && current_.is('{');
  if (has_children) children(result, depth + 1);
  siblings.push_back(std::move(result));
  behind_ = has_children ? &siblings.back().comments_behind_end : &siblings.back().comments_behind;
}

void Parser::children(ScriptNode& parent, int depth) {
  if (depth > max_script_depth)
    return stop(current_.place,
                "nodes are nested more than {} deep; move inner ones to a file of their own and "
                "include it",
                max_script_depth);
  const TextPlace opening = current_.place;
  take_comments(parent.comments_behind);
  take();
  parent.children = node_list(depth);
  take_comments(parent.comments_at_end, true);
  if (current_.is('}')) return take();
  if (current_.kind == TokenKind::end)
    stop(opening, "this '{{' is never closed; add a '}}' after the children of {}", parent.type);
}

/// Reads attributes after the "(" up to and with the ")".
void Parser::attribute_list(ScriptNode& owner) {
  while (!at_end() && !current_.is(')')) {
    if (!attribute(owner)) return skip_to_end_of_list();
    if (current_.is(',')) {
      take_comments(owner.attributes.back().comments_behind);
      take();
    } else if (!current_.is(')') && !at_end()) {
      fail(current_.place,
           "expected ',' or ')' after the attribute {}, found {}; texts with spaces need quotes",
           owner.attributes.back().name, quoted(current_));
      return skip_to_end_of_list();
    }
  }
  take_comments(owner.comments_in_list);
  behind_ = &owner.comments_behind;
  if (current_.is(')')) return take();
  if (current_.kind == TokenKind::end)
    stop(owner.place, "the attributes of {} are never closed; add a ')'", owner.type);
}

bool Parser::attribute(ScriptNode& owner) {
  if (!count_item()) return false;
  if (current_.kind != TokenKind::word || !following_.is('=')) {
    const Token& unexpected = current_.kind == TokenKind::word ? following_ : current_;
    fail(unexpected.place, "expected an attribute of {} such as name=\"value\", found {}", owner.type,
         quoted(unexpected));
    return false;
  }
  ScriptAttribute result;
  result.name = current_.text;
  result.name_place = current_.place;
  take_comments(result.comments_before);
  behind_ = &result.comments_before;
  take(), take_comments(result.comments_before), take(), take_comments(result.comments_before);
  if (current_.kind != TokenKind::word && current_.kind != TokenKind::string) {
    fail(current_.place,
         "expected a value after {}=, found {}; a colour needs quotes: \"#D9A866\" ('#' begins a "
         "comment)",
         result.name, quoted(current_));
    behind_ = &owner.comments_behind;
    return false;
  }
  result.value = std::move(current_.text);
  result.value_place = current_.place;
  result.is_quoted = current_.kind == TokenKind::string;
  result.joints = std::move(current_.joints);
  take();
  owner.attributes.push_back(std::move(result));
  behind_ = &owner.attributes.back().comments_behind;
  return true;
}

/// Skips after an error among attributes: to behind the ")", or to where a list of nodes goes on.
void Parser::skip_to_end_of_list() {
  while (!at_end() && !current_.is('{') && !current_.is('}')) {
    if (at_node() && current_.begins_line) return;
    const bool closes = current_.is(')');
    take();
    if (closes) return;
  }
}

/// Skips after an error among nodes: to the next thing that looks like a node, or to the end of this list.
void Parser::skip_to_next_node(int depth) {
  while (!at_end()) {
    take();
    if (at_node() || (depth > 0 && current_.is('}'))) return;
  }
}

}  // namespace

Result<ScriptNode> parse_script_file(std::string_view text, const std::string& file) {
  if (text.size() > max_script_bytes)
    return error_at({file}, "the script is larger than {} MB; geometry belongs in model files",
                    max_script_bytes >> 20);
  if (const std::size_t zero = text.find('\0'); zero != std::string_view::npos) {
    const int line = 1 + int(std::count(text.begin(), text.begin() + std::ptrdiff_t(zero), '\n'));
    return error_at({file, line, 1},
                    "this is not a text file: it holds a zero byte; a scene script is UTF-8 text");
  }
  return Parser(text, file).script();
}

Result<std::vector<ScriptNode>> parse_script(std::string_view text, const std::string& file) {
  Result<ScriptNode> root = parse_script_file(text, file);
  if (!root) return root.errors();
  return std::move(root->children);
}

}  // namespace parvis::scene
