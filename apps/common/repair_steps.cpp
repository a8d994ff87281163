#include "common/repair_steps.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <string_view>
#include <system_error>

#include <spdlog/logger.h>

#include <base/atomic_file.h>
#include <base/error.h>

#include "common/explanation_file.h"
#include "common/logging.h"
#include "common/picture_steps.h"
#include "common/report_sections.h"
#include "common/summary.h"
#include "page/html_report.h"

namespace meshrepair {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostWarnings = 10;

// Where a path leads, also where nothing is yet.
fs::path place_of(const fs::path& path) {
  std::error_code error;
  return fs::weakly_canonical(fs::absolute(follow_links(path), error), error);
}

void check_report(Run& run, const std::string& file, const std::string& what) {
  const std::string& report = run.options.report;
  if (report.empty() || !is_same_file(report, file)) return;
  run.report.withhold();
  throw UsageError("--report: " + report + " is the " + what + ", too");
}

// Nothing is wrong with triangles that the working grid swallows but that one point is too far off:
// the user can mend that, and would otherwise look for them in vain.
void warn_of_coarse_grid(const Findings& findings) {
  const CleanReport& clean = findings.repair.clean;
  if (clean.dropped_below_grid == 0) return;
  logger().warn(
      "{}: {} of {} triangles dropped, smaller than the working grid, whose step is {:.3g}: is a "
      "point far away from the others?",
      findings.input_name(), clean.dropped_below_grid, clean.triangles_in, clean.grid_unit);
}

// What noise hides does not come back.
void warn_of_lost_triangles(const Findings& findings) {
  constexpr double kWorthAWarning = 0.02;
  const SewReport& sew = findings.repair.sew;
  const auto all = static_cast<double>(findings.repair.clean.triangles_in);
  if (static_cast<double>(sew.lost_triangles) <= kWorthAWarning * all) return;
  logger().warn(
      "{}: corners that belong together are up to {:.3g} apart, and {} are smaller than that: what "
      "they showed is lost",
      findings.input_name(), sew.widest_gap, number_of(sew.lost_triangles, "triangle"));
}

// What open sheets do not enclose is gone; the user may have meant walls.
void warn_of_lost_surface(const Findings& findings) {
  constexpr double kWorthAWarning = 0.1;
  const RepairReport& repair = findings.repair;
  if (!std::isfinite(repair.input_area)) return;
  if (repair.lost_area <= kWorthAWarning * repair.input_area) return;
  logger().warn(
      "{}: {:.0f} % of the input's area is not in the result, as it encloses nothing; "
      "--thicken makes walls of open sheets",
      findings.input_name(), 100 * std::min(1.0, repair.lost_area / repair.input_area));
}

// A solid made of an open sheet is mostly made up; the user may have meant something else.
void warn_of_made_up_surface(const Findings& findings) {
  const RepairReport& repair = findings.repair;
  if (findings.scan_base) return;  // asked for
  constexpr double kWorthAWarning = 0.3;
  if (!std::isfinite(repair.output_area)) return;
  if (repair.closing_area <= kWorthAWarning * repair.output_area) return;
  logger().warn(
      "{}: {:.0f} % of the result's surface is not of the input, but closes what is open there: is "
      "it a sheet, or a part of something?",
      findings.input_name(), 100 * repair.closing_area / repair.output_area);
}

// A solid that was sound is another one now, and a purpose may have asked for that.
void warn_of_filled_walls(const Findings& findings) {
  const SealReport& seal = findings.repair.seal;
  if (seal.double_walls == 0) return;
  logger().warn(
      "{}: the hollow of {} is filled, volume {:.6g}, as only {} up to {:.3g} wide {} into it; "
      "--seal none leaves it",
      findings.input_name(), number_of(seal.double_walls, "double wall"), seal.filled_volume,
      number_of(seal.openings, "pinhole"), seal.size, seal.openings == 1 ? "leads" : "lead");
}

// Of what there was before `area` of it went.
double share_of_surface(double area, const RepairReport& repair) {
  return area > 0 ? area / (area + repair.output_area) : 0;
}

void warn_of_poking_walls(const Findings& findings) {
  constexpr double kWorthAWarning = 0.01;
  const InsideReport& inside = findings.repair.inside;
  if (inside.poking_share < kWorthAWarning) return;
  logger().warn(
      "{}: the wall of a cavity pokes out of what is around it with {:.2g} % of its area; "
      "--inside solidity fills the cavity",
      findings.input_name(), 100 * inside.poking_share);
}

void warn_of_unknown_parts(const Findings& findings) {
  const KeepPartsReport& keep = findings.repair.keep;
  if (keep.done || !keep.asked) return;
  logger().warn("{}: all parts stay, as a surface that is not closed does not tell solids apart",
                findings.output_name());
}

// Where that is much: in single precision other numbers would have kept it.
void warn_of_coarse_numbers(const Findings& findings) {
  const RepairReport& repair = findings.repair;
  constexpr double kWorthAWarning = 0.01;
  const auto warn = [&](std::string_view what, double share) {
    if (!(share > kWorthAWarning)) return;
    const std::string_view why =
        repair.precision == Precision::float32
            ? "OBJ, OFF and PLY in double precision hold finer ones"
            : "sheets were nearer to each other than two steps of the working grid";
    logger().warn("{}: {}, {:.0f} % of the surface: {}", findings.output_name(), what, 100 * share,
                  why);
  };
  warn("parts that are too thin for its numbers are left out",
       repair.certify.dropped_share + share_of_surface(repair.fins_area, repair));
  warn("slits that are too narrow for its numbers are filled",
       share_of_surface(repair.slits_area, repair));
}

template <class ErrorType>
[[noreturn]] void rethrow_named(const ErrorType& error, const std::string& name) {
  const std::string message = error.what();
  if (message.rfind(name, 0) == 0) throw error;
  throw ErrorType(name + ": " + message);
}

void run_named(const std::string& name, const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    rethrow_named(error, name);
  } catch (const NoSolidError& error) {
    rethrow_named(error, name);
  }
}

