// The words of a scene script (thesis, appendix A): brackets, commas, equals signs, bare words, quoted
// strings. White space and the comments `// ...` and `# ...` lie between them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "scene/script/script_syntax.h"

namespace parvis::scene {

enum class TokenKind : unsigned char { word, string, symbol, end };

struct Comment {
  std::string text;  ///< from its "//" or "#" to the end of its line
  bool begins_line = false;
  bool has_blank_before = false;  ///< a blank line
};

struct Token {
  TokenKind kind = TokenKind::end;
  std::string text;  ///< a string without its quotes; one of ( ) { } , = for a symbol
  TextPlace place = {};
  bool begins_line = false;              ///< nothing but white space stands before it on its line
  std::vector<std::size_t> joints = {};  ///< of a string: where in the text its written pieces meet
  std::vector<Comment> comments = {};    ///< since the token before
  bool has_blank_before = false;         ///< a blank line, behind its comments

  bool is(char symbol) const { return kind == TokenKind::symbol && text.front() == symbol; }
};

/// After this many errors reading stops: more would only repeat them.
inline constexpr std::size_t max_script_errors = 20;

/// The token as errors quote it: short, and without bytes that a terminal would obey.
std::string quoted(const Token& token);

/// Hands out one token after the other in time linear in the text.
class TokenReader {
 public:
  /// `text` must outlive the reader. Errors in strings are added to `errors` at places in `file`.
  TokenReader(std::string_view text, std::string file, Errors& errors);

  /// A word ends at white space, a bracket, a comma, '=', a quote or a comment. A string ends on its line; it
  /// may hold \" \\ \n \t; strings that follow each other join into one. After the last token: `end` for
  /// ever.
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
