#include "planning/study/report.h"

#include <algorithm>
#include <cmath>

#include "planning/study/statistics.h"

namespace parvis::study {
namespace {

constexpr std::array colours{"#1f6f8b", "#c1666b", "#6a8d3a", "#8b5fa8", "#d18f2c", "#4a4e69"};

std::string escaped(const std::string& text) {
  std::string made;
  for (const char c : text)
    made += c == '&'   ? "&amp;"
            : c == '<' ? "&lt;"
            : c == '>' ? "&gt;"
            : c == '"' ? "&quot;"
                       : std::string(1, c);
  return made;
}

/// A number of a part that is compared between conditions.
struct Quantity {
  const char *name, *unit;
  double (*of)(const PartMeasures&);
};
constexpr Quantity quantities[]{
    {"Time", "s", [](const PartMeasures& part) { return part.duration_s; }},
    {"Errors: refused commands, things outside of the area", "",
     [](const PartMeasures& part) { return double(part.errors()); }},
    {"Commands", "", [](const PartMeasures& part) { return double(part.commands); }},
    {"Undone commands", "", [](const PartMeasures& part) { return double(part.undone); }},
    {"Way of the eye", "m", [](const PartMeasures& part) { return part.way_m; }}};

/// Tasks that count: whole ones, no training.
bool counts(const PartMeasures& part) { return part.is_task() && part.position > 0 && part.is_whole; }

/// The conditions in the study's order; "-" where it has none.
std::vector<std::string> conditions_of(const Study& study) {
  std::vector<std::string> names;
  for (const Condition& each : study.conditions) names.push_back(each.name);
  if (names.empty()) names.push_back("-");
  return names;
}

/// Values of a quantity under a condition by participant: the mean, where one did several tasks under it.
std::map<std::string, double> by_participant(
    const std::vector<PartMeasures>& parts, const std::string& condition,
    const std::function<std::optional<double>(const PartMeasures&)>& of) {
  std::map<std::string, std::vector<double>> values;
  for (const PartMeasures& part : parts)
    if (part.condition == condition)
      if (const std::optional<double> value = of(part)) values[part.participant].push_back(*value);
  std::map<std::string, double> means;
  for (const auto& [participant, several] : values) means[participant] = mean_of(several).value;
  return means;
}

std::vector<double> values_of(const std::map<std::string, double>& by_name) {
  std::vector<double> values;
  for (const auto& [name, value] : by_name) values.push_back(value);
  return values;
}

std::string text_of(const Mean& mean) {
  if (mean.count == 0) return "&ndash;";
  if (!mean.half_width) return fmt::format("{:.1f} (n = 1, no interval)", mean.value);
  return fmt::format("{:.1f} [{:.1f}, {:.1f}], n = {}", mean.value, mean.value - *mean.half_width,
                     mean.value + *mean.half_width, mean.count);
}

/// Rows of samples: each value a dot, the mean with its interval a bar.
std::string dots_svg(const std::vector<std::pair<std::string, std::vector<double>>>& rows,
                     const std::string& unit, double low, double high) {
  constexpr double left = 170, width = 460, row_height = 34;
  for (const auto& [name, values] : rows) {
    const Mean mean = mean_of(values);
    high = std::max(high, mean.value + mean.half_width.value_or(0.0));
    for (const double value : values) high = std::max(high, value);
  }
  if (high <= low) high = low + 1.0;
  const auto x = [&](double value) { return left + width * (std::max(value, low) - low) / (high - low); };
  const double bottom = row_height * double(rows.size());
  std::string svg = fmt::format("<svg viewBox='0 0 {} {}' width='{}' role='img'>", left + width + 40,
                                bottom + 26, left + width + 40);
  const double rough = (high - low) / 5.0, power = std::pow(10.0, std::floor(std::log10(rough)));
  const double tick = power * (rough / power > 5 ? 10 : rough / power > 2 ? 5 : rough / power > 1 ? 2 : 1);
  for (double at = std::ceil(low / tick) * tick; at <= high + 1e-9; at += tick)
    svg += fmt::format(
        "<line x1='{0:.1f}' x2='{0:.1f}' y1='0' y2='{1}' stroke='#ddd'/><text x='{0:.1f}' y='{2}' "
        "text-anchor='middle' class='tick'>{3:g}{4}</text>",
        x(at), bottom, bottom + 18, at, unit.empty() ? "" : " " + unit);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const double y = row_height * (double(row) + 0.5);
    const char* colour = colours[row % colours.size()];
    const Mean mean = mean_of(rows[row].second);
    svg += fmt::format("<text x='{}' y='{:.1f}' text-anchor='end'>{}</text>", left - 12, y + 4,
                       escaped(rows[row].first));
    for (const double value : rows[row].second)
      svg += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='4' fill='{}' fill-opacity='.35'/>", x(value), y,
                         colour);
    if (mean.half_width)
      svg +=
          fmt::format("<line x1='{:.1f}' x2='{:.1f}' y1='{:.1f}' y2='{:.1f}' stroke='{}' stroke-width='3'/>",
                      x(mean.value - *mean.half_width), x(mean.value + *mean.half_width), y, y, colour);
    if (mean.count > 0)
      svg += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='6' fill='{}'/>", x(mean.value), y, colour);
  }
  return svg + "</svg>\n";
}

