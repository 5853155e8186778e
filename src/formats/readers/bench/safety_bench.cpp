#include "formats/readers/bench/safety_bench.h"

#include <cstdio>

#include "bench/scratch_folder.h"
#include "formats/readers/bench/fuzzer_findings.h"
#include "places/paper_city/paper_city.h"

namespace parvis::bench {
namespace {
namespace fs = std::filesystem;

/// What a shell command prints.
std::string output_of(const std::string& command) {
  std::FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) return "";
  std::string text;
  char bytes[4096];
  while (const std::size_t count = std::fread(bytes, 1, sizeof(bytes), pipe)) text.append(bytes, count);
  pclose(pipe);
  return text;
}

Status measure_validator(const fs::path& folder, Report& report) {
  const std::string key = "gltf_validator_errors", script = "script/validate_gltf";
  if (!fs::exists(script)) {
    report.skip(key, script + " is not in this folder");
    return Done{};
  }
  if (Status status = city::write_paper_city(folder / "city", 1); !status) return status;
  const std::string told = output_of(fmt::format("{} '{}'/city/*.glb 2>&1", script, folder.string()));
  int errors = 0, files = 0;
  if (const std::size_t at = told.find(key); at == std::string::npos) {
    report.skip(key, told.substr(0, told.find('\n')));
  } else if (std::sscanf(told.c_str() + at, "gltf_validator_errors %d in %d files", &errors, &files) == 2) {
    report.add(key, errors);
    report.note(fmt::format("the validator read {} files of the paper's city", files));
  } else {
    return error("{}: cannot be understood: {}", script, told);
  }
  return Done{};
}

}  // namespace

Status measure_safety(const BenchSetup& setup, Report& report) {
  const ScratchFolder folder;
  std::error_code code;
  fs::create_directories(folder.path, code);
  if (code) return error("{}: {}", folder.path.string(), code.message());
  if (Status status = measure_validator(folder.path, report); !status) return status;
  constexpr int seconds = 20, quick_seconds = 2;  // of each fuzzer
  if (setup.is_quick)
    report.note(fmt::format("--quick: fuzz_findings is that of {} s for each reader, not of {} s",
                            quick_seconds, seconds));
  return measure_fuzzers(folder.path, setup.is_quick ? quick_seconds : seconds, report);
}

}  // namespace parvis::bench
