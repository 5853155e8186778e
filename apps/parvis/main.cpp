// The command: each subcommand reads its arguments and calls a room.
#include <fmt/format.h>

int main() {
  fmt::print("parvis\n");
  return 0;
}
