// SPDX-License-Identifier: MIT
// States of a run in a folder, so that a run after this one can go on from them.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <base/state_store.h>

namespace meshrepair {

// One file for each state, whole or not there. Those of another program or of other options are of
// no use: they go once this run has a state of its own. One run at a time has the folder.
class StateFolder : public StateStore {
 public:
  // Makes the folder if it is not there. `options`: all that results depend on, but for the input.
  // Throws OutputError where that cannot be, or another run has it.
  StateFolder(std::filesystem::path folder, const std::string& options);
  ~StateFolder() override;

  [[nodiscard]] bool has(const std::string& name) const override;
  [[nodiscard]] bool load(const std::string& name,
                          const std::function<void(std::istream&, std::uint64_t)>& read) override;
  void save(const std::string& name, const std::function<void(std::ostream&)>& write) override;
  void drop(const std::string& name) override;

  // The states that were loaded, of an earlier run.
  [[nodiscard]] const std::vector<std::string>& loaded() const { return loaded_; }
  // The states of this run, and earlier ones like it: the work is done. The folder goes with this
  // object if it is empty then.
  void remove() noexcept;

 private:
  [[nodiscard]] std::filesystem::path path_of(const std::string& name,
                                              std::string_view extension) const;
  void remove_others() noexcept;
  void remove_those(const std::function<bool(const std::filesystem::path&)>& are_meant) noexcept;

  std::filesystem::path folder_;
  int lock_ = -1;          // a descriptor of the folder
  std::uint64_t key_ = 0;  // of program and options
  bool may_save_ = true;   // the disk had room so far
  std::vector<std::string> loaded_, saved_;
};

}  // namespace meshrepair
