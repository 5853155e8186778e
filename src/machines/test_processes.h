// Threads in the place of processes, for tests of what processes do together.
#pragma once

#include <algorithm>
#include <array>
#include <barrier>
#include <string>
#include <thread>

#include "machines/processes.h"

namespace parvis::machines {

/// Two threads in the place of two processes: each waits for the other where they share.
class ThreadProcesses final : public Collectives {
 public:
  /// One of `count` processes that never meet the others.
  static Processes alone(int rank, int count) {
    Processes process;
    process.rank_ = rank, process.count_ = count;
    return process;
  }
  /// One of the two.
  Processes process(int rank) const {
    Processes process = alone(rank, 2);
    process.collectives_ = this;
    return process;
  }

  void sum(int rank, std::span<double> values) const override {
    values_[std::size_t(rank)] = values;
    barrier_.arrive_and_wait();
    std::vector<double> all(values.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = values_[0][i] + values_[1][i];
    barrier_.arrive_and_wait();
    std::ranges::copy(all, values.begin());
  }
  void share_of_first(int rank, std::string& bytes) const override {
    if (rank == 0) of_first_ = &bytes;
    barrier_.arrive_and_wait();
    if (rank != 0) bytes = *of_first_;
    barrier_.arrive_and_wait();
  }

 private:
  mutable std::barrier<> barrier_{2};
  mutable std::array<std::span<double>, 2> values_;
  mutable const std::string* of_first_ = nullptr;
};

/// Results of `work` in each of two processes.
template <class Work>
auto in_two_processes(Work&& work) {
  const ThreadProcesses processes;
  std::array<decltype(work(processes.process(0))), 2> results;
  {
    std::jthread other([&] { results[1] = work(processes.process(1)); });
    results[0] = work(processes.process(0));
  }
  return results;
}

}  // namespace parvis::machines
