// SPDX-License-Identifier: MIT
// --origin and --restore-origin: coordinates far from 0, which single precision cannot hold,
// without an offset, and with it again.
#pragma once

#include <optional>

#include <mesh/soup_io.h>

#include "options/command_line.h"
#include "program/program.h"
#include "report/findings.h"
#include "steps/point_steps.h"

namespace meshrepair {

struct OriginOptions {
  bool automatic = false;
  bool restore = false;         // what the file says that was subtracted is added first
  bool stays = false;           // no warning either
  std::optional<Vec3d> offset;  // to be subtracted
};

void add_origin_options(CommandLine& app, OriginOptions& options);

// Moves what was read: `known` is the offset that its file names. Returns the offset of what it is
// now, which findings.origin gets, too. Where meshes stand in a scene of a format that has such,
// they are moved in their own frames, and their places back. Warns where OUT is read in single
// precision and loses by that. Throws UsageError where an offset is to be restored and none is
// known, or what has its place elsewhere cannot be moved.
void move_origin_stage(const OriginOptions& options, SoupFormat output, Precision precision,
                       AnySoup& input, Findings& findings);

// One origin for several meshes: that of the first.
class CommonOrigin {
 public:
  // `output`: of a tree, nothing.
  CommonOrigin(const OriginOptions& options, std::optional<SoupFormat> output)
      : options_(options), output_(output) {}

  // Brings a mesh there whose file names the offset `known`. Warns as above.
  void apply(std::optional<Vec3d> known, TriangleSoup& soup, const Findings& findings);

  // For Findings::origin of the result.
  [[nodiscard]] std::optional<Vec3d> get() const;

 private:
  OriginOptions options_;
  std::optional<SoupFormat> output_;
  bool is_known_ = false;
  Vec3d origin_ = Vec3d::Zero();
};

// As it is to be written: with a comment, or at a place.
void keep_origin(const Findings& findings, WriteOptions& format);

}  // namespace meshrepair
