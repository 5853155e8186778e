// The reconstruction by two processes that mpirun starts, against one process: the largest difference of a
// cell's transparency. The control is one process whose opacities stop an iteration earlier. Two processes
// that each did all the work by itself would not differ either: the command says how many worked together.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "base/files.h"
#include "bench/scratch_folder.h"
#include "bench/trees/reconstructed_tree.h"
#include "capture/trees/capture_folder.h"
#include "capture/trees/tree_file.h"

namespace parvis::trees {
namespace {

constexpr int photographs = 12, iterations = 20;
constexpr bench::Target max_difference_target{1e-5, false};

/// Transparencies by the places of the cells.
using Cells = std::map<std::tuple<int, int, int>, double>;

/// How the command is run.
struct Run {
  std::string before;  ///< what starts it
  int processes = 1;   ///< that work together then
  int iterations = trees::iterations;
};

/// The cells that a run of the command finds.
Result<Cells> cells_of_run(const std::filesystem::path& program, const std::filesystem::path& folder,
                           const Run& run) {
  const std::filesystem::path file = folder / "run.volume", log = folder / "run.log";
  std::error_code code_of_removal;
  std::filesystem::remove(file, code_of_removal);  // it is that of the run before
  const std::string command = fmt::format(
      "{}'{}' tree reconstruct '{}' -o '{}' --level 3 --iterations {} > '{}' 2>&1", run.before,
      program.string(), (folder / "capture").string(), file.string(), run.iterations, log.string());
  if (const int code = std::system(command.c_str()); code != 0)
    return error("this command ended with {}: {}", code, command);
  const Result<std::string> report = read_file(log);
  if (!report) return report.errors();
  if (!says_processes(*report, run.processes))
    return error("{} processes were to work together, but this command does not say so: {}", run.processes,
                 command);
  const Result<TreeVolume> volume = read_volume(file);
  if (!volume) return volume.errors();
  Cells cells;
  for (std::size_t i = 0; i < volume->grid.size(); ++i) {
    const glm::ivec3 place(volume->grid.cells()[i]);
    cells[{place.x, place.y, place.z}] = 1.0 - double(volume->alpha(i));
  }
  if (cells.empty()) return error("{}: no cells were found", file.string());
  return cells;
}

/// A cell that only one of the two has counts as a difference of all its opacity.
double max_difference(const Cells& a, const Cells& b) {
  double max = 0.0;
  const auto compare = [&](const Cells& these, const Cells& those) {
    for (const auto& [place, transparency] : these) {
      const auto other = those.find(place);
      max = std::max(max, std::abs(transparency - (other == those.end() ? 1.0 : other->second)));
    }
  };
  compare(a, b), compare(b, a);
  return max;
}

}  // namespace

bool says_processes(std::string_view report, int count) {
  return report.find(fmt::format(" MB, {} process{}\n", count, count == 1 ? "" : "es")) !=
         std::string_view::npos;
}

Status measure_distribution(const FigureOptions& options, const std::filesystem::path& program,
                            bench::Report& report) {
  const std::string key = "mpi_2_over_1_difference",
                    mpirun = "mpirun --allow-run-as-root --oversubscribe -n 2 ";
  if (std::system("mpirun --version > /dev/null 2>&1") != 0) {
    report.skip(key, "there is no mpirun here: package openmpi-bin");
    return Done{};
  }
  BenchCaptureSize size = bench_capture_size(options);
  size.held_out = 1;
  const Result<SampleCapture> capture = sample_capture("winter", photographs, size);
  if (!capture) return capture.errors();
  const bench::ScratchFolder folder;
  if (Status status = write_capture(folder.path / "capture", capture->views); !status) return status;
  const Result<Cells> one = cells_of_run(program, folder.path, {});
  if (!one) return one.errors();
  const Result<Cells> two = cells_of_run(program, folder.path, {mpirun, 2});
  if (!two) return two.errors();
  const Result<Cells> less = cells_of_run(program, folder.path, {"", 1, iterations - 1});
  if (!less) return less.errors();
  report.add(key, max_difference(*one, *two), max_difference_target);
  report.add_control(key + "_one_iteration_less", max_difference(*one, *less), max_difference_target);
  return Done{};
}

}  // namespace parvis::trees
