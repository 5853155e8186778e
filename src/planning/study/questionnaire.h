// Questionnaires: what is asked, which answers count, and the score of the System Usability Scale.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "planning/design/words.h"

namespace parvis::study {

/// A text in the two languages.
struct Text {
  std::string english, french;

  /// The text in a language; English where it is not translated.
  const std::string& in(design::Language language) const {
    return language == design::Language::french && !french.empty() ? french : english;
  }
};

/// A question: an answer on a scale, or free text.
struct Question {
  std::string name;  ///< unique in its questionnaire
  Text text;
  int low = 1, high = 7;  ///< ends of the scale; equal: free text
  Text low_label, high_label;

  /// Whether the answer is a text.
  bool is_text() const { return low == high; }
};

/// Questions that are asked together.
struct Questionnaire {
  std::string name;
  Text title;
  bool is_sus = false;  ///< its ten items have a score
  std::vector<Question> questions;

  /// The question of that name; null: it has none.
  const Question* find(std::string_view question) const;
};

/// The longest free text, bytes.
inline constexpr std::size_t max_answer_bytes = 10'000;

/// An answer as it is logged: a whole number of the scale, or a text; empty: the question was left out.
/// Errors say which answers count.
Status check_answer(const Question& question, std::string_view answer);

/// An answer to an item of the System Usability Scale.
using SusAnswer = std::optional<double>;

/// The score of ten answers, 0 to 100 (J. Brooke, SUS: a quick and dirty usability scale, 1996). Errors:
/// another number of answers, one that is missing, no whole number, or not from 1 to 5. Nothing is imputed.
Result<double> sus_score(std::span<const SusAnswer> answers);
/// The parts of the score (J. R. Lewis and J. Sauro, The factor structure of the System Usability Scale,
/// 2009): usability and learnability, 0 to 100 each. Errors as of the score.
Result<std::pair<double, double>> sus_subscales(std::span<const SusAnswer> answers);

/// The percentage of 500 studies with lower scores (J. Sauro, 2011), linear between the rows of its table.
/// Scores below 50 and above 90 have the percentile of the table's end.
double sus_percentile(double score);
/// The percentile as people read it: "73", "below 13", "above 99.8".
std::string sus_percentile_text(double score);

}  // namespace parvis::study
