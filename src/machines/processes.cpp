#include "machines/processes.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "machines/requests.h"

namespace parvis::machines {
namespace {

constexpr std::size_t max_per_call = std::size_t{1} << 24;  // MPI counts in int; pieces pass through caches

/// Copies the first process's bytes into those of all others.
void share(void* bytes, std::size_t size) {
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibcast(bytes, int(size), MPI_BYTE, 0, MPI_COMM_WORLD, &request);
  // It polls, where MPI_Wait would spin. NOLINTNEXTLINE(clang-analyzer-optin.mpi.MPI-Checker)
  wait_for(request);
}

template <class Value>
void sum_of_all(std::span<Value> values, MPI_Datatype type) {
  for (std::size_t first = 0; first < values.size(); first += max_per_call) {
    const int count = int(std::min(max_per_call, values.size() - first));
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Iallreduce(MPI_IN_PLACE, values.data() + first, count, type, MPI_SUM, MPI_COMM_WORLD, &request);
    // It polls, where MPI_Wait would spin. NOLINTNEXTLINE(clang-analyzer-optin.mpi.MPI-Checker)
    wait_for(request);
  }
}

}  // namespace

Result<Processes> Processes::join() {
  Processes processes;
  if (!std::getenv("OMPI_COMM_WORLD_SIZE")) return processes;
  int provided = 0;
  // One thread at a time: the first process hands out work from a thread of its own (divided_work.cpp).
  if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided) != MPI_SUCCESS ||
      provided < MPI_THREAD_SERIALIZED)
    return error("MPI does not start, or not for programs with threads, though mpirun has started this one");
  processes.is_joined_ = true;
  MPI_Comm_rank(MPI_COMM_WORLD, &processes.rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &processes.count_);
  if (!processes.is_first() && !std::freopen("/dev/null", "w", stdout))
    return error("the standard output of process {} cannot be discarded", processes.rank_);
  return processes;
}

void Processes::wait_for_all() const {
  if (!are_several()) return;
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibarrier(MPI_COMM_WORLD, &request);
  // It polls, where MPI_Wait would spin. NOLINTNEXTLINE(clang-analyzer-optin.mpi.MPI-Checker)
  wait_for(request);
}

void Processes::wait_for_all(
    const std::function<void(std::span<const int> missing, double seconds)>& report) const {
  if (!are_several() || !is_joined_) return;
  // Each says to each that it is here, so that everyone knows who is not.
  constexpr int here_tag = 100;
  std::vector<int> from(std::size_t(count_), 0), missing;
  std::vector<MPI_Request> sent, received(std::size_t(count_), MPI_REQUEST_NULL);
  for (int other = 0; other < count_; ++other) {
    if (other == rank_) continue;
    missing.push_back(other);
    MPI_Irecv(&from[std::size_t(other)], 1, MPI_INT, other, here_tag, MPI_COMM_WORLD,
              &received[std::size_t(other)]);
    MPI_Isend(&rank_, 1, MPI_INT, other, here_tag, MPI_COMM_WORLD, &sent.emplace_back(MPI_REQUEST_NULL));
  }
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  for (double reported_s = 0.0; !missing.empty();) {
    std::erase_if(missing, [&](int other) {
      int is_here = 0;
      MPI_Test(&received[std::size_t(other)], &is_here, MPI_STATUS_IGNORE);
      return is_here != 0;
    });
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    if (!missing.empty() && seconds >= reported_s + 1.0) {
      reported_s = seconds;
      int first = 0;  // of those that are here
      while (std::ranges::find(missing, first) != missing.end()) ++first;
      if (first == rank_) report(missing, seconds);
    }
    if (!missing.empty()) std::this_thread::sleep_for(poll_interval);
  }
  for (const MPI_Request request : sent) wait_for(request);
}

void Processes::share_of_first(std::string& bytes) const {
  if (!are_several()) return;
  if (collectives_) return collectives_->share_of_first(rank_, bytes);
  unsigned long long size = bytes.size();
  share(&size, sizeof size);
  bytes.resize(size);
  for (std::size_t first = 0; first < bytes.size(); first += max_per_call)
    share(bytes.data() + first, std::min(max_per_call, bytes.size() - first));
}

void Processes::sum(std::span<float> values) const {
  if (are_several()) sum_of_all(values, MPI_FLOAT);
}

void Processes::sum(std::span<double> values) const {
  if (!are_several()) return;
  if (collectives_) return collectives_->sum(rank_, values);
  sum_of_all(values, MPI_DOUBLE);
}

bool Processes::any_of(bool holds) const {
  double count = holds ? 1.0 : 0.0;
  sum(std::span(&count, 1));
  return count > 0.0;
}

void Processes::give_up() const {
  if (is_joined_) MPI_Abort(MPI_COMM_WORLD, 1);
  std::abort();
}

void Processes::leave() const {
  if (!is_joined_) return;
  wait_for_all();
  MPI_Finalize();
}

}  // namespace parvis::machines
