// Modules: shared objects of Parvis that bring a third-party library along. A module is loaded when its
// functions are first asked for, so that a command maps the libraries that it needs and no others. What reads
// bytes that nobody trusts asks in a worker (isolated_process.h): the module is then loaded in the server
// that forks the workers, and never in the program. The library of this room, of which a process has one, is
// shared by the program and the modules and lies in their folder.
#pragma once

#include <string_view>
#include <utility>

#include "base/result.h"

namespace parvis {

/// The table that a module defines with PARVIS_MODULE, loaded with the module where it is not yet. Errors:
/// the module, or a library that it needs, cannot be loaded, by name. In a worker that lacks the module it
/// does not return: the work begins again in one that has it.
Result<const void*> module_functions(std::string_view name);

/// A module by its name, of letters a to z, with a table of functions of that type.
template <class Functions>
class Module {
 public:
  /// Loads nothing yet.
  explicit constexpr Module(std::string_view name) : name_(name) {}

  /// The module's functions, which stay until the process ends. Errors: those of module_functions.
  Result<const Functions*> functions() const {
    const Result<const void*> found = module_functions(name_);
    if (!found) return found.errors();
    return static_cast<const Functions*>(*found);
  }

  /// Calls one of them, which returns a Result; errors of loading are returned, too.
  template <class Return, class... Parameters, class... Arguments>
  Return call(Return (*Functions::*function)(Parameters...), Arguments&&... arguments) const {
    const Result<const Functions*> loaded = functions();
    if (!loaded) return loaded.errors();
    return ((*loaded)->*function)(std::forward<Arguments>(arguments)...);
  }

 private:
  std::string_view name_;
};

}  // namespace parvis

/// Stands in a module's source before the values of its table: PARVIS_MODULE(OpenImageIoFunctions){decode,
/// encode};
#define PARVIS_MODULE(Functions)           \
  extern "C" {                             \
  extern const Functions parvis_functions; \
  }                                        \
  const Functions parvis_functions
