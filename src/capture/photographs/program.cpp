#include "capture/photographs/program.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <functional>

#include "base/files.h"

namespace parvis::photographs {
namespace {

constexpr int cannot_start = 127;
constexpr std::size_t shown_bytes = 600;

/// Runs in the child: only calls that are safe after a fork in a program with threads.
[[noreturn]] void become(char* const* arguments, char* const* environment, int out) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (dup2(out, STDOUT_FILENO) < 0 || dup2(out, STDERR_FILENO) < 0) _exit(cannot_start);
  execvpe(arguments[0], arguments, environment);
  _exit(cannot_start);
}

/// An empty file to write to, or -1: a pipe, a link or somebody's other name of a file is none.
int opened_log(const std::filesystem::path& log) {
  const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0644);
  if (file < 0) return -1;
  struct stat status {};
  if (fstat(file, &status) == 0 && S_ISREG(status.st_mode) && status.st_nlink == 1 && ftruncate(file, 0) == 0)
    return file;
  close(file);
  return -1;
}

/// Ours, with threads that sleep while they wait: those that spin take the time of the others wherever
/// something else runs, too.
std::vector<char*> environment_of_child() {
  static char passive[] = "OMP_WAIT_POLICY=passive";
  std::size_t count = 0;
  while (environ[count]) ++count;
  std::vector<char*> variables(environ, environ + count);
  variables.push_back(passive);  // the last: one that is set already counts
  variables.push_back(nullptr);
  return variables;
}

std::string end_of(const std::filesystem::path& log) {
  const Result<std::string> text = read_file(log);
  if (!text) return "";
  return text->size() > shown_bytes ? text->substr(text->size() - shown_bytes) : *text;
}

}  // namespace

Status run_program(const std::vector<std::string>& arguments, const std::filesystem::path& log,
                   const std::function<void()>& poll) {
  std::vector<std::string> copies = arguments;
  std::vector<char*> pointers;
  pointers.reserve(copies.size() + 1);
  for (std::string& argument : copies) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  const std::vector<char*> environment = environment_of_child();
  const std::string log_name = log.string();
  const int out = opened_log(log);
  if (out < 0)
    return error("{}: is not a regular file that can be written; remove it or choose another folder",
                 log_name);
  const pid_t child = fork();
  if (child == 0) become(pointers.data(), environment.data(), out);
  close(out);
  if (child < 0) return error("{}: no process can be started", arguments[0]);
  int state = 0;
  while (waitpid(child, &state, WNOHANG) == 0) {
    poll();
    usleep(200'000);
  }
  poll();
  if (WIFEXITED(state) && WEXITSTATUS(state) == 0) return Ok{};
  if (WIFEXITED(state) && WEXITSTATUS(state) == cannot_start)
    return error("{} cannot be started; install it (Debian: apt install {})", arguments[0], arguments[0]);
  return error("{} {} failed; the end of {} says: {}", arguments[0], arguments.size() > 1 ? arguments[1] : "",
               log_name, end_of(log));
}

}  // namespace parvis::photographs