/// Differences between all pairs of conditions, of those who did both.
std::string paired_rows(const std::vector<std::string>& conditions,
                        const std::vector<std::map<std::string, double>>& values,
                        const std::vector<std::string>& names) {
  std::string rows;
  for (std::size_t a = 0; a < conditions.size(); ++a)
    for (std::size_t b = a + 1; b < conditions.size(); ++b) {
      std::vector<double> differences;
      for (const auto& [participant, value] : values[a])
        if (const auto other = values[b].find(participant); other != values[b].end())
          differences.push_back(other->second - value);
      rows += fmt::format("<tr><td>{} &minus; {}, paired</td><td>{}</td></tr>", escaped(names[b]),
                          escaped(names[a]), text_of(mean_of(differences)));
    }
  return rows;
}

std::string comparison_html(const std::string& title, const std::string& unit,
                            const std::vector<std::string>& conditions, const std::vector<std::string>& names,
                            const std::vector<std::map<std::string, double>>& values, double low,
                            double high) {
  std::vector<std::pair<std::string, std::vector<double>>> rows;
  std::string table;
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    rows.emplace_back(names[i], values_of(values[i]));
    table += fmt::format("<tr><td>{}</td><td>{}</td></tr>", escaped(names[i]),
                         text_of(mean_of(rows.back().second)));
  }
  return fmt::format("<h3>{}</h3>{}<table><tr><th>{}</th><th>mean [95 % interval]{}</th></tr>{}{}</table>\n",
                     escaped(title), dots_svg(rows, unit, low, high),
                     conditions.size() > 1 ? "condition" : "", unit.empty() ? "" : ", " + unit, table,
                     paired_rows(conditions, values, names));
}

/// The corners of all that a map shows.
std::pair<glm::dvec2, glm::dvec2> extent_of(const ReportInput& input) {
  glm::dvec2 low(1e30), high(-1e30);
  const auto add = [&](glm::dvec2 point) { low = glm::min(low, point), high = glm::max(high, point); };
  for (const PartMeasures& part : input.parts) {
    if (!counts(part)) continue;
    for (const glm::dvec3& eye : part.eyes) add(glm::dvec2(eye));
    for (const glm::dvec2 place : part.placings) add(place);
  }
  for (const Task& task : input.study.tasks)
    for (const glm::dvec2 corner : task.area) add(corner);
  if (low.x > high.x) return {glm::dvec2(-10.0), glm::dvec2(10.0)};
  const glm::dvec2 margin = glm::max(0.1 * (high - low), glm::dvec2(3.0));
  return {low - margin, high + margin};
}

