// SPDX-License-Identifier: MIT
// Repairs as calls: of a mesh or points in memory, of a file, of several meshes as one, and of
// several bodies with common faces.
#pragma once

#include <string>
#include <vector>

#include <boolean/bodies.h>

#include "calls/session.h"
#include "steps/repair_command.h"

namespace meshrepair {

struct RepairOutcome : Outcome {
  RepairedMesh mesh;        // where has_mesh()
  bool as_float32 = false;  // its coordinates are to be rounded so: the certificate is about these

  [[nodiscard]] bool has_mesh() const {
    return code == ExitCode::done || code == ExitCode::not_certified;
  }
};

// Each throws UsageError for options that are none, before anything runs. Those about files are
// refused where there are none. Where `from_float32`, the result is for single precision, too,
// unless the options say otherwise.

// `input` is a mesh, or points. With `distance` the report says how far both are apart.
[[nodiscard]] RepairOutcome repair_call(AnySoup input, bool from_float32, bool distance,
                                        const Keywords& keywords, const Runner& runner);
// From file to file.
[[nodiscard]] Outcome repair_file_call(const std::string& input, const std::string& output,
                                       bool distance, const Keywords& keywords,
                                       const Runner& runner);
[[nodiscard]] RepairOutcome boolean_call(std::vector<AnySoup> operands, bool from_float32,
                                         const Keywords& keywords, const Runner& runner);

struct BodiesOutcome : Outcome {
  ConformingBodies bodies;  // where the code is done or not_certified
};
// Regions are named by the numbers of the meshes, from 0.
[[nodiscard]] BodiesOutcome bodies_call(std::vector<TriangleSoup> meshes, const Keywords& keywords,
                                        const Runner& runner);
// Of the n-th operand, for messages.
[[nodiscard]] std::string operand_name(std::size_t n);

}  // namespace meshrepair
