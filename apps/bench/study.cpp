// Studies: replay of an hour, kills of the program that writes the log, scores and orders against cases that
// others have computed, XDF read by a reader that is not ours.
#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/random.h"
#include "base/test_data.h"
#include "bench/own_program.h"
#include "bench/parts.h"
#include "planning/study/performance.h"
#include "planning/study/statistics.h"
#include "planning/study/test_study.h"
#include "planning/study/xdf.h"

namespace parvis::bench {
namespace {

/// Inputs of somebody who works without a pause: places, moves, undoes, looks about.
std::string synthetic_inputs(double seconds, std::uint64_t seed) {
  Random random(seed);
  const std::array views{"plan", "street", "balcony"};
  const std::array kinds{"bin", "bench_stone", "umbrella_blue", "table", "no_such_kind"};
  std::string inputs;
  for (double at = 1.0; at < seconds; at += double(random.uniform(0.2f, 6.0f))) {
    const float x = random.uniform(-15.0f, 15.0f), y = random.uniform(-13.0f, 14.0f);
    inputs += fmt::format("{:.3f} ", at);
    switch (random.index(8)) {
      case 0:
        inputs += fmt::format("view {}\n", views[std::size_t(random.index(3))]);
        break;
      case 1:
        inputs += fmt::format("eye {:.2f},{:.2f},1.7 heading {:.1f} pitch -5\n", x, y,
                              random.uniform(0.0f, 360.0f));
        break;
      case 2:
        inputs += "do undo\n";
        break;
      case 3:
        inputs += "do redo\n";
        break;
      case 4:
        inputs += fmt::format("do move selected by {:.2f},{:.2f}\n", 0.1f * x, 0.1f * y);
        break;
      case 5:
        inputs += "note it goes on\n";
        break;
      default:
        inputs += fmt::format("do insert {} {:.2f},{:.2f}\n", kinds[std::size_t(random.index(5))], x, y);
    }
  }
  return inputs + fmt::format("{:.3f} done\n", seconds);
}

bool is_replayed(const study::Study& study, const std::vector<study::Part>& parts,
                 const std::vector<study::Record>& records) {
  study::Performance performance(study, parts, rooms::all_registries());
  const study::Replay outcome = must(study::replay(performance, records));
  if (outcome.states == 0) fail("no state was compared");
  return !outcome.differs_at_us;
}

/// Events that were acknowledged before the program that writes them was killed, and are not in the log.
int lost_events(const std::filesystem::path& file, int wanted, bool flushes) {
  std::filesystem::remove(file);
  must(study::Log::open(file));
  const int acknowledged = acknowledged_before_kill(wanted, [&](const auto& acknowledge) {
    Result<study::Log> log = study::Log::open(file);
    if (!log || !log->begin({0, "P1", "s", "", 0, 0.0})) return;
    for (int i = 0;; ++i) {
      log->add(study::Event{i, "command", "insert bin 1,1"});
      if ((flushes && !log->flush()) || !acknowledge()) return;
    }
  });
  if (acknowledged < wanted) fail("the program that writes the log ended by itself");
  study::Log log = must(study::Log::read(file));
  return std::max(0, acknowledged - int(must(log.records((*must(log.session_of("P1"))).id)).size()));
}

/// Answers of a case; an answer that is no number is missing, as the log has it.
std::vector<study::SusAnswer> answers_of(const nlohmann::json& from) {
  std::vector<study::SusAnswer> answers;
  for (const nlohmann::json& answer : from)
    answers.push_back(answer.is_number() ? study::SusAnswer(answer.get<double>()) : study::SusAnswer());
  return answers;
}

bool is_scored_as(const nlohmann::json& expected, const std::vector<study::SusAnswer>& answers) {
  const Result<double> score = study::sus_score(answers);
  if (expected["score"].is_null()) return !score;
  const auto parts = study::sus_subscales(answers);
  return score && *score == expected["score"].get<double>() && parts &&
         parts->first == expected["subscales"]["usability"].get<double>() &&
         parts->second == expected["subscales"]["learnability"].get<double>();
}

void measure_sus(const nlohmann::json& sus, Report& report) {
  int passed = 0, passed_shifted = 0, count = 0;
  for (const nlohmann::json& each : sus["cases"]) {
    std::vector<study::SusAnswer> answers = answers_of(each["answers"]);
    ++count, passed += is_scored_as(each, answers);
    if (!answers.empty()) std::ranges::rotate(answers, answers.begin() + 1);
    passed_shifted += is_scored_as(each, answers);
  }
  for (const auto& [score, percentile] : sus["percentiles"]["firm"].items())
    ++count, passed += std::abs(study::sus_percentile(std::stod(score)) - percentile.get<double>()) <= 1.0;
  const study::Mean group = study::mean_of(sus["group"]["scores"].get<std::vector<double>>());
  const std::array interval{group.value - group.half_width.value_or(0.0),
                            group.value + group.half_width.value_or(0.0)};
  ++count, passed += std::abs(group.value - sus["group"]["mean"].get<double>()) < 1e-3 &&
                     std::abs(interval[0] - sus["group"]["interval_95"][0].get<double>()) < 1e-2 &&
                     std::abs(interval[1] - sus["group"]["interval_95"][1].get<double>()) < 1e-2;
  ++count, passed += !study::mean_of(sus["single"]["scores"].get<std::vector<double>>()).half_width;
  report.add("sus_cases_passed", double(passed) / count);
  report.add("sus_cases_passed_with_items_shifted_by_one",
             double(passed_shifted) / double(sus["cases"].size()));
}

/// Whether orders have the counts that a case gives, counted here and not by the room.
bool has_counts(const study::Orders& orders, const nlohmann::json& expected) {
  const int n = int(orders.front().size());
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b) {
      int at_position = 0, adjacent = 0;
      for (const std::vector<int>& order : orders) {
        at_position += order[std::size_t(b)] == a;
        for (int i = 0; i + 1 < n; ++i)
          adjacent += order[std::size_t(i)] == a && order[std::size_t(i) + 1] == b;
      }
      if (at_position != expected["each_condition_in_each_position"].get<int>()) return false;
      if (a != b && adjacent != expected["each_ordered_pair_adjacent"].get<int>()) return false;
    }
  return true;
}

void measure_latin_squares(const nlohmann::json& squares, Report& report) {
  int right = 0, count = 0, right_of_controls = 0, controls = 0;
  for (const auto& [name, square] : squares.items()) {
    const study::Orders rows = square["rows"].get<study::Orders>();
    if (name.starts_with("control")) {
      ++controls, right_of_controls += study::is_balanced(rows);
      continue;
    }
    const study::Orders own = study::balanced_orders(std::stoi(name));
    ++count, right += study::is_balanced(rows) && study::is_balanced(own) && has_counts(own, square);
  }
  report.add("latin_squares_balanced", double(right) / count);
  report.add("latin_squares_balanced_of_controls", double(right_of_controls) / controls);
}

/// The contents that libxdf must find in a file, by the records.
std::string expected_of(const study::LoggedSession& session, const std::vector<study::Record>& records) {
  std::array<std::string, 3> times, values;
  std::array<std::vector<std::vector<float>>, 3> channels;
  std::array<std::size_t, 3> counts{};
  std::string events;
  const auto add = [&](std::size_t stream, double time_s, std::vector<float> sample) {
    ++counts[stream], times[stream] += fmt::format(" {:.6f}", time_s);
    channels[stream].resize(sample.size());
    for (std::size_t c = 0; c < sample.size(); ++c) channels[stream][c].push_back(sample[c]);
  };
  std::size_t event_count = 0;
  std::string event_times;
  for (const study::Record& record : records) {
    const double time_s = session.clock_s + 1e-6 * double(study::time_of(record));
    if (const study::Event* event = std::get_if<study::Event>(&record)) {
      events += fmt::format("event {:.6f} {}\n", time_s,
                            event->text.empty() ? event->kind : event->kind + " " + event->text);
      ++event_count;
      continue;
    }
    const study::Frame& frame = std::get<study::Frame>(record);
    const glm::vec3 at = frame.eye.position_in_world(), ahead = frame.eye.forward_in_world();
    add(0, time_s, {at.x, at.y, at.z, ahead.x, ahead.y, ahead.z});
    if (frame.wand) add(1, time_s, {frame.wand->x, frame.wand->y, frame.wand->z});
    add(2, time_s, {float(frame.step_s), frame.frame_ms});
  }
  std::string expected = fmt::format("stream ParvisEvents 1 0\n");
  const std::array names{"ParvisEye", "ParvisWand", "ParvisFrames"};
  for (std::size_t i = 0; i < 3; ++i) {
    expected += fmt::format("stream {} {} {}{}", names[i], channels[i].size(), counts[i], times[i]);
    for (const std::vector<float>& channel : channels[i])
      for (const float value : channel) {
        char text[64];
        std::snprintf(text, sizeof text, " %a", double(value));
        expected += text;
      }
    expected += "\n";
  }
  return expected + events;
}

}  // namespace

