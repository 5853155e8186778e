#include "bench/readers/isolation_bench.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>

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

/// What reading a file in a child takes beyond reading it here.
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

Status measure_isolation(const BenchSetup& setup, Report& report) {
  const ScratchFolder folder;
  std::error_code code;
  fs::create_directories(folder.path, code);
  if (code) return error("{}: {}", folder.path.string(), code.message());
  const auto hague = shared_data("cities/DenHaag_01.city.json", fs::current_path()),
             car = shared_data("cars/p406/p406.obj", fs::current_path());
  if (!hague || !car) {
    report.skip("isolated_reader_overhead_ms", "the shared data is absent");
    return Done{};
  }
  const fs::path picture = folder.path / "picture.jpg";
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
  report.note(fmt::format("shortest readings: {:.1f}, {:.1f} and {:.1f} ms longer in a child than here",
                          of_hague.min_ms, of_car.min_ms, of_picture.min_ms));
  return Done{};
}

}  // namespace parvis::bench
