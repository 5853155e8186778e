// Value-or-errors: what a function returns when user data may be bad. Nothing is thrown across a module's
// door.
#pragma once

#include <fmt/format.h>

#include <cassert>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace parvis {

/// A place in a user's file. `line` and `column` count from 1; 0 means that the place has none.
struct FileLocation {
  std::string file;
  int line = 0;
  int column = 0;
};

/// A message of one sentence or two: what was wrong, where, what was expected and what to do.
struct Error {
  std::string message;
  FileLocation where;
};

/// One problem or more, in the order in which they were found.
using Errors = std::vector<Error>;

/// "file:line:column: message", leaving out the parts that are unknown.
std::string to_string(const Error& error);
/// One line for each error.
std::string to_string(const Errors& errors);

/// Either a value or a non-empty list of errors.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::move(value)) {}
  Result(Error error) : state_(Errors{std::move(error)}) {}
  Result(Errors errors) : state_(std::move(errors)) { assert(!this->errors().empty()); }

  bool ok() const { return std::holds_alternative<T>(state_); }
  explicit operator bool() const { return ok(); }

  T& value() & {
    assert(ok());
    return std::get<T>(state_);
  }
  const T& value() const& {
    assert(ok());
    return std::get<T>(state_);
  }
  T&& value() && {
    assert(ok());
    return std::get<T>(std::move(state_));
  }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T&& operator*() && { return std::move(*this).value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

  const Errors& errors() const {
    assert(!ok());
    return std::get<Errors>(state_);
  }

 private:
  std::variant<T, Errors> state_;
};

/// The value of functions that succeed without one: `return Ok{};`
struct Ok {};
using Status = Result<Ok>;

/// An error without a place, with a formatted message.
template <class... Args>
Error error(fmt::format_string<Args...> format, Args&&... args) {
  return {fmt::format(format, std::forward<Args>(args)...), {}};
}

/// An error at a place in a file.
template <class... Args>
Error error_at(FileLocation where, fmt::format_string<Args...> format, Args&&... args) {
  return {fmt::format(format, std::forward<Args>(args)...), std::move(where)};
}

}  // namespace parvis
