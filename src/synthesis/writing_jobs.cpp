#include "synthesis/writing_jobs.h"

#include "base/parallel.h"
#include "base/partial_file.h"

namespace parvis::synthesis {
namespace {
namespace fs = std::filesystem;

Status run_all(const std::vector<WritingJob>& jobs, const fs::path& folder) {
  std::vector<Errors> failures(jobs.size());
  parallel_for(jobs.size(), [&](std::size_t i) {
    const Status status = jobs[i](folder);
    if (!status) failures[i] = status.errors();
  });
  Errors all;
  for (const Errors& some : failures) all.insert(all.end(), some.begin(), some.end());
  if (!all.empty()) return all;
  return Ok{};
}

Status make_folder(const fs::path& folder) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (code || !fs::is_directory(folder, code))
    return error("{}: the folder cannot be made ({}); choose one that can be written", folder.string(),
                 code.message());
  return Ok{};
}

/// Moves every file of `from` into `to`, over files of the same name.
Status move_files(const fs::path& from, const fs::path& to) {
  std::error_code code;
  // Before the first is moved: later, the files of two places would be mixed.
  for (const fs::directory_entry& entry : fs::directory_iterator(from, code))
    if (const fs::path place = to / entry.path().filename(); fs::is_directory(place, code))
      return error("{}: is a folder, where a file is to be written; move it elsewhere", place.string());
  for (const fs::directory_entry& entry : fs::directory_iterator(from, code)) {
    fs::rename(entry.path(), to / entry.path().filename(), code);
    if (code)
      return error("{}: cannot be written ({})", (to / entry.path().filename()).string(), code.message());
  }
  return Ok{};
}

/// All files, then their move; what cannot be written leaves nothing behind.
Status write_and_move(const std::vector<WritingJob>& jobs, const fs::path& folder) {
  const Result<PartialFolder> unfinished = PartialFolder::create(folder);
  if (!unfinished) return unfinished.errors();
  if (Status status = run_all(jobs, unfinished->path()); !status) return status;
  return move_files(unfinished->path(), folder);
}

}  // namespace

Status write_together(const std::vector<WritingJob>& jobs, const fs::path& folder) {
  std::error_code code;
  const bool is_new = !fs::exists(folder, code);
  Status status = make_folder(folder);
  if (!status) return status;
  status = write_and_move(jobs, folder);
  if (!status && is_new) fs::remove(folder, code);
  return status;
}

}  // namespace parvis::synthesis
