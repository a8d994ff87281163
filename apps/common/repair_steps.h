// What the programs that take steps of the repair have in common: reading and writing as stages of
// their own, messages that name the file, and a report that holds what was found.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <bsp/tree_io.h>
#include <mesh/point_io.h>
#include <mesh/soup_io.h>
#include <repair/fidelity.h>
#include <repair/repair.h>
#include <repair/repair_points.h>
#include <repair/transfer_attributes.h>

#include "common/asset_options.h"
#include "common/picture_request.h"
#include "common/program.h"
#include "common/purposes.h"
#include "page/html_request.h"

namespace meshrepair {

// What a .bsp file held.
struct TreeFacts {
  std::size_t triangles = 0;
  std::size_t nodes = 0;
  std::size_t leaves = 0;
  std::size_t solid_leaves = 0;
  bool labelled = false;
};

[[nodiscard]] TreeFacts facts_of(const Tree& tree);

// All that is known of a run, filled as far as the work came.
struct Findings {
  Findings(std::string input_path, std::string output_path)
      : input(std::move(input_path)), output(std::move(output_path)) {}

  // For people: "-" by what it stands for.
  [[nodiscard]] std::string input_name() const;
  [[nodiscard]] std::string output_name() const;
  [[nodiscard]] std::string written_name() const;  // also where it is until it is moved there

  std::string input;
  std::string output;
  std::string staging;  // where the output is written first; empty: where it belongs
  std::optional<ReadReport> mesh_read;
  std::optional<LengthUnit> unit;  // of the output, as far as it is known
  std::optional<PointReadReport> points_read;
  std::optional<PointSoupReport> point_soup;
  std::size_t points_in_result = 0;  // of those left in point_soup
  std::size_t joined_columns = 0;    // points left out before that, as RepairPointsReport says
  std::optional<ScanBaseReport> scan_base;
  std::vector<PointTry> tries;     // of repair_points()
  std::size_t dropped_solids = 0;  // too small for the points to tell
  bool soup_written = false;       // the output is a soup, no solid
  std::size_t soup_triangles = 0;  // of it
  std::optional<TreeFacts> tree_read;
  std::optional<TreeFacts> tree_written;
  RepairReport repair;
  bool has_walls = false;  // of sheets, in some mesh of a scene
  std::optional<Fidelity> fidelity;
  std::size_t output_points = 0;
  std::string missing_guarantees;  // of that mesh, for people; empty: it holds all
  bool withheld = false;           // not written because of these
  Purpose purpose;
  std::string explained;   // the file that says what became of the triangles; may be empty
  std::string summary;     // instead of that of summary_of(), if it is not empty
  std::string shown;       // a picture, as terminals have it, for below the summary; may be empty
  bool shows_bar = false;  // a bar of what changed, instead
};

// What the command line of such a program says; not every program has all of it.
struct StepOptions {
  std::string input;
  std::string output;
  std::optional<SoupFormat> format;
  bool sources = false;  // write of each triangle which one of the input it lies in
  AssetOptions assets;
  bool strict = false;
  std::string staging;  // folder that OUT is written into first; empty: none
  PictureRequest picture;
  HtmlRequest html;
  std::string explained;  // file that is to say what became of the triangles; empty: none
  Purpose purpose;
  RepairOptions repair;
};

using StepBody = std::function<void(const StepOptions&, Run&, Findings&)>;

// The whole of a program once its options are declared: looks at the files before hours of work,
// runs `body`, puts what was found into the report, also when it throws, and prints the summary.
// Errors about the input that do not name it are given its name. The report never goes where the
// input or the output is. Exit code "done" of a program that writes a mesh means that the mesh
// holds all guarantees that were checked; what it does not hold is said on stderr.
[[nodiscard]] int run_steps(Program& program, int argc, const char* const* argv,
                            StepOptions& options, const StepBody& body);
// The same within a run that is there already.
[[nodiscard]] ExitCode run_steps(StepOptions& options, Run& run, const StepBody& body);

// Whether two names lead to one file, there already or not. Devices are never one: /dev/null may be
// named as often as one likes.
[[nodiscard]] bool is_same_file(const std::string& a, const std::string& b);

// What can be said of the files before hours of work; `output` is empty when nothing is written.
// Throws UsageError where the report is the input or the output, too, and withholds it; OutputError
// where the output cannot be.
void check_files(const std::string& input, const std::string& output, Run& run);

// Throws OutputError where there is no folder for this file, or there is one of its name.
void check_folder(const std::string& file);

// Runs `work`, then puts the findings into the report, also when it throws. Errors about the input
// that do not name it are given its name.
ExitCode with_findings(Run& run, Findings& findings, const std::function<ExitCode()>& work);

// What counts is the file: in STL, welding and rounding may join what the surface keeps apart.
void look_at_file(const Surface& surface, SoupFormat format, Findings& findings);

// What a surface lacks in the file, for people; empty: nothing. After look_at_file().
[[nodiscard]] std::string missing_guarantees(const Findings& findings, SoupFormat format);

// What users should know of an input and of what became of it, though it is no error.
void warn_of_findings(const Findings& findings);

// Not certified, and an error logged and put into the report, where the output is without a
// guarantee.
[[nodiscard]] ExitCode verdict(Run& run, const Findings& findings);

// Throws UsageError where no format can be told, or it cannot hold the sources that are asked for.
[[nodiscard]] WriteOptions mesh_format(const StepOptions& options);

// The same options, to be certified at the precision of the format.
[[nodiscard]] RepairOptions certified_for(SoupFormat format, RepairOptions options);

// The first warnings of a reader, and how many more there are.
void log_warnings(const std::string& name, const std::vector<std::string>& warnings);

// As the command line limits it.
[[nodiscard]] ReadOptions read_options(Run& run);

// Stage "read". What a reader passed over is logged as warnings; its report becomes a finding.
// `options` are those of read_options(), with more.
[[nodiscard]] ReadResult read_mesh_stage(const ReadOptions& options, Run& run, Findings& findings);
// Takes over what a reader has found of a mesh.
void keep_read_report(ReadReport report, Findings& findings);
[[nodiscard]] Tree read_tree_stage(Run& run, Findings& findings);
// Stage "distance", where there will be a report to say it in. It comes before the writing, so that
// it cannot fail once there is an output. The surface is as repair() leaves it, at this precision.
void measure_distance_stage(const TriangleSoup& input, const Surface& surface, Precision precision,
                            Run& run, Findings& findings);
// Stage "attributes", where there are any: of the soup, brought onto what became of it.
[[nodiscard]] Attributes transfer_attributes_stage(const TriangleSoup& input,
                                                   const Attributes& attributes,
                                                   const Surface& surface, Run& run,
                                                   Findings& findings);
// To go behind the message of a NoSolidError: how its sheets become walls; empty where it has none.
[[nodiscard]] std::string advice_to_thicken(const RepairReport& repair);
// Warns where the materials of a mesh are in files beside it, but there can be none.
void write_with_files(const TriangleSoup& soup, const WriteOptions& format, Run& run,
                      Findings& findings);
// Stage "write".
// Finds which guarantees the file would not hold; if options.strict and there are any, writes
// nothing. `format` is that of mesh_format(options), `attributes` those of the surface.
void write_mesh_stage(const Surface& surface, const Attributes& attributes, WriteOptions format,
                      const StepOptions& options, Run& run, Findings& findings);
// Of triangles that need be no surface.
void write_soup_stage(const TriangleSoup& soup, WriteOptions format, Run& run, Findings& findings);
void write_tree_stage(const Tree& tree, Run& run, Findings& findings);

}  // namespace meshrepair
