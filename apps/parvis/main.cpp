// The command: a table of subcommands, each of which reads its arguments and calls a room.
// Exit status: 0 done, 1 failed, 2 bad usage.
#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>
#include <tuple>

#include "base/isolated_process.h"
#include "base/partial_file.h"
#include "commands.h"
#include "strict_numbers.h"

namespace {

/// Throws and allocates nothing: it speaks of what happened where there is no memory, too.
int failed(const char* message) {
  std::fputs(message, stderr);
  return 1;
}
int failed(const std::string& message) { return failed(message.c_str()); }

constexpr const char* no_memory =
    "parvis: there is not enough memory for this; use a smaller scene or --size\n";

constexpr const char* no_thread =
    "parvis: the system gives no thread; raise the limits of memory and processes (ulimit -v, ulimit -u)\n";

constexpr const char* no_output = "parvis: the standard output cannot be written; is its disk full?\n";

/// Ends the program where memory ends: exceptions must not pass the graphics driver, which holds locks, nor
/// destructors of libraries that allocate.
void end_without_memory() { parvis::remove_partial_files_and_end(no_memory); }

/// Ends the program where an exception may go no further, as one of a library's own threads: the system gave
/// no memory or no thread.
void end_without_thread() {
  try {
    if (const std::exception_ptr problem = std::current_exception()) std::rethrow_exception(problem);
  } catch (const std::bad_alloc&) {
    parvis::remove_partial_files_and_end(no_memory);
  } catch (const std::system_error&) {
    parvis::remove_partial_files_and_end(no_thread);
  } catch (const std::runtime_error&) {  // of oneTBB, which cannot make its threads
    parvis::remove_partial_files_and_end(no_thread);
  } catch (...) {
  }
  std::abort();  // a mistake of ours
}

/// Takes the places of standard streams that the caller has closed, so that no file that is opened later gets
/// what is printed. Writing to such a stream fails, as on a full disk.
void open_closed_streams() {
  for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream)
    if (fcntl(stream, F_GETFD) < 0)
      std::ignore = open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

/// Reads the command line and does what it says. Throws what no room can answer for.
int run(int count, char** arguments) {
  open_closed_streams();
  parvis::start_isolation();                 // before there are threads
  std::set_new_handler(end_without_memory);  // not in the processes that read strangers' files: they answer
  parvis::remove_partial_files_on_signals();
  CLI::App app{"Parvis shows a city square before it changes."};
  app.name("parvis");
  app.require_subcommand(1);
  app.set_version_flag("--version", "parvis " PARVIS_VERSION);
  app.set_help_all_flag("--help-all", "Help of every subcommand");

  std::function<parvis::Status()> chosen;
  for (const auto add : parvis::command_table) add(app, chosen);

  parvis::be_strict_about_numbers(app);
  try {
    app.parse(count, arguments);
  } catch (const CLI::ParseError& problem) {
    if (app.exit(problem) != 0) return 2;
    std::cout.flush();
    return std::cout ? 0 : failed(no_output);
  }
  if (const parvis::Status status = chosen(); !status) {
    return failed(parvis::to_string(status.errors()));
  }
  // What was printed may be the result: a full disk behind it is an error.
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    return failed(no_output);
  }
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  std::set_terminate(end_without_thread);
  try {
    return run(count, arguments);
  } catch (const std::bad_alloc&) {  // of a library that throws it by itself
    return failed(no_memory);
  } catch (const std::length_error&) {
    return failed("parvis: something in this scene is larger than any memory; use a smaller scene\n");
  } catch (const std::filesystem::filesystem_error& problem) {
    return failed(
        fmt::format("parvis: {}: {}\n", problem.path1().string(), problem.code().message()).c_str());
  } catch (const std::system_error& problem) {  // threads
    std::fprintf(stderr, "parvis: %s\n", std::strerror(problem.code().value()));
    return 1;
  } catch (const std::exception&) {
    return failed("parvis: an error that Parvis does not know; please report it with the scene\n");
  }
}
