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
// they are moved in their own frames, and their places back. Warns where OUT has single precision
// and loses by that. Throws UsageError where an offset is to be restored and none is known.
void move_origin_stage(const OriginOptions& options, bool is_single, bool has_instances,
                       AnySoup& input, Findings& findings);

// One origin for several meshes: that of the first.
class CommonOrigin {
 public:
  CommonOrigin(const OriginOptions& options, bool is_single)
      : options_(options), is_single_(is_single) {}

  // Brings a mesh there whose file names the offset `known`. Warns as above.
  void apply(std::optional<Vec3d> known, TriangleSoup& soup, const Findings& findings);

  // For Findings::origin of the result.
  [[nodiscard]] std::optional<Vec3d> get() const;

 private:
  OriginOptions options_;
  bool is_single_;
  bool is_known_ = false;
  Vec3d origin_ = Vec3d::Zero();
};

// As it is to be written: with a comment, or at a place in a scene of its own, for which `scene` is
// taken.
void keep_origin(const Findings& findings, const TriangleSoup& soup, Scene& scene,
                 WriteOptions& format);

}  // namespace meshrepair
