// Tokens of a scene script (thesis, appendix A): brackets, commas, equals signs, bare words, quoted strings.
// White space and the comments `// ...` and `# ...` separate them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "scene/script/script_syntax.h"

namespace parvis::scene {

enum class TokenKind : unsigned char { word, string, symbol, end };

/// A comment between tokens.
struct Comment {
  std::string text;  ///< from its "//" or "#" to the end of its line
  bool begins_line = false;
  bool has_blank_before = false;  ///< a blank line stands before it
};

/// A token with its location and the comments before it.
struct Token {
  TokenKind kind = TokenKind::end;
  std::string text;  ///< a string without its quotes; one of ( ) { } , = for a symbol
  TextPlace place = {};
  bool begins_line = false;              ///< only white space stands before it on its line
  std::vector<std::size_t> joints = {};  ///< of a string: offsets where adjacent strings were joined
  std::vector<Comment> comments = {};    ///< since the previous token
  bool has_blank_before = false;         ///< a blank line stands directly before it

  /// True if the token is this bracket, comma or equals sign.
  bool is(char symbol) const { return kind == TokenKind::symbol && text.front() == symbol; }
};

/// The number of errors after which reading stops: more would only repeat them.
inline constexpr std::size_t max_script_errors = 20;

/// The token as errors quote it: shortened, without control characters.
std::string quoted(const Token& token);

/// Splits a text into tokens, one per call, in linear time.
class TokenReader {
 public:
  /// `text` must outlive the reader. Errors in strings are added to `errors` with locations in `file`.
  TokenReader(std::string_view text, std::string file, Errors& errors);

  /// The next token. A word ends at white space, a bracket, a comma, '=', a quote or a comment. A string ends
  /// on its line and may contain \" \\ \n \t; adjacent strings are joined. After the last token it returns
  /// `end`.
  Token next();

 private:
  char here(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
  bool at_comment() const { return here() == '#' || (here() == '/' && here(1) == '/'); }
  void advance();
  void skip_space_and_comments();
  void read_comment();
  Token read_word();
  Token read_strings();
  void read_string(std::string& into);
  char read_escape();
  void fail(TextPlace place, const char* message);

  std::string_view text_;
  std::string file_;
  Errors& errors_;
  std::size_t at_ = 0;
  TextPlace place_;
  bool begins_line_ = true;
  std::vector<Comment> comments_;  ///< not handed out yet
  int line_ends_ = 0;              ///< since the last word or comment
  bool has_blank_ = false;
};

}  // namespace parvis::scene
