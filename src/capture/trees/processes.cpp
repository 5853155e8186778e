#include "capture/trees/processes.h"

#define OMPI_SKIP_MPICXX  // the interface for C alone: that for C++ would be a library of its own
#include <mpi.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace parvis::trees {
namespace {

constexpr std::size_t max_per_call = std::size_t{1}
                                     << 24;  // MPI counts in int; pieces pass through caches, too

void all_reduce(std::span<double> values) {
  for (std::size_t first = 0; first < values.size(); first += max_per_call) {
    const int count = int(std::min(max_per_call, values.size() - first));
    MPI_Allreduce(MPI_IN_PLACE, values.data() + first, count, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  }
}

}  // namespace

Result<MpiSession> MpiSession::join() {
  if (!std::getenv("OMPI_COMM_WORLD_SIZE")) return MpiSession(false);
  int provided = 0;
  if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided) != MPI_SUCCESS)
    return error("MPI does not start, though mpirun has started the program");
  return MpiSession(true);
}

MpiSession::MpiSession(MpiSession&& other) noexcept : is_joined_(std::exchange(other.is_joined_, false)) {}

MpiSession::~MpiSession() {
  if (is_joined_) MPI_Finalize();
}

Processes MpiSession::processes() const {
  Processes processes;
  if (!is_joined_) return processes;
  MPI_Comm_rank(MPI_COMM_WORLD, &processes.rank);
  MPI_Comm_size(MPI_COMM_WORLD, &processes.count);
  if (processes.count > 1) processes.sum = all_reduce;
  return processes;
}

}  // namespace parvis::trees