/// Weighted points as cells over the plan; a cell's neighbours get a part of its weight.
std::string map_svg(const ReportInput& input, const std::vector<glm::dvec3>& points,
                    const std::vector<glm::dvec2>& marks, const char* colour) {
  constexpr int longest = 72;
  const auto [low, high] = extent_of(input);
  const glm::dvec2 size = high - low;
  const double cell = std::max(size.x, size.y) / longest, scale = 300.0 / std::max(size.x, size.y);
  const glm::ivec2 cells(glm::ceil(size / cell));
  std::vector<double> weights(std::size_t(cells.x) * std::size_t(cells.y));
  for (const glm::dvec3& point : points) {
    const glm::ivec2 at(glm::floor((glm::dvec2(point) - low) / cell));
    for (int y = std::max(at.y - 1, 0); y <= std::min(at.y + 1, cells.y - 1); ++y)
      for (int x = std::max(at.x - 1, 0); x <= std::min(at.x + 1, cells.x - 1); ++x)
        weights[std::size_t(y * cells.x + x)] +=
            point.z * (x == at.x ? 0.5 : 0.25) * (y == at.y ? 0.5 : 0.25);
  }
  const double largest = weights.empty() ? 0.0 : std::ranges::max(weights);
  const auto at = [&](glm::dvec2 place) { return scale * glm::dvec2(place.x - low.x, high.y - place.y); };
  std::string svg = fmt::format("<svg viewBox='0 0 {0:.1f} {1:.1f}' width='{0:.0f}' class='map'>",
                                scale * size.x, scale * size.y);
  for (int y = 0; y < cells.y; ++y)
    for (int x = 0; x < cells.x; ++x)
      if (const double share = largest > 0.0 ? weights[std::size_t(y * cells.x + x)] / largest : 0.0;
          share > 0.02) {
        const glm::dvec2 corner = at(low + cell * glm::dvec2(x, y + 1));
        svg += fmt::format(
            "<rect x='{:.1f}' y='{:.1f}' width='{:.2f}' height='{:.2f}' fill='{}' fill-opacity='{:.2f}'/>",
            corner.x, corner.y, scale * cell, scale * cell, colour, 0.9 * std::pow(share, 0.3));
      }
  const auto line = [&](const std::vector<glm::dvec2>& points_of_line, const char* style) {
    svg += "<polyline points='";
    for (const glm::dvec2 point : points_of_line)
      svg += fmt::format("{:.1f},{:.1f} ", at(point).x, at(point).y);
    svg += fmt::format("' {}/>", style);
  };
  for (const auto& each : input.plan) line(each, "fill='none' stroke='#555' stroke-width='.8'");
  for (Task task : input.study.tasks)
    if (!task.area.empty()) {
      task.area.push_back(task.area.front());
      line(task.area, "fill='none' stroke='#999' stroke-dasharray='4 3'");
    }
  for (const glm::dvec2 mark : marks)
    svg += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='3' fill='{}' fill-opacity='.6' stroke='#fff'/>",
                       at(mark).x, at(mark).y, colour);
  const double bar_m = std::pow(10.0, std::floor(std::log10(0.5 * size.x)));
  svg += fmt::format(
      "<path d='M8 {0:.1f}h{1:.1f}' stroke='#000'/><text x='8' y='{2:.1f}' class='tick'>{3:g} m</text>",
      scale * size.y - 8, scale * bar_m, scale * size.y - 12, bar_m);
  return svg + "</svg>";
}

std::string maps_html(const ReportInput& input, const std::vector<std::string>& conditions,
                      const std::vector<std::string>& names) {
  std::string html =
      "<h2>Where they looked from, and where they placed</h2><p>The darker, the longer the eye was there; "
      "dots: things that were placed; dashed: areas of the tasks. Views of the plan are left out.</p>"
      "<div class='maps'>";
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    std::vector<glm::dvec3> eyes;
    std::vector<glm::dvec2> placings;
    for (const PartMeasures& part : input.parts) {
      if (!counts(part) || part.condition != conditions[i]) continue;
      eyes.insert(eyes.end(), part.eyes.begin(), part.eyes.end());
      placings.insert(placings.end(), part.placings.begin(), part.placings.end());
    }
    html += fmt::format("<figure>{}<figcaption>{}: {} placings</figcaption></figure>",
                        map_svg(input, eyes, placings, colours[i % colours.size()]), escaped(names[i]),
                        placings.size());
  }
  return html + "</div>\n";
}

