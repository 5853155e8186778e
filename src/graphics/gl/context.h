// An OpenGL 4.5 core context without a window: on an EGL device where there is a GPU, else on Mesa's
// surfaceless platform.
#pragma once

#include <string>

#include "base/result.h"

namespace parvis::gl {

/// Owns the EGL context that is current on the thread that made it. Where a window library made a context
/// current, `check_current` is all that is needed.
class Context {
 public:
  /// Fails, and says what was found, where there is no driver or one below OpenGL 4.5.
  static Result<Context> create_headless();
  Context(Context&& other) noexcept;
  Context& operator=(Context&&) = delete;
  ~Context();

 private:
  Context(void* display, void* context) : display_(display), context_(context) {}

  void* display_;
  void* context_;
};

/// Is the current context an OpenGL of 4.5 or later? Also turns on what every pass takes for granted
/// (seamless cube maps) and, in debug builds, reports the driver's complaints.
Status check_current();

/// The requests that the driver has refused since the last call, such as "out of memory"; empty: nothing.
/// Waits for no command. A driver may refuse storage for what a scene asks, and would draw black from then
/// on.
std::string refused();

/// "renderer, version" of the current context, as benches name the machine.
std::string driver_name();
/// True if the current context renders on the CPU (llvmpipe and its like).
bool is_software();

}  // namespace parvis::gl