ExitCode run_body(const StepOptions& options, Run& run, const StepBody& body) {
  Findings findings(options.input, options.output);
  findings.purpose = options.purpose;
  (void)with_findings(run, findings, [&] {
    body(options, run, findings);
    return ExitCode::done;
  });
  warn_of_findings(findings);
  if (!findings.withheld) print_summary(run, findings);
  return verdict(run, findings);
}

}  // namespace

void look_at_file(const Surface& surface, SoupFormat format, Findings& findings) {
  findings.output_points = surface.mesh.points.size();
  if (!welds_points(format)) return;
  const TriangleSoup back = as_read_back(surface.mesh, format);
  findings.output_points = back.points.size();
  findings.repair.output = examine_topology(back.triangles, back.points.size());
}

std::string missing_guarantees(const Findings& findings, SoupFormat format) {
  const Topology& surface = findings.repair.output;
  std::string missing;
  if (!surface.closed()) missing += ", not closed";
  if (!surface.manifold()) missing += ", not manifold";
  if (!surface.oriented()) missing += ", not consistently oriented";
  if (!missing.empty() && welds_points(format)) {
    missing += " once " + std::string(format_name(format)) +
               " has rounded and joined its corners (OBJ, OFF and PLY keep them)";
  }
  const CertifyReport& certified = findings.repair.certify;
  if (certified.pairs > 0) {
    missing += ", with " + number_of(certified.pairs, "pair") + " of triangles that intersect";
  }
  if (certified.degenerate > 0) {
    missing += ", with " + number_of(certified.degenerate, "triangle") + " without area";
  }
  if (certified.inside_out_parts > 0) {
    missing += ", with " + number_of(certified.inside_out_parts, "part") + " inside out";
  }
  return missing.empty() ? missing : missing.substr(2);
}

ExitCode verdict(Run& run, const Findings& findings) {
  if (findings.missing_guarantees.empty()) return ExitCode::done;
  const std::string message = fmt::format(
      "{}: {} {}", findings.output_name(),
      findings.withheld ? "not written, it would be" : "written, but", findings.missing_guarantees);
  run.report.set_error("error: " + message);
  logger().error("{}", message);
  return ExitCode::not_certified;
}

void warn_of_findings(const Findings& findings) {
  warn_of_coarse_grid(findings);
  warn_of_lost_triangles(findings);
  warn_of_lost_surface(findings);
  warn_of_made_up_surface(findings);
  warn_of_filled_walls(findings);
  warn_of_poking_walls(findings);
  warn_of_unknown_parts(findings);
  warn_of_coarse_numbers(findings);
}

