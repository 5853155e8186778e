// Waiting for MPI without spinning: Open MPI's own waits keep a core busy, which the others may need.
#pragma once

#define OMPI_SKIP_MPICXX  // the C++ binding, gone from MPI 3, would have to be linked
#include <mpi.h>

#include <chrono>
#include <thread>

namespace parvis::machines {

/// How often a process that waits looks.
inline constexpr std::chrono::microseconds poll_interval{200};

/// Waits for a request that has been begun.
inline void wait_for(MPI_Request request) {
  for (int is_done = 0;;) {
    MPI_Test(&request, &is_done, MPI_STATUS_IGNORE);
    if (is_done) return;
    std::this_thread::sleep_for(poll_interval);
  }
}

}  // namespace parvis::machines
