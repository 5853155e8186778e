#include "formats/readers/bench/attack_bench.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <tuple>

#include "base/files.h"
#include "base/image_io.h"
#include "base/isolated_process.h"
#include "base/picture_codec.h"
#include "base/test_data.h"
#include "bench/scratch_folder.h"
#include "formats/city_models/city_json.h"
#include "formats/meshes/assimp_reader.h"

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

/// What reading a file in a child takes beyond reading it here.
struct Overhead {
  Median ms;
  bool is_read = true;
  std::uint64_t workers_isolated = 0, workers_here = 0;  ///< that one reading began
};

Overhead overhead(const std::function<bool()>& isolated, const std::function<bool()>& here, int repeats) {
  Overhead measured;
  const auto read_ms = [&](const std::function<bool()>& read, std::uint64_t& workers) {
    const std::uint64_t before = begun_workers();
    const double ms = milliseconds([&] { measured.is_read = read() && measured.is_read; });
    workers = begun_workers() - before;
    return ms;
  };
  std::vector<double> samples;
  for (int i = 0; i < repeats; ++i) {
    const double there_ms = read_ms(isolated, measured.workers_isolated);
    samples.push_back(there_ms - read_ms(here, measured.workers_here));
  }
  measured.ms = median(samples);
  return measured;
}

Status measure_overhead(const BenchSetup& setup, const fs::path& folder, Report& report) {
  const auto hague = shared_data("cities/DenHaag_01.city.json", fs::current_path()),
             car = shared_data("cars/p406/p406.obj", fs::current_path());
  if (!hague || !car) {
    report.skip("isolated_reader_overhead_ms", "the shared data is absent");
    return Done{};
  }
  const fs::path picture = folder / "picture.jpg";
  Image8 image(4096, 2160, 3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = std::uint8_t(i * 2654435761u >> 24);
  if (Status status = write_image(picture, image); !status) return status;
  const formats::Readers& readers = setup.house.get<formats::Readers>();
  Errors warnings;
  const auto isolated = [&](const fs::path& file) {
    return [&, file] { return readers.read(file, {}, warnings).ok(); };
  };
  const int repeats = setup.is_quick ? 5 : 21;
  const Overhead of_hague = overhead(
      isolated(*hague), [&] { return scene::read_city_model(*hague, warnings).ok(); }, repeats);
  const Overhead of_car = overhead(
      isolated(*car), [&] { return scene::read_with_assimp(*car, formats::UpAxis::file, warnings).ok(); },
      repeats);
  const Overhead of_picture = overhead(
      [&] { return read_image8(picture).ok(); },
      [&] {
        const Result<std::string> bytes = read_file(picture);
        return bytes && decode_image8({reinterpret_cast<const std::uint8_t*>(bytes->data()), bytes->size()},
                                      "picture.jpg")
                            .ok();
      },
      repeats);
  for (const Overhead& of : {of_hague, of_car, of_picture}) {
    if (!of.is_read) return error("a file of the overhead of child processes cannot be read");
    report.note(fmt::format("control: a reading begins {} child processes, without isolation {}",
                            of.workers_isolated, of.workers_here));
    if (of.workers_isolated <= of.workers_here)
      return error("the overhead of child processes is measured without any");
  }
  report.add("isolated_reader_overhead_ms",
             median({of_hague.ms.value, of_car.ms.value, of_picture.ms.value}).value);
  report.note(
      fmt::format("isolated_reader_overhead_ms: the Hague {:.1f} ms, the p406 {:.1f} ms, a JPEG of 4096 x "
                  "2160 pixels {:.1f} ms "
                  "(medians of {} pairs; the one in the middle counts)",
                  of_hague.ms.value, of_car.ms.value, of_picture.ms.value, repeats));
  return Done{};
}

}  // namespace

Status measure_attacks(const BenchSetup& setup, Report& report) {
  const ScratchFolder folder;
  std::error_code code;
  fs::create_directories(folder.path, code);
  if (code) return error("{}: {}", folder.path.string(), code.message());
  if (Status status = measure_overhead(setup, folder.path, report); !status) return status;
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
