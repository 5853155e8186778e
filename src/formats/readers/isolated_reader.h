// Readers of model files in a child process: `readers.add({".ifc"}, isolated<read_ifc>(), looks_like_ifc)` is
// all that a room writes to have a third-party library crash, hang or grow without harm.
#pragma once

#include "base/isolated_process.h"
#include "base/sealed_file.h"
#include "formats/readers/readers.h"

namespace parvis::formats {

/// A reader as a plain function, which the child process shares with the program.
using ReadFunction = Result<FileContent>(const std::filesystem::path& file, const ModelReading& reading,
                                         Errors& warnings);

/// Limits of a child that reads `file`: files below its folder, and memory and time by its size.
IsolationLimits limits_for(const std::filesystem::path& file);

/// Warnings as flat bytes: they stand before what a child returns.
std::string bytes_of_warnings(const Errors& warnings);
/// Adds the warnings at the front of what a child has returned to `warnings`.
void take_warnings(ByteReader& reader, Errors& warnings);

/// An account as flat bytes, which stand behind the warnings; lines and names are bounded when it is taken.
std::string bytes_of_account(const scene::FileAccount& account);
/// The account at the front of what a child has returned.
scene::FileAccount take_account(ByteReader& reader);

/// Runs in the child: reads the file that `input` names and fills `output` with warnings, account and model.
Status read_in_worker(ReadFunction* read, std::string_view input, IsolatedOutput& output);

/// Runs in the program: has `work` read the file, and checks what comes back. The child may open files below
/// the file's own folder alone, and has time and memory by the size of the file. A reading with a ground
/// (`ModelReading::ground`) is an error: the child cannot ask for heights.
Result<FileContent> read_isolated(IsolatedWork work, const std::filesystem::path& file,
                                  const ModelReading& reading, Errors& warnings);

/// The reader `read` in a child process: a crash, an abort, an exit, an endless loop or a lack of memory in
/// it is an error that names the file.
template <ReadFunction* read>
ReadModel isolated() {
  return [](const std::filesystem::path& file, const ModelReading& reading, Errors& warnings) {
    constexpr IsolatedWork work = [](std::string_view input, IsolatedOutput& output) {
      return read_in_worker(read, input, output);
    };
    return read_isolated(work, file, reading, warnings);
  };
}

}  // namespace parvis::formats