std::string views_html(const ReportInput& input, const std::vector<std::string>& conditions,
                       const std::vector<std::string>& names) {
  std::set<std::string> views;
  for (const PartMeasures& part : input.parts)
    if (counts(part))
      for (const auto& [view, seconds] : part.view_s) views.insert(view);
  std::string html = "<h2>Views used</h2><table><tr><th>condition</th>";
  for (const std::string& view : views) html += fmt::format("<th>{}</th>", escaped(view));
  html += "</tr>";
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    std::map<std::string, double> seconds;
    double all = 0.0;
    for (const PartMeasures& part : input.parts)
      if (counts(part) && part.condition == conditions[i])
        for (const auto& [view, time] : part.view_s) seconds[view] += time, all += time;
    html += fmt::format("<tr><td>{}</td>", escaped(names[i]));
    for (const std::string& view : views)
      html += fmt::format("<td>{:.0f} s ({:.0f} %)</td>", seconds[view],
                          all > 0.0 ? 100.0 * seconds[view] / all : 0.0);
    html += "</tr>";
  }
  return html + "</table>\n";
}

/// Scores of the System Usability Scale of all who answered it, and why others have none.
std::string sus_html(const ReportInput& input, const Questionnaire& questionnaire) {
  std::vector<double> scores;
  std::string rows;
  for (const PartMeasures& part : input.parts) {
    const std::vector<SusAnswer> answers = sus_answers(questionnaire, part.answers);
    const bool is_asked = std::ranges::any_of(
        part.answers, [&](const auto& answer) { return answer.first.starts_with(questionnaire.name + "."); });
    if (!is_asked) continue;
    const Result<double> score = sus_score(answers);
    if (!score) {
      rows += fmt::format("<tr><td>{}</td><td colspan='3'>no score: {}</td></tr>", escaped(part.participant),
                          escaped(score.errors().front().message));
      continue;
    }
    scores.push_back(*score);
    const auto subscales = sus_subscales(answers);
    rows += fmt::format("<tr><td>{}</td><td>{:g}</td><td>{:g}</td><td>{:g}</td></tr>",
                        escaped(part.participant), *score, subscales->first, subscales->second);
  }
  if (rows.empty()) return "";
  const Mean mean = mean_of(scores);
  std::string summary;
  if (mean.count > 0) {
    summary =
        fmt::format("Mean {}: percentile {} of 500 studies", text_of(mean), sus_percentile_text(mean.value));
    if (mean.half_width)
      summary += fmt::format(" (interval: {} to {})", sus_percentile_text(mean.value - *mean.half_width),
                             sus_percentile_text(mean.value + *mean.half_width));
    summary += ". A score of 68 is the middle of these studies.";
  }
  return fmt::format(
      "<h3>{}</h3>{}<p>{}</p><table><tr><th>participant</th><th>score</th><th>usability</"
      "th><th>learnability</th></tr>"
      "{}</table>\n",
      escaped(questionnaire.title.english), dots_svg({{"scores", scores}}, "", 0, 100), summary, rows);
}

std::string scales_html(const ReportInput& input, const Questionnaire& questionnaire,
                        const std::vector<std::string>& conditions, const std::vector<std::string>& names) {
  std::string html;
  for (const Question& question : questionnaire.questions) {
    const std::string key = questionnaire.name + "." + question.name;
    const auto answer = [&](const PartMeasures& part) -> std::optional<double> {
      const auto found = part.answers.find(key);
      if (found == part.answers.end() || !check_answer(question, found->second) || found->second.empty())
        return std::nullopt;
      return double(std::atoi(found->second.c_str()));
    };
    if (question.is_text()) {
      std::string texts;
      for (const PartMeasures& part : input.parts)
        if (const auto found = part.answers.find(key); found != part.answers.end() && !found->second.empty())
          texts += fmt::format("<li><b>{}</b> {}</li>", escaped(part.participant), escaped(found->second));
      if (!texts.empty())
        html += fmt::format("<h4>{}</h4><ul>{}</ul>", escaped(question.text.english), texts);
      continue;
    }
    // Asked after tasks, it is compared by condition; asked at the end, there is one row.
    std::vector<std::string> of = conditions, called = names;
    const bool is_at_end = std::ranges::all_of(
        input.parts, [&](const PartMeasures& part) { return part.condition == "-" || !answer(part); });
    if (is_at_end) of = {"-"}, called = {"all"};
    std::vector<std::map<std::string, double>> values;
    std::size_t count = 0;
    for (const std::string& condition : of)
      values.push_back(by_participant(input.parts, condition, answer)), count += values.back().size();
    if (count == 0) continue;
    html += comparison_html(question.text.english, "", of, called, values, question.low, question.high);
  }
  if (html.empty()) return "";
  return fmt::format("<h2>{}</h2><p>Answers from {} ({}) to {} ({}).</p>{}",
                     escaped(questionnaire.title.english), questionnaire.questions.front().low,
                     escaped(questionnaire.questions.front().low_label.english),
                     questionnaire.questions.front().high,
                     escaped(questionnaire.questions.front().high_label.english), html);
}