void log_warnings(const std::string& name, const std::vector<std::string>& warnings) {
  const std::size_t shown = std::min(warnings.size(), kMostWarnings);
  for (std::size_t i = 0; i < shown; ++i) logger().warn("{}: {}", name, warnings[i]);
  if (warnings.size() > shown) {
    logger().warn("{}: {} more warnings, all in the report", name, warnings.size() - shown);
  }
}

ReadOptions read_options(Run& run) {
  ReadOptions options;
  if (run.options.max_triangles > 0) options.max_triangles = run.options.max_triangles;
  options.progress = &run.progress;
  return options;
}

bool is_same_file(const std::string& a, const std::string& b) {
  if (a == "-" || b == "-") return a == b;
  std::error_code error;
  if (fs::is_character_file(a, error)) return false;
  if (fs::exists(a, error) && fs::exists(b, error)) return fs::equivalent(a, b, error);
  return place_of(a) == place_of(b);
}

std::string Findings::input_name() const { return input == "-" ? "standard input" : input; }

std::string Findings::output_name() const { return output == "-" ? "standard output" : output; }

std::string Findings::written_name() const {
  if (staging.empty()) return output_name();
  return (fs::path(staging) / fs::path(output).filename()).string() + ", to be " + output;
}

TreeFacts facts_of(const Tree& tree) {
  TreeFacts facts;
  facts.triangles = tree.input.triangles.size();
  facts.nodes = tree.nodes.size();
  facts.leaves = tree.leaves.size();
  std::size_t unknown = 0;
  for (const Leaf& leaf : tree.leaves) {
    facts.solid_leaves += leaf.label == Label::solid;
    unknown += leaf.label == Label::unknown;
  }
  facts.labelled = unknown == 0;
  return facts;
}

void check_files(const std::string& input, const std::string& output, Run& run) {
  if (input.empty()) throw UsageError("the name of the input is empty");
  if (input != "-") check_report(run, input, "input");
  if (output.empty()) return;
  check_report(run, output, "output");
  if (output != "-") check_folder(output);
}

void check_folder(const std::string& file) {
  const fs::path folder = fs::path(file).parent_path();
  std::error_code error;
  if (!folder.empty() && !fs::is_directory(folder, error)) {
    throw OutputError(file + ": there is no folder " + folder.string());
  }
  if (fs::is_directory(file, error)) throw OutputError(file + ": is a folder");
}

ExitCode with_findings(Run& run, Findings& findings, const std::function<ExitCode()>& work) {
  run.report.set_input({{"path", findings.input}});
  ExitCode code = ExitCode::internal;
  try {
    run_named(findings.input_name(), [&] { code = work(); });
  } catch (...) {
    warn_of_coarse_grid(findings);
    add_sections(findings, run.report);
    throw;
  }
  add_sections(findings, run.report);
  return code;
}

WriteOptions mesh_format(const StepOptions& options) {
  const std::string& output = options.output;
  WriteOptions format;
  format.format = options.format ? options.format : format_of_extension(output);
  if (!format.format) {
    throw UsageError(output == "-" ? "standard output has no name that tells a format: use --format"
                                   : output + ": no mesh format has this extension (" +
                                         std::string(known_extensions()) +
                                         "; .gz or .zst behind it packs): use --format");
  }
  if (options.sources && !holds_sources(*format.format)) {
    throw UsageError("--sources: " + std::string(format_name(*format.format)) +
                     " cannot hold them, only PLY can");
  }
  check_format(*format.format, options.assets);
  format.staging = options.staging;
  if (!options.assets.root.empty()) format.names_from = fs::path(options.input).parent_path();
  return format;
}

RepairOptions certified_for(SoupFormat format, RepairOptions options) {
  if (is_single(format)) options.certify.precision = Precision::float32;
  options.certify.welded = welds_points(format);
  return options;
}

// Where OUT is written first.
std::string staged(const StepOptions& options) {
  return (fs::path(options.staging) / fs::path(options.output).filename()).string();
}

void check_staging(const StepOptions& options) {
  if (options.staging.empty()) return;
  if (options.output == "-") throw UsageError("--staging: standard output is no file");
}

int run_steps(Program& program, int argc, const char* const* argv, StepOptions& options,
              const StepBody& body) {
  return program.run(argc, argv, [&](Run& run) { return run_steps(options, run, body); });
}

