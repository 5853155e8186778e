// The processes that `mpirun` has started with the same command, on one machine or several (MPI 3.1; Open
// MPI). A command that divides its work joins them, divides (divided_work.h) and, when all is done, leaves.
// Without mpirun it is one process, and MPI is not touched.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "base/result.h"

namespace parvis::machines {

/// Collective operations where it is not MPI that does them: tests have threads in place of processes.
class Collectives {
 public:
  virtual ~Collectives() = default;
  virtual void share_of_first(int rank, std::string& bytes) const = 0;
  virtual void sum(int rank, std::span<double> values) const = 0;
};

/// This process among them. Made once in a program; all processes make the same calls in the same order.
/// A process that ends before it calls `leave` (an error, a crash) makes mpirun end all others with status 1
/// or more.
class Processes {
 public:
  /// One process, by itself.
  Processes() = default;
  /// Joins the processes that Open MPI's mpirun has started; else there is one. Of all but the first the
  /// standard output is discarded from here on: they print the same. Errors: what MPI says.
  static Result<Processes> join();

  int rank() const { return rank_; }               ///< from 0
  int count() const { return count_; }             ///< of all of them
  bool is_first() const { return rank_ == 0; }     ///< the one that writes files
  bool are_several() const { return count_ > 1; }  ///< false: by itself
  /// Is a share of the work this process's, where shares are dealt out in turn?
  bool has(std::size_t share) const { return share % std::size_t(count_) == std::size_t(rank_); }

  /// Waits until all processes have called it; waiting takes no processor time.
  void wait_for_all() const;
  /// The same; each time that a second has passed, `report` learns which processes have not, and for how long
  /// they are waited for. Only the first of those that wait calls it.
  void wait_for_all(const std::function<void(std::span<const int> missing, double seconds)>& report) const;
  /// The first process's bytes, in every process.
  void share_of_first(std::string& bytes) const;
  /// Adds up, element by element, what all processes have; each receives the sums. The order of summation is
  /// MPI's: the last bits depend on the number of processes, unless the sums are exact.
  void sum(std::span<float> values) const;
  /// The same in double precision.
  void sum(std::span<double> values) const;
  /// True in every process where `holds` is true in any of them.
  bool any_of(bool holds) const;
  /// Waits for all others and ends the membership: the work is done. Nothing may be called after it.
  void leave() const;
  /// Ends all processes at once, with status 1: one of them does not answer.
  [[noreturn]] void give_up() const;

 private:
  friend class ThreadProcesses;  // test_processes.h

  int rank_ = 0, count_ = 1;
  bool is_joined_ = false;
  const Collectives* collectives_ = nullptr;  ///< null: MPI's
};

}  // namespace parvis::machines