/// A field of a table: quoted where it must be.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string made = "\"";
  for (const char c : text) made += c == '"' ? std::string("\"\"") : std::string(1, c);
  return made + "\"";
}

constexpr const char* style =
    "body{font:15px/1.5 Inter,'DejaVu Sans',sans-serif;max-width:60em;margin:2em auto;padding:0 "
    "1em;color:#222}"
    "table{border-collapse:collapse;margin:.6em 0}td,th{border-bottom:1px solid #ddd;padding:.25em .9em "
    ".25em 0;"
    "text-align:left;vertical-align:top}h2{margin-top:2em;border-bottom:2px solid #1f6f8b}h3{margin:1.4em 0 "
    ".2em}"
    "svg text{font-size:13px}svg .tick{font-size:11px;fill:#666}.maps{display:flex;flex-wrap:wrap;gap:1em}"
    "figure{margin:0}.map{border:1px solid #ccc;background:#fff}figcaption{font-size:13px;color:#555}";

}  // namespace

std::string report_html(const ReportInput& input) {
  const std::vector<std::string> conditions = conditions_of(input.study);
  std::vector<std::string> names = conditions;
  if (input.is_blind)
    for (std::size_t i = 0; i < names.size(); ++i)
      names[i] = fmt::format("condition {}", char('A' + int(i % 26)));
  if (conditions.front() == "-") names = {"all"};
  std::set<std::string> participants, ended;
  for (const PartMeasures& part : input.parts) {
    participants.insert(part.participant);
    const bool is_last = &part == &input.parts.back() || (&part + 1)->participant != part.participant;
    if (is_last && part.is_whole) ended.insert(part.participant);
  }
  std::string html = fmt::format(
      "<!DOCTYPE html><html lang='en'><meta "
      "charset='utf-8'><title>{0}</title><style>{1}</style><h1>{0}</h1><p>{2} "
      "participants, {3} of them to the end; conditions: {4}; order: {5}. Intervals are of Student's t; each "
      "dot is a "
      "participant. Training does not count.</p><h2>Times and errors</h2>",
      escaped(input.study.name), style, participants.size(), ended.size(),
      escaped(fmt::format("{}", fmt::join(names, ", "))),
      input.study.is_balanced ? "balanced Latin square" : "as written");
  for (const Quantity& quantity : quantities) {
    std::vector<std::map<std::string, double>> values;
    for (const std::string& condition : conditions)
      values.push_back(by_participant(input.parts, condition, [&](const PartMeasures& part) {
        return counts(part) ? std::optional(quantity.of(part)) : std::nullopt;
      }));
    html += comparison_html(quantity.name, quantity.unit, conditions, names, values, 0.0, 1.0);
  }
  html += views_html(input, conditions, names) + maps_html(input, conditions, names);
  for (const Questionnaire& questionnaire : input.study.questionnaires)
    html += questionnaire.is_sus ? sus_html(input, questionnaire)
                                 : scales_html(input, questionnaire, conditions, names);
  return html + "</html>\n";
}

std::map<std::string, std::string> report_tables(const ReportInput& input) {
  std::string parts =
      "participant,part,task,condition,position,whole,time_over,duration_s,first_placing_s,commands,undone,"
      "refused,"
      "outside,way_m,median_frame_ms\n";
  std::string answers = "participant,part,task,condition,position,questionnaire,item,value\n";
  for (const PartMeasures& part : input.parts) {
    const std::string head =
        fmt::format("{},{},{},{},{}", part.participant, part.index, part.task, part.condition, part.position);
    parts += fmt::format(
        "{},{:d},{:d},{:.3f},{},{},{},{},{},{:.2f},{:.1f}\n", head, part.is_whole, part.is_time_over,
        part.duration_s, part.first_placing_s ? fmt::format("{:.3f}", *part.first_placing_s) : "",
        part.commands, part.undone, part.refused, part.outside, part.way_m, part.median_frame_ms);
    for (const auto& [name, value] : part.answers) {
      const std::size_t dot = std::min(name.find('.'), name.size());
      answers += fmt::format("{},{},{},{}\n", head, name.substr(0, dot),
                             name.substr(std::min(dot + 1, name.size())), field(value));
    }
  }
  return {{"parts.csv", parts}, {"answers.csv", answers}};
}

