#include "bench/own_program.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>

#include "bench/bench.h"

namespace parvis::bench {
namespace {

/// A word that the shell takes as it stands.
std::string quoted(const std::string& word) {
  std::string result = "'";
  for (const char c : word) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

}  // namespace

bool has_program(const std::string& name) {
  return std::system(fmt::format("command -v {} > /dev/null", quoted(name)).c_str()) == 0;
}

OwnRun run_own_program(const std::string& before, const std::vector<std::string>& arguments) {
  std::string command = fmt::format("{} {}", before, quoted(PARVIS_PROGRAM));
  for (const std::string& argument : arguments) command.append(fmt::format(" {}", quoted(argument)));
  command.append(" 2> /dev/null");
  OwnRun run;
  int status = -1;
  run.seconds = 1e-3 * milliseconds([&] {
                  std::FILE* pipe = popen(command.c_str(), "r");
                  if (!pipe) return;
                  std::array<char, 4096> bytes{};
                  while (const std::size_t count = std::fread(bytes.data(), 1, bytes.size(), pipe))
                    run.output.append(bytes.data(), count);
                  status = pclose(pipe);
                });
  if (status != 0) fail("{}: it ended with status {}", command, status);
  return run;
}

int acknowledged_before_kill(int wanted, const std::function<void(const std::function<bool()>&)>& work) {
  int pipes[2];
  if (pipe(pipes) != 0) fail("no pipe can be made");
  const pid_t child = fork();
  if (child == 0) {
    work([&] { return write(pipes[1], "x", 1) == 1; });
    _exit(1);
  }
  close(pipes[1]);
  int acknowledged = 0;
  char byte = 0;
  while (acknowledged < wanted && read(pipes[0], &byte, 1) == 1) ++acknowledged;
  constexpr unsigned longest_us = 5000, step = 7919;  // so that kills fall into every moment of a command
  usleep(unsigned(wanted) * step % longest_us);
  kill(child, SIGKILL);
  while (read(pipes[0], &byte, 1) == 1) ++acknowledged;
  close(pipes[0]);
  waitpid(child, nullptr, 0);
  return acknowledged;
}

double number_after(const std::string& output, const std::string& text) {
  const std::size_t at = output.find(text);
  if (at == std::string::npos) fail("the program does not say \"{}\": {}", text, output);
  const char* begin = output.c_str() + at + text.size();
  char* end = nullptr;
  const double number = std::strtod(begin, &end);
  if (end == begin) fail("no number follows \"{}\": {}", text, output);
  return number;
}

}  // namespace parvis::bench
