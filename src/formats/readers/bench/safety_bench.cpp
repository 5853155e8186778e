#include "formats/readers/bench/safety_bench.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "bench/scratch_folder.h"
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

/// The fuzzer of ROOM/fuzz/READER.cpp below a build folder, which repeats the folders of the sources.
fs::path fuzzer(const fs::path& build, const fs::path& source) {
  const fs::path room = source.parent_path().parent_path();
  return build / room / fmt::format("{}_{}_fuzz", room.filename().string(), source.stem().string());
}

/// Every source src/ROOM/fuzz/READER.cpp and src/DISTRICT/ROOM/fuzz/READER.cpp.
std::vector<fs::path> fuzzer_sources() {
  std::vector<fs::path> sources;
  std::error_code code;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator("src", code))
    if (entry.path().extension() == ".cpp" && entry.path().parent_path().filename() == "fuzz")
      sources.push_back(entry.path());
  std::ranges::sort(sources);
  return sources;
}

std::size_t file_count(const fs::path& folder) {
  return std::size_t(std::distance(fs::directory_iterator(folder), {}));
}

/// New inputs at which a reader fails, over a few seconds.
std::size_t findings_of_fuzzer(const fs::path& program, int seconds, const fs::path& folder) {
  const fs::path found = folder / program.filename(), corpus = folder / "corpus" / program.filename();
  fs::create_directories(found);
  fs::create_directories(corpus);
  static_cast<void>(output_of(fmt::format(
      "ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1 '{}' -max_total_time={} -timeout=20 "
      "-rss_limit_mb=2048 -artifact_prefix='{}/' -verbosity=0 '{}' 2>&1",
      program.string(), seconds, found.string(), corpus.string())));
  return file_count(found);
}

/// Inputs of old at which a reader fails again.
std::size_t findings_kept(const fs::path& program, const fs::path& source) {
  std::size_t findings = 0;
  const fs::path found = source.parent_path() / "found";
  if (!fs::exists(found)) return 0;
  for (const fs::directory_entry& input : fs::directory_iterator(found))
    if (input.path().filename().string().starts_with(source.stem().string() + "-"))
      findings +=
          std::system(
              fmt::format("'{}' '{}' > /dev/null 2>&1", program.string(), input.path().string()).c_str()) !=
          0;
  return findings;
}

Status measure_fuzzers(const fs::path& folder, int seconds, Report& report) {
  std::size_t findings = 0;
  int fuzzed = 0, read = 0;
  for (const fs::path& source : fuzzer_sources()) {
    if (const fs::path program = fuzzer("build/asan", source); fs::exists(program)) {
      findings += findings_of_fuzzer(program, seconds, folder);
      ++fuzzed;
    } else if (const fs::path reader = fuzzer("build/release", source); fs::exists(reader)) {
      findings += findings_kept(reader, source);
      ++read;
    }
  }
  if (fuzzed + read == 0) {
    report.skip("fuzz_findings", "no fuzzer is built; script/fuzz builds them");
    return Done{};
  }
  report.add("fuzz_findings", double(findings));
  report.note(
      fmt::format("{} readers fuzzed for {} s each; {} more read the inputs once found (script/fuzz builds "
                  "their fuzzers)",
                  fuzzed, seconds, read));
  return Done{};
}

}  // namespace

Status measure_safety(const BenchSetup& setup, Report& report) {
  const ScratchFolder folder;
  std::error_code code;
  fs::create_directories(folder.path, code);
  if (code) return error("{}: {}", folder.path.string(), code.message());
  if (Status status = measure_validator(folder.path, report); !status) return status;
  return measure_fuzzers(folder.path, setup.is_quick ? 2 : 10, report);
}

}  // namespace parvis::bench
