#include "scene/script/script_tokens.h"

#include <utility>

namespace parvis::scene {
namespace {

constexpr std::size_t max_quote = 40;
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
bool is_symbol(char c) { return c == '(' || c == ')' || c == '{' || c == '}' || c == ',' || c == '='; }

}  // namespace

std::string quoted(const Token& token) {
  if (token.kind == TokenKind::end) return "the end of the file";
  std::string text = token.text.substr(0, max_quote);
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 32 || c == 127) c = '?';
  if (token.text.size() > max_quote) text += "...";
  return (token.kind == TokenKind::string ? "the text \"" : "'") + text +
         (token.kind == TokenKind::string ? "\"" : "'");
}

TokenReader::TokenReader(std::string_view text, std::string file, Errors& errors)
    : text_(text), file_(std::move(file)), errors_(errors) {
  if (text_.starts_with(byte_order_mark)) text_.remove_prefix(byte_order_mark.size());
}

void TokenReader::advance() {
  if (here() == '\n') {
    ++place_.line, place_.column = 1;
    begins_line_ = true;
  } else {
    ++place_.column;
  }
  ++at_;
}

void TokenReader::fail(TextPlace place, const char* message) {
  if (errors_.size() < max_script_errors) errors_.push_back({message, {file_, place.line, place.column}});
}

void TokenReader::skip_space_and_comments() {
  while (at_ < text_.size()) {
    if (is_space(here())) {
      if (here() == '\n' && ++line_ends_ > 1) has_blank_ = true;
      advance();
    } else if (at_comment()) {
      read_comment();
    } else {
      return;
    }
  }
}

void TokenReader::read_comment() {
  const std::size_t start = at_;
  const bool begins_line = begins_line_;
  while (at_ < text_.size() && here() != '\n') advance();
  std::string_view comment = text_.substr(start, at_ - start);
  while (is_space(comment.back())) comment.remove_suffix(1);
  comments_.push_back({std::string(comment), begins_line, std::exchange(has_blank_, false)});
  line_ends_ = 0;
}

Token TokenReader::next() {
  skip_space_and_comments();
  Token token;
  const TextPlace place = place_;
  const bool begins_line = begins_line_;
  std::vector<Comment> comments = std::exchange(comments_, {});
  const bool has_blank = std::exchange(has_blank_, false);
  line_ends_ = 0;
  if (at_ < text_.size()) {
    begins_line_ = false;
    if (is_symbol(here())) {
      token = {TokenKind::symbol, std::string(1, here())};
      advance();
    } else {
      token = here() == '"' ? read_strings() : read_word();
    }
  }
  token.place = place;
  token.begins_line = begins_line;
  token.comments = std::move(comments);
  token.has_blank_before = has_blank;
  return token;
}

Token TokenReader::read_word() {
  const std::size_t start = at_;
  while (at_ < text_.size() && !is_space(here()) && !is_symbol(here()) && here() != '"' && !at_comment())
    advance();
  return {TokenKind::word, std::string(text_.substr(start, at_ - start))};
}

Token TokenReader::read_strings() {
  Token token{TokenKind::string, ""};
  while (here() == '"') {
    if (!token.text.empty()) token.joints.push_back(token.text.size());
    read_string(token.text);
    skip_space_and_comments();
  }
  return token;
}

void TokenReader::read_string(std::string& into) {
  const TextPlace start = place_;
  begins_line_ = false;
  advance();
  while (at_ < text_.size() && here() != '"' && here() != '\n') {
    if (here() == '\\') {
      into += read_escape();
    } else {
      into += here();
      advance();
    }
  }
  if (here() == '"') return advance();
  fail(start,
       "this text has no closing quote on its line; close it (texts that follow each other are joined: "
       "\"one \" \"two\")");
}

char TokenReader::read_escape() {
  const TextPlace start = place_;
  advance();
  const char escaped = here();
  if (escaped != '\n' && at_ < text_.size()) advance();
  switch (escaped) {
    case '"':
    case '\\':
      return escaped;
    case 'n':
      return '\n';
    case 't':
      return '\t';
    default:
      fail(start, "unknown escape; use \\\" \\\\ \\n or \\t, and '/' between folders");
      return '?';
  }
}

}  // namespace parvis::scene