std::map<std::string, std::string> record_tables(const std::string& participant,
                                                 const std::vector<Record>& records) {
  std::string events = "participant,time_s,kind,text\n";
  std::string frames = "participant,time_s,step_s,frame_ms,x,y,z,dx,dy,dz,wand_x,wand_y,wand_z\n";
  for (const Record& record : records) {
    const double time_s = 1e-6 * double(time_of(record));
    if (const Event* event = std::get_if<Event>(&record)) {
      events += fmt::format("{},{:.6f},{},{}\n", participant, time_s, field(event->kind), field(event->text));
      continue;
    }
    const Frame& frame = std::get<Frame>(record);
    const glm::vec3 at = frame.eye.position_in_world(), ahead = frame.eye.forward_in_world();
    frames +=
        fmt::format("{},{:.6f},{},{},{},{},{},{},{},{},{}\n", participant, time_s, frame.step_s,
                    frame.frame_ms, at.x, at.y, at.z, ahead.x, ahead.y, ahead.z,
                    frame.wand ? fmt::format("{},{},{}", frame.wand->x, frame.wand->y, frame.wand->z) : ",,");
  }
  return {{"events.csv", events}, {"frames.csv", frames}};
}

std::string questionnaire_page(const Study& study, design::Language language) {
  const bool is_french = language == design::Language::french;
  std::string form;
  for (const std::string& name : study.asked) {
    const Questionnaire& questionnaire = study.questionnaire(name);
    form += fmt::format("<h2>{}</h2>", escaped(questionnaire.title.in(language)));
    for (const Question& question : questionnaire.questions) {
      const std::string key = escaped(name + "." + question.name);
      form += fmt::format("<fieldset><legend>{}</legend>", escaped(question.text.in(language)));
      if (question.is_text()) {
        form += fmt::format("<textarea name='{}' rows='3' maxlength='2000'></textarea>", key);
      } else {
        form += fmt::format("<span>{}</span>", escaped(question.low_label.in(language)));
        for (int value = question.low; value <= question.high; ++value)
          form += fmt::format("<label><input type='radio' name='{0}' value='{1}'>{1}</label>", key, value);
        form += fmt::format("<span>{}</span>", escaped(question.high_label.in(language)));
      }
      form += "</fieldset>";
    }
  }
  return fmt::format(
      "<!DOCTYPE html><html lang='{0}'><meta charset='utf-8'><meta name='viewport' "
      "content='width=device-width'>"
      "<title>{1}</title><style>{2}fieldset{{border:0;border-bottom:1px solid #ddd;padding:.6em "
      "0}}legend{{font-weight:600}}"
      "label{{margin:0 .7em}}span{{color:#555}}textarea{{width:100%}}button{{font-size:1.1em;padding:.5em "
      "2em;margin:1em 0}}"
      "</style><h1>{1}</h1><p>{3}</p><form>{4}<button type='button' id='save'>{5}</button></form><script>\n"
      "document.getElementById('save').onclick = () => {{\n"
      "  const lines = [...new FormData(document.forms[0])].filter(([, value]) => value.trim())\n"
      "      .map(([name, value]) => `0 answer ${{name}} ${{value.trim().replace(/\\s+/g, ' ')}}\\n`);\n"
      "  const link = document.createElement('a');\n"
      "  link.href = URL.createObjectURL(new Blob(lines, {{type: 'text/plain'}}));\n"
      "  link.download = 'answers.txt';\n  link.click();\n}};\n</script></html>\n",
      is_french ? "fr" : "en", escaped(study.name), style,
      is_french ? "Vous pouvez laisser une question sans réponse. Aucun nom n'est demandé ; le fichier reste "
                  "sur cette machine."
                : "You may leave a question out. No name is asked for; the file stays on this machine.",
      form, is_french ? "Enregistrer les réponses" : "Save the answers");
}

}  // namespace parvis::study
