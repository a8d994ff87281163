// SPDX-License-Identifier: MIT
// The exceptions of the project: one small family, each with a message that a user can act on.
#pragma once

#include <stdexcept>
#include <string>

namespace meshrepair {

// Base of all. `what()` is one line without a trailing full stop or newline; it names the file and
// the place where that is known.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message) : std::runtime_error(message) {}
};

// The caller asked for something that makes no sense (an option out of range, an unknown format).
class UsageError : public Error {
 public:
  using Error::Error;
};

// The same of a value that fits other inputs, but not this one: the message says which would.
class ValueError : public UsageError {
 public:
  using UsageError::UsageError;
};

// A file or a soup that cannot be read as what it claims to be. Final: trying again does not help.
class InputError : public Error {
 public:
  using Error::Error;
};

// A limit on time, memory or size was reached. May be tried again with more.
class LimitError : public Error {
 public:
  using Error::Error;
};

// Work on several threads needs one that the system does not give: for want of memory, or by a
// limit of its own.
class OutOfThreads : public LimitError {
 public:
  OutOfThreads() : LimitError("the system gives no further thread") {}
};

// The input was read, but no part of space is enclosed by it. Final.
class NoSolidError : public Error {
 public:
  using Error::Error;
};

// The output could not be written. May be tried again.
class OutputError : public Error {
 public:
  using Error::Error;
};

// The work was cancelled by the observer (a signal, a closed window).
class Cancelled : public Error {
 public:
  Cancelled() : Error("cancelled") {}
};

// An invariant of ours does not hold: a bug.
class InternalError : public Error {
 public:
  using Error::Error;
};

}  // namespace meshrepair
