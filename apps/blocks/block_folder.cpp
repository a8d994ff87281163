// SPDX-License-Identifier: MIT
#include "blocks/block_folder.h"

#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>
#include <utility>
#include <zlib.h>

#include <spdlog/fmt/fmt.h>

#include <base/atomic_file.h>
#include <base/error.h>

#include "process/file_checksum.h"
#include "program/program.h"
#include "report/json_report.h"

namespace meshrepair {
namespace {

namespace fs = std::filesystem;

void make_folder(const fs::path& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) {
    throw OutputError(folder.string() + ": cannot be created: " + failed.message());
  }
}

// Nothing where it cannot be read or is no JSON.
std::optional<Json> read_json(const fs::path& file) {
  std::error_code failed;
  if (!fs::is_regular_file(file, failed)) return std::nullopt;
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  return Json::parse(std::string(std::istreambuf_iterator<char>(in), {}));
}

// A member is missing, or is of another kind.
struct Damaged {};

template <class Value>
Value present(std::optional<Value> value) {
  if (!value) throw Damaged();
  return *std::move(value);
}

const Json& member(const Json& json, const char* key) {
  const Json* const found = json.find(key);
  if (found == nullptr) throw Damaged();
  return *found;
}

std::uint64_t count_of(const Json& json, const char* key) {
  return present(member(json, key).as_count());
}

// Of something in memory.
std::size_t size_of(const Json& json, const char* key) {
  const std::uint64_t count = count_of(json, key);
  const auto size = static_cast<std::size_t>(count);
  if (size != count) throw Damaged();
  return size;
}

std::string text_of(const Json& json, const char* key) {
  return present(member(json, key).as_text());
}

std::optional<LengthUnit> unit_of(const Json& name) {
  if (name.is_null()) return std::nullopt;
  return present(unit_named(present(name.as_text())));
}

const std::vector<Json>& list_of(const Json& json, const char* key) {
  const Json& list = member(json, key);
  if (!list.is_array()) throw Damaged();
  return list.values();
}

void write_json(const fs::path& file, const Json& json) {
  write_file_atomically(file, json.dump(2) + "\n");
}

}  // namespace

fs::path BlockFolder::block_file(std::size_t block) const {
  return folder_ / "blocks" / (std::to_string(block) + ".ply");
}

fs::path BlockFolder::result_file(std::size_t block, const std::string& options,
                                  const std::string& extension) const {
  std::string name = std::to_string(block);
  if (!options.empty()) {
    const auto* const bytes = reinterpret_cast<const Bytef*>(options.data());
    name += fmt::format("-{:08x}", ::crc32_z(0, bytes, options.size()));
  }
  return folder_ / "repaired" / (name + extension);
}

fs::path BlockFolder::done_file(std::size_t block) const {
  return folder_ / "repaired" / (std::to_string(block) + ".done");
}

void BlockFolder::create() const {
  std::error_code failed;
  if (fs::exists(plan_file(), failed)) {
    throw UsageError(folder_.string() + ": there is a plan already");
  }
  make_folder(folder_ / "blocks");
  make_folder(folder_ / "repaired");
}

void BlockFolder::write_plan(const BlockPlan& plan) const {
  Json blocks = Json::array();
  for (const Block& block : plan.blocks) {
    blocks.push_back(
        {{"triangles", block.triangles}, {"groups", block.groups}, {"checksum", block.checksum}});
  }
  write_json(plan_file(), {{"input", plan.input},
                           {"triangles", plan.triangles},
                           {"unit", plan.unit ? Json(unit_name(*plan.unit)) : Json()},
                           {"blocks", std::move(blocks)}});
}

BlockPlan BlockFolder::read_plan() const try {
  const auto json = read_json(plan_file());
  if (!json)
    throw InputError(plan_file().string() +
                     ": not a plan; meshrepair-blocks plan creates one in a new folder");
  BlockPlan plan;
  plan.input = text_of(*json, "input");
  plan.triangles = size_of(*json, "triangles");
  plan.unit = unit_of(member(*json, "unit"));
  std::size_t triangles = 0;
  for (const Json& block : list_of(*json, "blocks")) {
    plan.blocks.push_back(
        {size_of(block, "triangles"), size_of(block, "groups"), count_of(block, "checksum")});
    triangles += plan.blocks.back().triangles;
  }
  if (plan.blocks.empty() || triangles != plan.triangles) {
    throw InputError(plan_file().string() + ": is damaged: blocks are missing");
  }
  return plan;
} catch (const Damaged&) {
  throw InputError(plan_file().string() + ": damaged; remove the folder and plan again");
}

void BlockFolder::require_outside(const std::string& option, const std::string& file,
                                  Run& run) const {
  if (file.empty() || file == "-") return;
  std::error_code failed;
  const fs::path at = fs::weakly_canonical(fs::absolute(file, failed), failed);
  const fs::path folder = fs::weakly_canonical(fs::absolute(folder_, failed), failed);
  for (const fs::path& ours : {folder / "blocks", folder / "repaired", folder / "plan.json"}) {
    if (at != ours && at.parent_path() != ours) continue;
    if (file == run.options.report) run.report.withhold();
    throw UsageError(
        fmt::format("{}: {} lies among the files of {}", option, file, folder_.string()));
  }
}

void BlockFolder::write_result(std::size_t block, const BlockResult& result) const {
  write_json(done_file(block), {{"block", result.block},
                                {"result", result.result},
                                {"program", result.program},
                                {"options", result.options},
                                {"file", result.file},
                                {"certified", result.certified}});
}

std::optional<BlockResult> BlockFolder::read_result(std::size_t block, const BlockPlan& plan) const
    try {
  const auto json = read_json(done_file(block));
  if (!json) return std::nullopt;
  BlockResult result = {count_of(*json, "block"),   count_of(*json, "result"),
                        count_of(*json, "program"), text_of(*json, "options"),
                        text_of(*json, "file"),     present(member(*json, "certified").as_bool())};
  if (result.block != plan.blocks[block - 1].checksum) return std::nullopt;
  if (fs::path(result.file).filename() != result.file) return std::nullopt;
  if (!result.file.empty() && file_checksum(file_of(result)) != result.result) {
    return std::nullopt;
  }
  return result;
} catch (const Damaged&) {
  return std::nullopt;
} catch (const InputError&) {
  return std::nullopt;
}

}  // namespace meshrepair
