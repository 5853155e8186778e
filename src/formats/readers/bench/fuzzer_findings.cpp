#include "formats/readers/bench/fuzzer_findings.h"

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "base/files.h"
#include "bench/own_program.h"

namespace parvis::bench {
namespace {
namespace fs = std::filesystem;

constexpr const char* compiler = "clang++-19";
constexpr const char* key = "fuzz_findings";
constexpr const char* with_sanitizers = "ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1";

/// A reader that reads past the end of its input. Chance does not find the way there: it begins at a seed.
constexpr const char* planted_reader = R"(#include <cstddef>
#include <cstdint>
#include <vector>

constexpr std::size_t head_size = 8;

template <class Byte>
constexpr std::uint64_t hash_of(const Byte* head) {
  std::uint64_t hash = 14695981039346656037ull;
  for (std::size_t i = 0; i < head_size; ++i) hash = (hash ^ std::uint8_t(head[i])) * 1099511628211ull;
  return hash;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::uint64_t head = hash_of("planted ");
  if (size <= head_size || hash_of(data) != head || data[head_size] < 'b') return 0;
  const std::vector<std::uint8_t> copy(data, data + size);
  [[maybe_unused]] volatile std::uint8_t beyond = copy.data()[size];
  return 0;
}
)";
constexpr const char* planted_seed = "planted a";

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

/// Where script/fuzz begins, too.
std::vector<fs::path> seeds_of(const fs::path& source) {
  std::vector<fs::path> seeds{source.parent_path() / "corpus" / source.stem()};
  if (source.stem() == "script") seeds.emplace_back("scenes");
  std::erase_if(seeds, [](const fs::path& folder) { return !fs::exists(folder); });
  return seeds;
}

/// Inputs of old at which a reader fails again.
std::size_t findings_kept(const fs::path& program, const fs::path& source) {
  std::size_t findings = 0;
  const fs::path found = source.parent_path() / "found";
  if (!fs::exists(found)) return 0;
  for (const fs::directory_entry& input : fs::directory_iterator(found))
    if (input.path().filename().string().starts_with(source.stem().string() + "-"))
      findings += std::system(fmt::format("{} '{}' '{}' > /dev/null 2>&1", with_sanitizers, program.string(),
                                          input.path().string())
                                  .c_str()) != 0;
  return findings;
}

/// Builds the reader with the planted fault, and its seed.
Result<fs::path> planted_fuzzer(const fs::path& folder) {
  const fs::path source = folder / "planted.cpp", program = folder / "planted_fuzz";
  if (Status status = write_file(source, planted_reader); !status) return status.errors();
  std::error_code code;
  fs::create_directories(folder / "seeds", code);
  if (Status status = write_file(folder / "seeds" / "planted", planted_seed); !status) return status.errors();
  if (std::system(fmt::format("{} -std=c++20 -O1 -g1 -fsanitize=address,fuzzer '{}' -o '{}' > /dev/null 2>&1",
                              compiler, source.string(), program.string())
                      .c_str()) != 0)
    return error("{}: {} does not build it, so that {} has no control", source.string(), compiler, key);
  return program;
}

/// What readers make of the inputs once found, where there are no fuzzers.
void read_found_inputs(const std::vector<fs::path>& sources, Report& report) {
  std::size_t failures = 0;
  int read = 0;
  for (const fs::path& source : sources)
    if (const fs::path reader = fuzzer("build/release", source); fs::exists(reader)) {
      failures += findings_kept(reader, source);
      ++read;
    }
  if (read == 0) return;
  report.add("found_inputs_that_fail", double(failures));
  report.note(fmt::format("{} readers without sanitizers have read the inputs once found", read));
}

}  // namespace

std::size_t findings_of_fuzzer(const fs::path& program, std::span<const fs::path> seeds, int seconds,
                               const fs::path& folder) {
  const fs::path found = folder / "found" / program.filename(),
                 corpus = folder / "corpus" / program.filename();
  fs::create_directories(found);
  fs::create_directories(corpus);
  std::string command = fmt::format(
      "{} '{}' -max_total_time={} -timeout=20 -rss_limit_mb=2048 -artifact_prefix='{}/' -verbosity=0 '{}'",
      with_sanitizers, program.string(), seconds, found.string(), corpus.string());
  for (const fs::path& seed : seeds) command += fmt::format(" '{}'", seed.string());
  const bool has_failed = std::system((command + " > /dev/null 2>&1").c_str()) != 0;
  std::size_t inputs = 0;
  for (const fs::directory_entry& input : fs::directory_iterator(found))  // slow ones are no failures
    inputs += !input.path().filename().string().starts_with("slow-unit-");
  return std::max(inputs, std::size_t(has_failed));
}

Status measure_fuzzers(const fs::path& folder, int seconds, Report& report) {
  const std::vector<fs::path> sources = fuzzer_sources();
  const auto built = std::ranges::count_if(
      sources, [](const fs::path& source) { return fs::exists(fuzzer("build/asan", source)); });
  if (sources.empty() || std::size_t(built) < sources.size() || !has_program(compiler)) {
    report.skip(key,
                fmt::format("needs {} and all fuzzers, of which {} of {} are built; script/fuzz builds them",
                            compiler, built, sources.size()));
    read_found_inputs(sources, report);
    return Done{};
  }
  const Result<fs::path> planted = planted_fuzzer(folder);
  if (!planted) return planted.errors();
  std::size_t findings = 0;
  for (const fs::path& source : sources) {
    const fs::path program = fuzzer("build/asan", source);
    findings +=
        findings_of_fuzzer(program, seeds_of(source), seconds, folder) + findings_kept(program, source);
  }
  report.add(key, double(findings), up_to(0.0));
  report.note(fmt::format("{} readers fuzzed for {} s each, from their seeds on", sources.size(), seconds));
  const fs::path seeds = folder / "seeds";
  report.add_control(fmt::format("{}_of_a_planted_fault", key),
                     double(findings_of_fuzzer(*planted, std::span(&seeds, 1), seconds, folder)), up_to(0.0));
  return Done{};
}

}  // namespace parvis::bench