ExitCode run_steps(StepOptions& options, Run& run, const StepBody& body) {
  if (options.output.empty()) throw UsageError("the name of the output is empty");
  check_staging(options);
  check_files(options.input, options.staging.empty() ? options.output : staged(options), run);
  check_picture(options.picture, {options.input, options.output}, run);
  check_explanation(options.explained, {options.input, options.output, options.picture.path}, run);
  check_html(options.html, {options.input, options.output, options.picture.path, options.explained},
             run);
  options.repair.progress = &run.progress;
  return run_body(options, run, body);
}

ReadResult read_mesh_stage(const ReadOptions& options, Run& run, Findings& findings) {
  StageMeter meter(findings.repair.stages, &run.progress);
  meter.begin("read");
  ReadResult result = read_soup(findings.input, options);
  keep_read_report(result.report, findings);
  return result;
}

void keep_read_report(ReadReport report, Findings& findings) {
  findings.unit = report.unit;
  findings.mesh_read = std::move(report);
  log_warnings(findings.input_name(), findings.mesh_read->warnings);
}

Tree read_tree_stage(Run& run, Findings& findings) {
  StageMeter meter(findings.repair.stages, &run.progress);
  meter.begin("read");
  Tree tree = read_tree(findings.input, read_options(run));
  findings.tree_read = facts_of(tree);
  return tree;
}

void measure_distance_stage(const TriangleSoup& input, const Surface& surface, Precision precision,
                            Run& run, Findings& findings) {
  if (run.options.report.empty()) return;
  StageMeter meter(findings.repair.stages, &run.progress);
  meter.begin("distance");
  findings.fidelity = measure_fidelity(input, surface, {precision, &run.progress});
}

Attributes transfer_attributes_stage(const TriangleSoup& input, const Attributes& attributes,
                                     const Surface& surface, Run& run, Findings& findings) {
  if (attributes.is_bare()) return attributes;
  StageMeter meter(findings.repair.stages, &run.progress);
  meter.begin("attributes");
  return transfer_attributes(input, attributes, surface,
                             findings.has_walls || findings.repair.thicken.triangles > 0);
}

// Of a mesh without a name: nobody knows what those beside it are to be called.
void write_with_files(const TriangleSoup& soup, const WriteOptions& format, Run& run,
                      Findings& findings) {
  const Attributes* const attributes = format.extras.attributes;
  if (findings.output == "-" && attributes != nullptr &&
      has_files_beside(*format.format, *attributes)) {
    logger().warn("{}: {} has its materials and pictures in files beside it, and OUT has no name",
                  findings.output_name(), format_name(*format.format));
  }
  findings.staging = format.staging.string();
  write_soup(soup, findings.output, format);
  run.report.set_output({{"path", findings.output}, {"format", format_name(*format.format)}});
}

std::string advice_to_thicken(const RepairReport& repair) {
  if (repair.thicken.fitting == 0) return {};
  return fmt::format("; --thicken {:g} makes walls of them", repair.thicken.fitting);
}

void write_mesh_stage(const Surface& surface, const Attributes& attributes, WriteOptions format,
                      const StepOptions& options, Run& run, Findings& findings) {
  StageMeter meter(findings.repair.stages, &run.progress);
  meter.begin("write");
  look_at_file(surface, *format.format, findings);
  findings.missing_guarantees = missing_guarantees(findings, *format.format);
  findings.withheld = options.strict && !findings.missing_guarantees.empty();
  if (findings.withheld) return;
  if (options.sources) format.extras.sources = surface.source;
  if (!attributes.empty()) format.extras.attributes = &attributes;
  format.progress = &run.progress;
  write_with_files(surface.mesh, format, run, findings);
}

void write_soup_stage(const TriangleSoup& soup, WriteOptions format, Run& run, Findings& findings) {
  StageMeter meter(findings.repair.stages, &run.progress);
  meter.begin("write");
  format.progress = &run.progress;
  write_with_files(soup, format, run, findings);
  findings.soup_written = true;
  findings.soup_triangles = soup.triangles.size();
}

void write_tree_stage(const Tree& tree, Run& run, Findings& findings) {
  StageMeter meter(findings.repair.stages, &run.progress);
  meter.begin("write");
  write_tree(tree, findings.output, &run.progress);
  findings.tree_written = facts_of(tree);
  run.report.set_output({{"path", findings.output}, {"format", "BSP tree"}});
}

}  // namespace meshrepair
