#include "capture/trees/processes.h"

#define OMPI_SKIP_MPICXX  // the interface for C alone: that for C++ would be a library of its own
#include <mpi.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <utility>
#include <vector>

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

bool holds_in_any(const Processes& processes, bool holds) {
  double count = holds ? 1.0 : 0.0;
  if (processes.sum) processes.sum({&count, 1});
  return count > 0.0;
}

void share_of_first(const Processes& processes, std::string& bytes) {
  if (!processes.sum) return;
  const bool is_first = processes.rank == 0;
  double size = is_first ? double(bytes.size()) : 0.0;
  processes.sum({&size, 1});
  if (!is_first) bytes.resize(std::size_t(size));
  // Whole numbers of 32 bits are exact in doubles, and the others add nothing to them.
  constexpr std::size_t word_bytes = sizeof(std::uint32_t);
  std::vector<double> words((bytes.size() + word_bytes - 1) / word_bytes, 0.0);
  const auto for_words = [&](auto&& visit) {
    for (std::size_t i = 0; i < words.size(); ++i)
      visit(words[i], bytes.data() + i * word_bytes, std::min(word_bytes, bytes.size() - i * word_bytes));
  };
  if (is_first)
    for_words([](double& word, const char* from, std::size_t count) {
      std::uint32_t value = 0;
      std::memcpy(&value, from, count);
      word = double(value);
    });
  processes.sum(words);
  if (is_first) return;
  for_words([](double word, char* to, std::size_t count) {
    const auto value = std::uint32_t(word);
    std::memcpy(to, &value, count);
  });
}

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
