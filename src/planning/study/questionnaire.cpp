#include "planning/study/questionnaire.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "base/utf8.h"

namespace parvis::study {
namespace {

constexpr std::size_t sus_items = 10;

/// Scores and percentiles, after Sauro 2011. A normal curve does not fit them: it gives 71.2 for 75.
constexpr std::array<std::pair<double, double>, 21> sus_table{
    {{50, 13}, {55, 19}, {60, 29}, {65, 41}, {66, 44}, {67, 47}, {68, 50},
     {69, 53}, {70, 56}, {71, 60}, {72, 63}, {73, 67}, {74, 70}, {75, 73},
     {76, 77}, {77, 80}, {78, 83}, {79, 86}, {80, 88}, {85, 97}, {90, 99.8}}};

/// The contributions of the items, 0 to 4: odd ones are agreed with, even ones disagreed with.
Result<std::array<double, sus_items>> sus_contributions(std::span<const SusAnswer> answers) {
  if (answers.size() != sus_items)
    return error("{} answers; the System Usability Scale has {}", answers.size(), sus_items);
  std::array<double, sus_items> contributions{};
  for (std::size_t i = 0; i < sus_items; ++i) {
    if (!answers[i]) return error("item {} is missing", i + 1);
    const double answer = *answers[i];
    if (!(answer >= 1.0 && answer <= 5.0))
      return error("item {} has the answer {:g}; expected 1 to 5", i + 1, answer);
    if (answer != std::floor(answer))
      return error("item {} has the answer {:g}; expected a whole number", i + 1, answer);
    contributions[i] = i % 2 == 0 ? answer - 1.0 : 5.0 - answer;
  }
  return contributions;
}

}  // namespace

const Question* Questionnaire::find(std::string_view question) const {
  const auto found = std::ranges::find(questions, question, &Question::name);
  return found == questions.end() ? nullptr : &*found;
}

Status check_answer(const Question& question, std::string_view answer) {
  if (answer.empty()) return Ok{};
  if (question.is_text()) {
    if (answer.size() > max_answer_bytes)
      return error("the answer to \"{}\" is longer than {} bytes", question.name, max_answer_bytes);
    if (!is_utf8(answer)) return error("the answer to \"{}\" is not UTF-8", question.name);
    return Ok{};
  }
  int number = 0;
  const auto [end, code] = std::from_chars(answer.data(), answer.data() + answer.size(), number);
  if (code != std::errc() || end != answer.data() + answer.size() || number < question.low ||
      number > question.high)
    return error("\"{}\" is no answer to \"{}\"; expected a whole number from {} to {}", answer.substr(0, 40),
                 question.name, question.low, question.high);
  return Ok{};
}

Result<double> sus_score(std::span<const SusAnswer> answers) {
  const auto contributions = sus_contributions(answers);
  if (!contributions) return contributions.errors();
  double sum = 0.0;
  for (const double each : *contributions) sum += each;
  return 2.5 * sum;
}

Result<std::pair<double, double>> sus_subscales(std::span<const SusAnswer> answers) {
  const auto contributions = sus_contributions(answers);
  if (!contributions) return contributions.errors();
  double usability = 0.0, learnability = 0.0;
  for (std::size_t i = 0; i < sus_items; ++i)
    (i == 3 || i == 9 ? learnability : usability) += (*contributions)[i];
  return std::pair(3.125 * usability, 12.5 * learnability);
}

double sus_percentile(double score) {
  if (score <= sus_table.front().first) return sus_table.front().second;
  if (score >= sus_table.back().first) return sus_table.back().second;
  const auto above = std::ranges::upper_bound(sus_table, score, {}, &std::pair<double, double>::first);
  const auto below = above - 1;
  return below->second +
         (above->second - below->second) * (score - below->first) / (above->first - below->first);
}

std::string sus_percentile_text(double score) {
  if (score < sus_table.front().first) return fmt::format("below {:g}", sus_table.front().second);
  if (score > sus_table.back().first) return fmt::format("above {:g}", sus_table.back().second);
  return fmt::format("{:.0f}", sus_percentile(score));
}

}  // namespace parvis::study
