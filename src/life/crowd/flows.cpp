#include "life/crowd/flows.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>

#include "base/files.h"

namespace parvis::crowd {
namespace {

constexpr std::uint64_t max_bytes = 1 << 20;
constexpr std::size_t max_flows = 2'000, max_complaints = 20;
constexpr float max_per_hour = 36'000.0f;  // ten people per second
constexpr std::string_view columns = "from, to, per_hour";

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
  return first == std::string_view::npos ? std::string_view() : text.substr(first, last - first + 1);
}

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t end = line.find_first_of(",;");
    fields.push_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos) return fields;
    line.remove_prefix(end + 1);
  }
}

/// All numbers of a field; nothing where one is none.
std::optional<std::vector<float>> numbers_of(std::string_view field) {
  std::vector<float> numbers;
  for (field = trimmed(field); !field.empty(); field = trimmed(field)) {
    float number = 0.0f;
    const auto [end, code] = std::from_chars(field.data(), field.data() + field.size(), number);
    if (code != std::errc() || !std::isfinite(number)) return std::nullopt;
    field.remove_prefix(std::size_t(end - field.data()));
    if (!field.empty() && field.front() != ' ' && field.front() != '\t') return std::nullopt;
    numbers.push_back(number);
  }
  return numbers;
}

std::optional<glm::vec3> place_of(std::string_view field) {
  const auto numbers = numbers_of(field);
  if (!numbers || numbers->size() < 2 || numbers->size() > 3) return std::nullopt;
  const glm::vec3 place((*numbers)[0], (*numbers)[1], numbers->size() == 3 ? (*numbers)[2] : 0.0f);
  return glm::length(place) < 1e6f ? std::optional(place) : std::nullopt;
}

Result<Flow> flow_of(const std::vector<std::string_view>& fields, const FileLocation& where) {
  if (fields.size() != 3) return error_at(where, "{} fields, expected {}", fields.size(), columns);
  const auto from = place_of(fields[0]), to = place_of(fields[1]);
  if (!from || !to)
    return error_at(where, "\"{}\" is no place: expected two or three numbers of metres with spaces between",
                    from ? fields[1] : fields[0]);
  const auto count = numbers_of(fields[2]);
  if (!count || count->size() != 1)
    return error_at(where, "per_hour is \"{}\": expected a number", fields[2]);
  if (!(count->front() >= 0.0f && count->front() <= max_per_hour))
    return error_at(where,
                    "per_hour is {:g}: expected 0 to {:.0f} people; to count people the other way give "
                    "a line with from and to exchanged",
                    count->front(), max_per_hour);
  return Flow{*from, *to, count->front()};
}

}  // namespace

Result<std::vector<Flow>> read_flows(const std::filesystem::path& file) {
  const Result<std::string> text = read_file(file, max_bytes);
  if (!text) return text.errors();
  std::vector<Flow> flows;
  Errors errors;
  FileLocation where{file.string(), 0, 1};
  bool has_header = false;
  std::istringstream lines(*text);
  for (std::string line; std::getline(lines, line) && errors.size() < max_complaints;) {
    ++where.line;
    const std::string_view content = trimmed(std::string_view(line).substr(0, line.find('#')));
    if (content.empty()) continue;
    const std::vector<std::string_view> fields = fields_of(content);
    if (!std::exchange(has_header, true)) {
      if (fields != std::vector<std::string_view>{"from", "to", "per_hour"})
        return error_at(where, "the first line names other columns than {}", columns);
      continue;
    }
    if (flows.size() == max_flows)
      return error_at(where, "more than {} flows: leave out those of few people", max_flows);
    if (Result<Flow> flow = flow_of(fields, where))
      flows.push_back(*flow);
    else
      errors.insert(errors.end(), flow.errors().begin(), flow.errors().end());
  }
  if (!errors.empty()) return errors;
  if (flows.empty()) return error_at(where, "no flow: expected lines with {}", columns);
  return flows;
}

}  // namespace parvis::crowd
