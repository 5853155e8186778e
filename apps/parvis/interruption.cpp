#include "interruption.h"

#include <csignal>

namespace parvis {
namespace {

std::atomic<bool> was_interrupted = false;

}  // namespace

const std::atomic<bool>& interruption() {
  for (const int number : {SIGINT, SIGTERM}) std::signal(number, [](int) { was_interrupted = true; });
  return was_interrupted;
}

}  // namespace parvis
