// SPDX-License-Identifier: MIT
// A mesh in blocks: what is in their folder, and what is known of them.
//
//   plan.json            what the blocks are
//   blocks/1.ply ...     the mesh, block by block
//   repaired/1.ply ...   what was made of each, in the format that was asked for, and with a number
//                        in its name that tells the options, if there are any
//   repaired/1.done ...  that it is all there, and checksums
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <mesh/length_unit.h>

namespace meshrepair {

struct Run;

struct Block {
  std::size_t triangles = 0;
  std::size_t groups = 0;      // of parts that have to do with each other
  std::uint64_t checksum = 0;  // of its file
};

struct BlockPlan {
  std::string input;
  std::size_t triangles = 0;  // of the input
  std::optional<LengthUnit> unit;
  std::vector<Block> blocks;
};

// How the repair of a block ended.
struct BlockResult {
  std::uint64_t block = 0;    // checksum of what was repaired
  std::uint64_t result = 0;   // checksum of what came of it
  std::uint64_t program = 0;  // checksum of what repaired it
  std::string options;        // that results depend on, as options_of_results() gives them
  std::string file;           // its name; empty: the block encloses nothing
  bool certified = false;
};

class BlockFolder {
 public:
  explicit BlockFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // The numbers of blocks begin at 1.
  [[nodiscard]] std::filesystem::path plan_file() const { return folder_ / "plan.json"; }
  [[nodiscard]] std::filesystem::path block_file(std::size_t block) const;
  // Results of other options have other names, so that runs at the same time do not meet.
  // `extension` begins with a point.
  [[nodiscard]] std::filesystem::path result_file(std::size_t block, const std::string& options,
                                                  const std::string& extension) const;

  // Of a block that does not enclose nothing.
  [[nodiscard]] std::filesystem::path file_of(const BlockResult& result) const {
    return folder_ / "repaired" / result.file;
  }
  // Says that the block is repaired; done_file() of block 1 is repaired/1.done.
  [[nodiscard]] std::filesystem::path done_file(std::size_t block) const;

  // Makes the folders. Throws OutputError; UsageError if there is a plan already.
  void create() const;
  void write_plan(const BlockPlan& plan) const;
  // Throws InputError where there is none, or it is damaged.
  [[nodiscard]] BlockPlan read_plan() const;

  // Throws UsageError where the file, which `option` names, would lie among those of the folder;
  // where it is the report, this is withheld.
  void require_outside(const std::string& option, const std::string& file, Run& run) const;

  void write_result(std::size_t block, const BlockResult& result) const;
  // Nothing where the block is not repaired, or files are not what they were.
  [[nodiscard]] std::optional<BlockResult> read_result(std::size_t block,
                                                       const BlockPlan& plan) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace meshrepair
