// The cost of reading files in child processes.

#include <algorithm>
#include <cstdint>
#include <limits>

#include "base/files.h"
#include "base/image_io.h"
#include "base/isolated_process.h"
#include "base/test_data.h"
#include "bench/parts.h"
#include "formats/city_models/city_json.h"
#include "formats/meshes/assimp_reader.h"
#include "formats/readers/readers.h"

namespace parvis::bench {
namespace {
namespace fs = std::filesystem;

/// Time and memory of reading a file in a child beyond those of reading it here.
struct Overhead {
  Median ms;
  double min_ms = 0.0;  ///< between the shortest readings, in a child and here
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
  double min_there_ms = std::numeric_limits<double>::max(), min_here_ms = min_there_ms;
  for (int i = 0; i < repeats; ++i) {
    const double there_ms = read_ms(isolated, measured.workers_isolated);
    const WithoutIsolation baseline;  // of the pictures of models, too
    const double here_ms = read_ms(here, measured.workers_here);
    min_there_ms = std::min(min_there_ms, there_ms), min_here_ms = std::min(min_here_ms, here_ms);
    samples.push_back(there_ms - here_ms);
  }
  measured.ms = median(samples);
  measured.min_ms = min_there_ms - min_here_ms;
  return measured;
}

}  // namespace

void measure_isolation(const BenchSetup& setup, Report& report) {
  const auto hague = shared_data("cities/DenHaag_01.city.json", fs::current_path()),
             car = shared_data("cars/p406/p406.obj", fs::current_path());
  if (!hague || !car) return report.skip("isolated_reader_overhead_ms", "the shared data is absent");
  const fs::path picture = setup.folder / "picture.jpg";
  Image8 image(4096, 2160, 3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = std::uint8_t(i * 2654435761u >> 24);
  must(write_image(picture, image));
  const formats::Readers& readers = rooms::all_registries().get<formats::Readers>();
  Errors warnings;
  const auto isolated = [&](const fs::path& file) {
    return [&, file] { return readers.read(file, {}, warnings).ok(); };
  };
  const int repeats = setup.is_quick ? 5 : 21;
  std::vector<double> medians;
  for (const auto& [name, in_child, here] :
       {std::tuple<const char*, std::function<bool()>, std::function<bool()>>{
            "The Hague", isolated(*hague), [&] { return scene::read_city_model(*hague, warnings).ok(); }},
        {"the p406", isolated(*car),
         [&] { return scene::read_with_assimp(*car, formats::UpAxis::file, warnings).ok(); }},
        {"a JPEG of 4096 x 2160 pixels", [&] { return read_image8(picture).ok(); },
         [&] { return read_image8(picture).ok(); }}}) {
    const Overhead of = overhead(in_child, here, repeats);
    if (!of.is_read) fail("{}: a file of the overhead of child processes cannot be read", name);
    if (of.workers_isolated <= of.workers_here)
      fail("{}: the overhead of child processes is measured without any", name);
    medians.push_back(of.ms.value);
    report.note(fmt::format("{}: {:.1f} ms, shortest readings {:.1f} ms longer in a child", name, of.ms.value,
                            of.min_ms));
  }
  report.add("isolated_reader_overhead_ms", median(medians).value);  // the one in the middle
}

}  // namespace parvis::bench
