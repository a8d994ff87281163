// SPDX-License-Identifier: MIT
// The states of one repair in a store.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <base/stage_meter.h>
#include <base/state_store.h>
#include <repair/repair_options.h>

#include "repair_state.h"

namespace meshrepair::internal {

// In the order in which they come; the last makes the others needless.
inline constexpr const char* kPreparedState = "prepared";  // clean, closed and turned
inline constexpr const char* kChambersState = "chambers";  // what came of that way, not finished
inline constexpr const char* kRepairedState = "repaired";

// Those of other soups in the same store have other names. Without a store none is there, and none
// is kept.
class SavedStates {
 public:
  SavedStates() = default;
  SavedStates(const TriangleSoup& soup, const RepairOptions& options);

  [[nodiscard]] bool has(const std::string& name) const;
  // Whether there is such a state; then the values are those that it was saved with, and else what
  // they were.
  template <class... Values>
  [[nodiscard]] bool load(const std::string& name, Values&... values);
  template <class... Values>
  void save(const std::string& name, const Values&... values);
  void drop(const std::string& name);

 private:
  [[nodiscard]] std::string name_of(const std::string& state) const;

  StateStore* store_ = nullptr;
  std::string soup_;  // a number that tells it from others
};

// What `make` makes of a soup, and fills the report with, but for its stages, which are in
// `stages`. It is kept under this name, or was by an earlier run, and then with the stages of that.
[[nodiscard]] std::optional<Surface> made_once(SavedStates& states, const std::string& name,
                                               RepairReport& report,
                                               std::vector<StageReport>& stages, StageMeter& meter,
                                               const std::function<std::optional<Surface>()>& make);

template <class... Values>
bool SavedStates::load(const std::string& name, Values&... values) {
  if (store_ == nullptr) return false;
  std::tuple<Values...> found;
  bool is_whole = false;
  const bool is_there = store_->load(name_of(name), [&](std::istream& in, std::uint64_t bytes) {
    StateReader reader(in, bytes);
    try {
      std::apply([&](auto&... value) { (reader(value), ...); }, found);
      is_whole = reader.at_end();
    } catch (const BrokenState&) {
      is_whole = false;
    }
  });
  if (is_there && is_whole) std::tie(values...) = std::move(found);
  return is_there && is_whole;
}

template <class... Values>
void SavedStates::save(const std::string& name, const Values&... values) {
  if (store_ == nullptr) return;
  store_->save(name_of(name), [&](std::ostream& out) {
    StateWriter writer(out);
    (writer(values), ...);
  });
}

}  // namespace meshrepair::internal
