#include "formats/readers/bench/attack_bench.h"

#include <array>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <tuple>

#include "base/files.h"
#include "bench/scratch_folder.h"

namespace parvis::bench {
namespace {
namespace fs = std::filesystem;

constexpr std::array keys{"attack_cases", "attack_findings", "crashes",
                          "escapes",      "raw_exceptions",  "silent_losses"};
constexpr std::array survivals{std::pair{"kills", "kills_survived"},
                               std::pair{"allocation_failures", "allocation_failures_survived"}};

std::string text_of(const fs::path& file) {
  const Result<std::string> text = read_file(file);
  return text ? *text : "";
}

/// The file of this very program; empty where there is no /proc.
fs::path this_program() {
  std::error_code code;
  return fs::read_symlink("/proc/self/exe", code);
}

void skip_cases(const std::string& reason, Report& report) {
  for (const char* key : keys) report.skip(key, reason);
  for (const auto& [tried, survived] : survivals) report.skip(survived, reason);
}

Status measure_cases(const BenchSetup& setup, const fs::path& program, const fs::path& folder,
                     Report& report) {
  const auto attack = [&](const std::string& arguments) {
    return fmt::format("script/attack --parvis '{}' {}", program.string(), arguments);
  };
  if (std::system(attack(fmt::format("--controls > '{}'", (folder / "controls").string())).c_str()) != 0)
    return error("script/attack --controls: a control is not found, so its verdicts are worth nothing:\n{}",
                 text_of(folder / "controls"));
  const fs::path figures = folder / "figures.json", findings = folder / "findings";
  const std::string extent = setup.is_quick ? "--seconds 50 " : "";
  std::ignore = std::system(
      attack(fmt::format("{}--json '{}' > '{}'", extent, figures.string(), findings.string())).c_str());
  const Result<std::string> text = read_file(figures);
  if (!text) return text.errors();
  const nlohmann::json json = nlohmann::json::parse(*text, nullptr, false);
  if (!json.is_object()) return error("{}: is no report of script/attack", figures.string());
  for (const char* key : keys) report.add(key, json.value(key, -1.0));
  for (const auto& [tried, survived] : survivals) {
    if (setup.is_quick && !json.contains(survived)) {
      report.skip(survived, "none was reached in the time of --quick");
      continue;
    }
    report.add(survived, json.value(survived, -1.0));
    report.note(fmt::format("{}: of {} that were tried", survived, json.value(tried, 0)));
  }
  report.note(
      "script/attack finds each of its controls: stand-ins that crash, leak, show an exception or lose a "
      "result, and Parvis with writes that are lost, files that are never removed, an allocation that "
      "aborts");
  if (json.value("attack_findings", 1) != 0) report.note(text_of(findings));
  return Done{};
}

}  // namespace

Status measure_attacks(const BenchSetup& setup, Report& report) {
  const ScratchFolder folder;
  std::error_code code;
  fs::create_directories(folder.path, code);
  if (code) return error("{}: {}", folder.path.string(), code.message());
  const fs::path program = this_program();
  if (!fs::exists("script/attack"))
    skip_cases("script/attack is not in this folder", report);
  else if (program.empty())
    skip_cases("/proc does not tell where this program is", report);
  else
    return measure_cases(setup, program, folder.path, report);
  return Done{};
}

}  // namespace parvis::bench