void measure_study_replay(const BenchSetup& setup, Report& report) {
  const std::filesystem::path file = setup.folder / "hour.study", log_file = setup.folder / "hour.sqlite";
  const std::filesystem::path scenes = setup.folder / "scenes";
  std::filesystem::copy(
      "scenes", scenes,
      std::filesystem::copy_options::recursive | std::filesystem::copy_options::overwrite_existing);
  std::filesystem::remove(log_file);
  must(write_file(file,
                  "study(name=hour, scene=\"scenes/three_corners_square.xp\") {\n"
                  "  task(name=work)\n}\n"));
  const study::Study read = must(study::read_study(file));
  study::Log log = must(study::Log::open(log_file));
  study::Session session = must(study::Session::begin(read, log, "P1", 0.0));
  must(write_file(setup.folder / "hour.txt", synthetic_inputs(setup.is_quick ? 60.0 : 3600.0, 5)));
  {
    study::Performance performance(read, session.parts(), rooms::all_registries());
    must(study::run_inputs(session, performance, setup.folder / "hour.txt"));
  }
  std::vector<study::Record> records = must(log.records((*must(log.session_of("P1"))).id));
  report.add("replay_identical", is_replayed(read, session.parts(), records) ? 1.0 : 0.0);
  report.add("study_log_mb_per_hour",
             1e-6 * double(std::filesystem::file_size(log_file)) * (setup.is_quick ? 60.0 : 1.0));
  // A frame that is missing in the middle.
  records.erase(
      std::find_if(records.begin() + std::ptrdiff_t(records.size() / 2), records.end(),
                   [](const study::Record& record) { return std::holds_alternative<study::Frame>(record); }));
  report.add("replay_identical_of_one_frame_less", is_replayed(read, session.parts(), records) ? 1.0 : 0.0);
}

