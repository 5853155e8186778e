#include "bench/processes_bench.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <array>

#include "base/files.h"
#include "bench/benches.h"
#include "bench/own_program.h"
#include "bench/scratch_folder.h"
#include "places/paper_city/paper_city.h"

namespace parvis::bench {
namespace {
namespace fs = std::filesystem;

constexpr std::array part_names{"photograph", "bake"};

// One core for each process is one thread for each; so it is for OpenGL in software.
constexpr const char* alone = "env LP_NUM_THREADS=1 taskset -c 0";
constexpr const char* two_cores =
    "env LP_NUM_THREADS=1 mpirun --allow-run-as-root --bind-to core --map-by core -n 2";
constexpr const char* one_core =  // the control
    "env LP_NUM_THREADS=1 taskset -c 0 mpirun --allow-run-as-root --oversubscribe --bind-to none -n 2";

/// How long a command takes, and of that what is divided between processes.
struct Seconds {
  double of_work, of_command;
};

/// The work: the tiles of a photograph, without what each process does before them.
Result<Seconds> photograph_s(const std::string& before, const fs::path& folder, bool is_quick) {
  const Result<OwnRun> run = run_own_program(
      before, {"reference", (folder / "paper.xp").string(), "--path-traced", "--camera", "street", "--size",
               is_quick ? "320x180" : "640x360", "--samples", "16", "-o", (folder / "photo.png").string()});
  if (!run) return run.errors();
  const Result<double> tracing_s = number_after(run->output, "million rays in ");
  if (!tracing_s) return tracing_s.errors();
  return Seconds{*tracing_s, run->seconds};
}

/// The work: a bake, without a bake that finds all of it done.
Result<Seconds> bake_s(const std::string& before, const fs::path& folder) {
  fs::remove_all(folder / "some.baked");
  const std::vector<std::string> arguments{"bake", (folder / "some.xp").string()};
  const Result<OwnRun> whole = run_own_program(before, arguments), again = run_own_program(before, arguments);
  if (!whole) return whole.errors();
  if (!again) return again.errors();
  return Seconds{whole->seconds - again->seconds, whole->seconds};
}

/// The city with reference maps on a line along a road.
std::string script_with_maps(int count) {
  std::string script = "include(file=\"paper.xp\")\nreferenceMaps(";
  for (int i = 0; i < count; ++i)
    script += fmt::format("{}position=\"-74 {} 1.2\"", i == 0 ? "" : ", ", -400 + 800 * i / count);
  return script + ")\n";
}

constexpr Target wanted{1.7, true};

/// How many times sooner work is done by two processes than by one.
struct Speedups {
  std::vector<double> on_two_cores, on_one_core;  ///< of each work; the second is the control
};

Status report_speedup(const char* key, const std::function<Result<Seconds>(const char*)>& seconds_of,
                      Speedups& speedups, Report& report) {
  const Result<Seconds> by_one = seconds_of(alone), by_two = seconds_of(two_cores),
                        shared = seconds_of(one_core);
  for (const Result<Seconds>* seconds : {&by_one, &by_two, &shared})
    if (!*seconds) return seconds->errors();
  speedups.on_two_cores.push_back(by_one->of_work / by_two->of_work);
  speedups.on_one_core.push_back(by_one->of_work / shared->of_work);
  report.add(key, speedups.on_two_cores.back(), wanted);
  report.add(fmt::format("{}_of_the_whole_command", key), by_one->of_command / by_two->of_command);
  report.note(
      fmt::format("{}: {:.1f} s alone, {:.1f} s by two, {:.1f} s by two on one core, the control; "
                  "the whole command {:.1f}, {:.1f} and {:.1f} s",
                  key, by_one->of_work, by_two->of_work, shared->of_work, by_one->of_command,
                  by_two->of_command, shared->of_command));
  report.add_control(fmt::format("{}_on_one_core", key), speedups.on_one_core.back(), wanted);
  return Done{};
}

/// `speedup_2_processes`: what both works reach.
void report_both(const Speedups& speedups, Report& report) {
  if (speedups.on_two_cores.size() != part_names.size())
    return report.skip("speedup_2_processes", "is that of all parts, which were not all asked for");
  report.add("speedup_2_processes", std::ranges::min(speedups.on_two_cores), wanted);
  report.add_control("speedup_2_processes_on_one_core", std::ranges::max(speedups.on_one_core), wanted);
}

Status measure(const BenchSetup& setup, Report& report) {
  if (tbb::this_task_arena::max_concurrency() < 2 || !has_program("mpirun") || !has_program("taskset")) {
    report.skip("speedup_2_processes", "needs two cores and the programs mpirun and taskset");
    return Done{};
  }
  const ScratchFolder folder(setup.kept);
  if (Status written = city::write_paper_city(folder.path, 1); !written) return written.errors();
  if (Status status = write_file(folder.path / "some.xp", script_with_maps(setup.is_quick ? 40 : 160));
      !status)
    return status;
  Speedups speedups;
  const BenchPart parts[]{
      {part_names[0],
       [&] {
         return report_speedup(
             "speedup_2_processes_photograph",
             [&](const char* before) { return photograph_s(before, folder.path, setup.is_quick); }, speedups,
             report);
       }},
      {part_names[1], [&] {
         return report_speedup(
             "speedup_2_processes_bake", [&](const char* before) { return bake_s(before, folder.path); },
             speedups, report);
       }}};
  if (Status status = run_parts(setup, parts); !status) return status;
  report_both(speedups, report);
  return Done{};
}

}  // namespace

void add_processes(Benches& benches) {
  benches.add({"processes",
               "how much sooner two processes bake and take a photograph than one",
               measure,
               {part_names.begin(), part_names.end()}});
}

}  // namespace parvis::bench
