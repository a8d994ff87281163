// SPDX-License-Identifier: MIT
// Where long work keeps what is done, so that another process can go on from there.
#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <string>

namespace meshrepair {

// States of a work, each with a name that file systems take. What is read was written by the same
// program with the same options; whoever makes the store sees to that.
class StateStore {
 public:
  StateStore() = default;
  StateStore(const StateStore&) = delete;
  StateStore& operator=(const StateStore&) = delete;
  virtual ~StateStore() = default;

  [[nodiscard]] virtual bool has(const std::string& name) const = 0;
  // Lets `read` read the bytes of a state, of which there are so many. Whether there is one, and
  // all of it is as it was written: known only once it was read.
  [[nodiscard]] virtual bool load(
      const std::string& name, const std::function<void(std::istream&, std::uint64_t)>& read) = 0;
  // Keeps what `write` writes, in full or not at all. A state of that name is replaced. It is no
  // error if it cannot be kept: the work is then done again.
  virtual void save(const std::string& name, const std::function<void(std::ostream&)>& write) = 0;
  // It is not needed any more.
  virtual void drop(const std::string& name) = 0;
};

}  // namespace meshrepair