void measure_study_kills(const BenchSetup& setup, Report& report) {
  Random moments(3);
  int lost = 0, lost_unwritten = 0;
  for (int kills = 0; kills < (setup.is_quick ? 20 : 200); ++kills) {
    const int wanted = 1 + moments.index(200);
    lost += lost_events(setup.folder / "kills.sqlite", wanted, true);
    if (kills < 3) lost_unwritten += lost_events(setup.folder / "unwritten.sqlite", wanted, false);
  }
  report.add("kill_loses_events", lost);
  report.add("kill_loses_events_that_are_held", lost_unwritten);
}

void measure_study_cases(const BenchSetup&, Report& report) {
  const auto file = shared_data("study/sus_cases.json", std::filesystem::current_path());
  if (!file) return report.skip("study_cases", "no ../shared/data/study");
  const nlohmann::json cases = nlohmann::json::parse(must(read_file(*file)));
  measure_sus(cases["sus"], report);
  measure_latin_squares(cases["balanced_latin_squares"], report);
}

void measure_study_xdf(const BenchSetup& setup, Report& report) {
  const std::filesystem::path reader = setup.folder / "xdf_read", xdf = setup.folder / "P1.xdf",
                              found = setup.folder / "found";
  const std::string compile =
      fmt::format("c++ -O1 -o '{}' '{}' -lxdf 2>/dev/null", reader.string(),
                  (std::filesystem::current_path() / "apps/bench/xdf_read.cc").string());
  if (std::system(compile.c_str()) != 0) return report.skip("xdf_read_back", "libxdf-dev is not installed");
  const study::LoggedSession session{1, "P1", "s & <t>", "", 0, 1234.5};
  std::vector<study::Record> records;
  Random random(9);
  for (int i = 0; i < (setup.is_quick ? 600 : 6000); ++i) {
    study::Frame frame{i * 16'667, 1.0 / 60.0, random.uniform(5.0f, 40.0f), {}, {}};
    frame.eye.world_from_camera =
        look_at({random.uniform(-9.0f, 9.0f), -10.0f, 1.7f}, {0.0f, random.uniform(), 1.0f});
    frame.wand = glm::vec3(random.uniform(), random.uniform(), 0.0f);
    if (i % 50 == 0)
      records.push_back(
          study::Event{frame.time_us, i % 100 == 0 ? "note" : "time over", i % 100 == 0 ? "à gauche" : ""});
    records.push_back(std::move(frame));
  }
  const auto is_read_as = [&](const std::string& bytes) {
    must(write_file(xdf, bytes));
    const std::string command =
        fmt::format("'{}' '{}' '{}' > /dev/null 2>&1", reader.string(), xdf.string(), found.string());
    return std::system(command.c_str()) == 0 && must(read_file(found)) == expected_of(session, records);
  };
  std::string bytes = study::xdf_of(session, records);
  report.add("xdf_read_back", is_read_as(bytes) ? 1.0 : 0.0);
  bytes[bytes.size() / 2] = char(bytes[bytes.size() / 2] ^ 1);  // within a sample
  report.add("xdf_read_back_of_one_bit_changed", is_read_as(bytes) ? 1.0 : 0.0);
}

}  // namespace parvis::bench
