// Processes that reconstruct one tree together (MPI): each casts the rays of its share of the pixels, and
// what they gather is added up once per iteration. All read all photographs, for a cell of the hull is
// compared with each; of the linear light that the fit needs, which is most of the memory, each holds its own
// rows alone (fit_rows.h). All end with the same cells: their sums are exact (exact_sum.h), so that they are
// those of one process.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "base/result.h"

namespace parvis::trees {

/// This process among them. By itself: one.
struct Processes {
  int rank = 0, count = 1;
  /// Adds up, element by element, what all processes have (an all-reduce). Empty where there is but one.
  std::function<void(std::span<double>)> sum = {};

  /// Is a share of the work this process's?
  bool has(std::size_t share) const { return share % std::size_t(count) == std::size_t(rank); }
};

/// Does it hold in any of the processes?
bool holds_in_any(const Processes& processes, bool holds);
/// The first process's bytes, in all of them.
void share_of_first(const Processes& processes, std::string& bytes);

/// Membership in what `mpirun` started, for as long as it lives.
class MpiSession {
 public:
  /// Joins the other processes if the program was started by Open MPI's mpirun; else MPI is not touched.
  /// Errors: what MPI says.
  static Result<MpiSession> join();
  MpiSession(MpiSession&& other) noexcept;
  MpiSession& operator=(MpiSession&&) = delete;
  ~MpiSession();

  /// One, where there is no MPI.
  Processes processes() const;

 private:
  explicit MpiSession(bool is_joined) : is_joined_(is_joined) {}
  bool is_joined_;
};

}  // namespace parvis::trees
