// SPDX-License-Identifier: MIT
#include "summary/summary.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <spdlog/fmt/fmt.h>

#include "pictures/explanation_file.h"
#include "report/thickness_report.h"
#include "report/words.h"
#include "summary/change_bar.h"
#include "summary/volumes_words.h"
#include "summary/wall_words.h"
#include "terminal/logging.h"
#include "terminal/warning_log.h"

namespace meshrepair {
namespace {

// Lines of a label and a text; a line that continues the one above has no label.
class Lines {
 public:
  Lines() = default;
  explicit Lines(std::string before) : before_(std::move(before)) {}  // each text

  void add(std::string_view label, const std::string& text) {
    text_ += fmt::format("{:<9} {}{}\n", label, before_, text);
  }
  void add(std::string_view label, const std::vector<std::string>& texts) {
    for (const std::string& text : texts) add(&text == texts.data() ? label : "", text);
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string before_, text_;
};

std::string joined(const std::vector<std::string>& words) { return joined_with(", ", words); }

void add_count(std::vector<std::string>& texts, std::uint64_t count, std::string_view noun,
               const std::string& what) {
  if (count > 0) texts.push_back(number_of(count, noun) + " " + what);
}

std::string words_of(const ReadReport& read) {
  return format_words(format_name(read.format), read.packed);
}

std::string reading_troubles(const ReadReport& read) {
  std::vector<std::string> texts;
  add_count(texts, read.missing_faces, "face", "promised but missing");
  add_count(texts, read.bad_faces, "face", "unreadable");
  add_count(texts, read.bad_points, "point", "unreadable");
  return joined(texts);
}

std::string dropped_triangles(const CleanReport& clean) {
  std::vector<std::string> texts;
  const std::size_t copies = clean.duplicates + clean.opposite_duplicates;
  if (copies > 0) texts.push_back(number_of(copies, "duplicate"));
  if (clean.dropped_degenerate > 0)
    texts.push_back(grouped(clean.dropped_degenerate) + " degenerate");
  if (clean.dropped_below_grid > 0)
    texts.push_back(grouped(clean.dropped_below_grid) + " below the grid");
  if (clean.dropped_not_finite > 0) {
    texts.push_back(grouped(clean.dropped_not_finite) + " with NaN or infinity");
  }
  return texts.empty() ? std::string() : "triangles dropped: " + joined(texts);
}

std::vector<std::string> troubles_of(const Findings& findings) {
  const Topology& input = findings.repair.input;
  std::vector<std::string> texts;
  if (findings.mesh_read) texts.push_back(reading_troubles(*findings.mesh_read));
  texts.push_back(dropped_triangles(findings.repair.clean));
  std::erase(texts, "");
  add_count(texts, input.open_edges, "open edge", "(gaps and holes)");
  if (input.nonmanifold_edges > 0)
    texts.push_back(number_of(input.nonmanifold_edges, "non-manifold edge"));
  add_count(texts, input.inconsistent_edges, "edge", "between triangles of opposite orientation");
  if (input.nonmanifold_vertices > 0) {
    texts.push_back(
        number_of(input.nonmanifold_vertices, "non-manifold vertex", "non-manifold vertices"));
  }
  if (findings.repair.kept_valid) {
    texts.emplace_back(findings.mesh_read && is_difference(findings.mesh_read->volumes)
                           ? "nothing: what the subtraction leaves bounds a solid"
                           : "nothing: the mesh bounds a solid and is not changed");
  } else if (texts.empty()) {
    texts.emplace_back("no defective edges (intersections are not counted)");
  }
  return texts;
}

std::string dropped_points(const Findings& findings) {
  const PointSoupReport& soup = *findings.point_soup;
  std::vector<std::string> texts;
  add_count(texts, findings.points_read->missing_points, "point", "promised but missing");
  add_count(texts, findings.points_read->bad_points, "point", "unreadable");
  add_count(texts, soup.not_finite, "point", "with NaN or infinity");
  if (soup.duplicates > 0) texts.push_back(number_of(soup.duplicates, "duplicate"));
  if (soup.outliers > 0) texts.push_back(number_of(soup.outliers, "outlier"));
  add_count(texts, findings.joined_columns, "point", "above others in single precision");
  return joined(texts);
}

std::vector<std::string> local_triangles(const PointSoupReport& soup) {
  std::vector<std::string> texts = {
      fmt::format("{}; proposed by three corners: {}, by two: {}, by one: {}",
                  number_of(soup.triangles, "triangle"), grouped(soup.by_votes[2]),
                  grouped(soup.by_votes[1]), grouped(soup.by_votes[0]))};
  if (soup.farthest_move > 0) {
    texts.push_back(fmt::format("points moved by at most {:.3g}", soup.farthest_move));
  }
  return texts;
}

// Which options a try has that nobody asked for.
std::string followed_advice(const std::vector<PointTry>& tries) {
  if (tries.size() <= 1) return {};
  const PointTry& first = tries.front();
  const PointTry& last = tries.back();
  std::vector<std::string> options;
  if (last.project != first.project || last.neighbours != first.neighbours) {
    options.push_back(fmt::format("--project {} --neighbours {}, as the points are noisy",
                                  last.project, last.neighbours));
  }
  if (last.base && !first.base) options.emplace_back("--base, as they are a terrain");
  if (options.empty()) return {};  // walls are asked for
  return fmt::format("the points alone enclose nothing; used {}", joined(options));
}

void describe_base(const Findings& findings, Lines& lines) {
  if (!findings.scan_base) return;
  lines.add("base",
            fmt::format("{} on a floor at {:.6g}, walls of {}",
                        number_of(findings.scan_base->parts, "part"), findings.scan_base->floor,
                        number_of(findings.scan_base->skirt_triangles, "triangle")));
}

void describe_points(const Findings& findings, Lines& lines) {
  const PointReadReport& read = *findings.points_read;
  const PointSoupReport& soup = *findings.point_soup;
  lines.add("read",
            fmt::format("{}: {}, {}, {} apart{}", findings.input_name(),
                        format_words(format_name(read.format), read.packed),
                        number_of(soup.points_in, "point"), fmt::format("{:.3g}", soup.spacing),
                        soup.normals_used ? ", with normals" : ""));
  if (const std::string dropped = dropped_points(findings); !dropped.empty()) {
    lines.add("dropped", dropped);
  }
  if (const std::string advice = followed_advice(findings.tries); !advice.empty()) {
    lines.add("advice", advice);
  }
  lines.add("meshed", local_triangles(soup));
}

void describe_volumes(const ReadReport& read, Lines& lines) {
  if (!read.volumes.empty()) lines.add("volumes", volumes_words(read.volumes));
}

void describe_input(const Findings& findings, Lines& lines) {
  if (findings.point_soup) {
    describe_points(findings, lines);
    if (!findings.soup_written) lines.add("wrong", troubles_of(findings));
  }
  if (findings.mesh_read && findings.soup_written) {
    lines.add("read", fmt::format("{}: {}", findings.input_name(), words_of(*findings.mesh_read)));
    describe_volumes(*findings.mesh_read, lines);
    if (const std::string troubles = reading_troubles(*findings.mesh_read); !troubles.empty()) {
      lines.add("wrong", troubles);
    }
  } else if (findings.mesh_read) {
    lines.add("read",
              fmt::format("{}: {}, {} in {}", findings.input_name(), words_of(*findings.mesh_read),
                          number_of(findings.repair.clean.triangles_in, "triangle"),
                          number_of(findings.repair.input.parts, "part")));
    describe_volumes(*findings.mesh_read, lines);
    lines.add("wrong", troubles_of(findings));
  }
  if (findings.origin) {
    const Vec3d& origin = *findings.origin;
    lines.add("origin",
              fmt::format("{:.12g}, {:.12g}, {:.12g} is to be added to the coordinates of OUT",
                          origin.x(), origin.y(), origin.z()));
  }
  describe_base(findings, lines);
  if (findings.tree_read) {
    lines.add("read", fmt::format("{}: tree of {}, {}", findings.input_name(),
                                  number_of(findings.tree_read->triangles, "triangle"),
                                  number_of(findings.tree_read->leaves, "cell")));
  }
}

void describe_decision(const RepairReport& repair, Lines& lines) {
  const InsideReport& inside = repair.inside;
  std::vector<std::string> remarks;
  add_count(remarks, repair.orient.turned_triangles, "triangle", "flipped like the neighbours");
  if (!inside.exact && inside.contradictions > 0) {
    remarks.emplace_back("no solid fits all triangles; took the most likely");
  }
  add_count(remarks, inside.left_out_folds, "inverted fold", "left out");
  add_count(remarks, inside.filled_voids, "void", "filled");
  std::vector<std::string> texts = {
      fmt::format("decided by {}{}", rule_name(inside.used),
                  inside.asked == InsideRule::automatic ? ": " + inside.reason : ", as requested")};
  if (!remarks.empty()) texts.push_back(joined(remarks));
  if (inside.poking_walls > 0) {
    texts.push_back(
        fmt::format("{} that {} out of the surrounding solid, by up to {:.2g} % of the area",
                    number_of(inside.poking_walls, "wall of a cavity", "walls of cavities"),
                    inside.poking_walls == 1 ? "pokes" : "poke", 100 * inside.poking_share));
  }
  if (inside.other != InsideRule::automatic) {
    texts.push_back(
        fmt::format("almost as likely: the solid of --inside {}", rule_name(inside.other)));
  }
  lines.add("inside", texts);
}

void describe_sewing(const SewReport& sew, Lines& lines) {
  if (sew.refused_distance > 0) {
    lines.add(
        "unsewn",
        fmt::format(
            "open edges up to {:.3g} apart are not sewn automatically; set a distance with --sew",
            sew.refused_distance));
  }
  if (sew.distance == 0) return;
  std::string text =
      fmt::format("{} of {}, at most {:.3g} apart; {} moved by at most {:.3g}",
                  grouped(sew.sewn_edges), number_of(sew.open_edges, "open edge"), sew.widest_gap,
                  number_of(sew.joined_points, "corner"), sew.farthest_move);
  if (sew.lost_triangles > 0) {
    text += ", " + number_of(sew.lost_triangles, "smaller triangle") + " lost";
  }
  if (sew.split_edges > 0) text += ", " + number_of(sew.split_edges, "edge") + " split";
  lines.add("sewn", text);
}

void describe_gaps(const JoinGapsReport& gaps, Lines& lines) {
  if (gaps.distance == 0) return;
  std::string text = "nothing";
  if (gaps.left == 0) text += fmt::format(": no gaps up to {:.3g}", gaps.distance);
  if (gaps.pairs > 0) {
    text = fmt::format("{} across gaps of at most {:.3g}",
                       number_of(gaps.pairs, "pair of faces", "pairs of faces"), gaps.widest_gap);
  } else if (gaps.farthest_move > 0) {
    text = "faces that touch, but for rounding";
  }
  if (gaps.joined_points > 0) text += "; " + number_of(gaps.joined_points, "corner") + " joined";
  if (gaps.farthest_move > 0) {
    text += fmt::format("; corners moved by at most {:.3g}", gaps.farthest_move);
  }
  if (gaps.left > 0) {
    text += fmt::format("; {} still closer than {:.3g}", number_of(gaps.left, "pair", "pairs"),
                        gaps.distance);
  }
  lines.add("joined", text);
}

void describe_holes(const RepairReport& repair, Lines& lines) {
  const HoleReport& holes = repair.holes;
  std::vector<std::string> texts;
  if (holes.closed > 0) {
    texts.push_back(fmt::format("{} with {}, area {:.6g}, {:.3g} % of the surface",
                                number_of(holes.closed, "hole"),
                                number_of(holes.triangles, "triangle"), holes.area,
                                100 * holes.area / (repair.input_area + holes.area)));
    add_count(texts, holes.rings, "pair", "of them joined: a gap, a mouth or a tunnel");
  }
  if (holes.too_large > 0) {
    texts.push_back(fmt::format("not {}: larger than --max-hole, or rims of open sheets",
                                number_of(holes.too_large, "opening")));
  }
  lines.add("closed", texts);
}

void describe_seals(const SealReport& seal, Lines& lines) {
  if (seal.size <= 0 && !seal.automatic) return;
  std::vector<std::string> texts;
  if (seal.size <= 0) {
    texts.emplace_back("nothing: no narrow opening of a much wider space");
  } else if (seal.openings > 0) {
    texts.push_back(seal.double_walls > 0
                        ? fmt::format("{} of {}, up to {:.3g} wide",
                                      number_of(seal.openings, "pinhole"),
                                      number_of(seal.double_walls, "double wall"), seal.size)
                        : fmt::format("{} narrower than {:.6g}",
                                      number_of(seal.openings, "opening"), seal.size));
    if (std::isfinite(seal.filled_volume)) {
      texts.back() += fmt::format(", volume {:.6g} behind", seal.filled_volume);
    }
  } else if (seal.leaks == 0 && seal.cannot_cut == 0) {
    texts.push_back(
        fmt::format("nothing: no opening narrower than {:.6g} leads into a space", seal.size));
  }
  if (seal.leaks > 0) {
    texts.push_back(fmt::format("not {}: another opening, narrower than {:.3g}, leads in",
                                number_of(seal.leaks, "space"), seal.step));
  }
  if (seal.cannot_cut > 0) {
    texts.push_back(fmt::format("not {}: walls nearly coincide there; try another size",
                                number_of(seal.cannot_cut, "body", "bodies")));
  }
  lines.add("sealed", texts);
}

void describe_walls(const ThickenReport& thicken, Lines& lines) {
  if (thicken.triangles == 0) return;
  std::vector<std::string> texts = {fmt::format(
      "{} of {}, area {:.6g}, to walls of {:.6g}{}{}", number_of(thicken.triangles, "triangle"),
      number_of(thicken.sheets, "sheet"), thicken.area, thicken.thickness,
      thicken.side == ThickenSide::middle
          ? std::string()
          : fmt::format(" {} of them", thicken_side_name(thicken.side)),
      thicken.automatic ? ", chosen automatically" : "")};
  if (thicken.solid_volume > 0) {
    texts.push_back(fmt::format("in addition to solids of volume {:.6g}", thicken.solid_volume));
  }
  lines.add("thickened", texts);
}

void describe_purpose(const Purpose& purpose, Lines& lines) {
  if (purpose.name.empty()) return;
  const std::string set = purpose.options.empty()
                              ? "nothing beyond the command line"
                              : fmt::format("{}", fmt::join(purpose.options, " "));
  std::vector<std::string> texts = {fmt::format("{}: {}", purpose.name, set)};
  if (!purpose.overridden.empty()) {
    texts.push_back(fmt::format("set on the command line: {}", fmt::join(purpose.overridden, " ")));
  }
  lines.add("for", texts);
}

// Loose points are the rule with floating predicates, not worth telling.
void describe_predicates(const RepairReport& repair, Lines& lines) {
  if (repair.predicates == Predicates::exact) return;
  const ClipReport& clip = repair.clip;
  std::vector<std::string> cuts;
  add_count(cuts, clip.region_floods, "cut", "by flooding");
  add_count(cuts, clip.several_regions, "cut", "with several regions");
  add_count(cuts, clip.forced_cuts, "cut", "forced");
  std::vector<std::string> facets;
  add_count(facets, clip.several_groups, "facet", "clipped as stars");
  add_count(facets, repair.cover.guessed_facets, "facet", "covered by guess");
  add_count(facets, repair.extract.polygons_apart, "facet", "set apart");
  std::vector<std::string> texts = {fmt::format("in floating point, eps {:g}, over {}",
                                                repair.epsilon, number_of(clip.clips, "cut"))};
  texts.push_back(joined(cuts));
  texts.push_back(joined(facets));
  std::erase(texts, "");
  lines.add("sides", texts);
}

std::string kept_triangles(const RepairReport& repair) {
  const TriangleFates& fates = repair.triangles;
  std::string text = fmt::format("{} of {} untouched", grouped(fates.untouched + fates.rounded),
                                 number_of(repair.clean.triangles_in, "triangle"));
  if (fates.rounded > 0) text += " except for rounding to single precision";
  if (fates.cut > fates.rounded) text += ", " + grouped(fates.cut - fates.rounded) + " cut";
  return text;
}

std::vector<std::string> removed_parts(const RepairReport& repair) {
  std::vector<std::string> texts;
  const PartFates& fates = repair.parts;
  if (fates.inside_triangles + fates.outside_triangles > 0) {
    texts.push_back(fmt::format("{} inside the solid, {} outside it or duplicate",
                                number_of(fates.inside_triangles, "triangle"),
                                grouped(fates.outside_triangles)));
  }
  const auto add = [&](const PartsAndArea& parts, std::string_view what) {
    if (parts.parts == 0) return;
    texts.push_back(fmt::format("among them {} that {} {}, area {:.6g}",
                                number_of(parts.parts, "part"), parts.parts == 1 ? "is" : "are",
                                what, parts.area));
  };
  add(fates.enclosing_nothing, "no wall of the solid");
  add(fates.inside_solid, "inside the solid");
  if (fates.closed_inside > 0 && repair.inside.used == InsideRule::winding) {
    texts.push_back(fmt::format("{} of these would bound a void with --inside parity",
                                grouped(fates.closed_inside)));
  }
  add_count(texts, repair.open_regions, "region", "barely enclosed by open sheets");
  add_count(texts, repair.crumbs, "part", "thinner than a step of the working grid");
  add_count(texts, repair.thin_cells.filled, "piece",
            "of slits narrower than the numbers can resolve");
  add_count(texts, repair.thin_cells.emptied, "piece",
            "of fins thinner than the numbers can resolve");
  add_count(texts, repair.certify.dropped_parts, "part",
            "too thin for the precision of the format");
  return texts;
}

// The first of each kind.
std::vector<std::string> left_out_parts(const KeepPartsReport& keep) {
  constexpr std::size_t kMostPartLines = 3;
  std::vector<std::string> texts;
  for (const bool is_void : {false, true}) {
    std::vector<const RemovedPart*> parts;
    for (const RemovedPart& part : keep.removed) {
      if (part.is_void == is_void) parts.push_back(&part);
    }
    if (parts.empty()) continue;
    texts.push_back(
        fmt::format("{} of {}{}:", grouped(parts.size()),
                    is_void ? number_of(keep.voids, "void") : number_of(keep.solids, "solid"),
                    is_void ? ", filled" : ""));
    for (std::size_t i = 0; i < std::min(kMostPartLines, parts.size()); ++i) {
      const RemovedPart& part = *parts[i];
      texts.push_back(fmt::format("  volume {:.4g} at {:.4g} {:.4g} {:.4g}", part.volume,
                                  part.centre.x(), part.centre.y(), part.centre.z()));
    }
    if (parts.size() > kMostPartLines)
      texts.push_back(fmt::format("  and {} more", grouped(parts.size() - kMostPartLines)));
  }
  return texts;
}

std::vector<std::string> simplified(const SimplifyReport& report) {
  if (report.removed_triangles == 0) return {};
  return {fmt::format("{} fewer along cuts; the surface moved by at most {:.2g}",
                      number_of(report.removed_triangles, "triangle"), report.distance)};
}

std::vector<std::string> reduced(const RepairReport& repair) {
  if (!repair.fewer.done) return {};
  const FewerTrianglesReport& fewer = repair.fewer;
  std::string text =
      fmt::format("{} to {}", number_of(fewer.before, "triangle"), grouped(fewer.after));
  if (fewer.asked > 0) text += fmt::format(" of {} asked for", grouped(fewer.asked));
  if (fewer.most_distance > 0) {
    text +=
        fmt::format(", proven to be at most {:.3g} from the repaired mesh", fewer.most_distance);
  }
  const double change = fewer.volume_after / fewer.volume_before - 1;
  if (std::isfinite(change)) text += fmt::format("; volume {:+.1f} %", 100 * change);
  return {text};
}

void describe_mesh(const Findings& findings, double seconds, Lines& lines) {
  const RepairReport& repair = findings.repair;
  const Topology& output = repair.output;
  lines.add("written", fmt::format("{}: {} in {}, in {:.2f} s", findings.written_name(),
                                   number_of(output.triangles, "triangle"),
                                   number_of(output.parts, "part"), seconds));
  if (repair.clean.triangles_in > 0) {
    lines.add("kept", kept_triangles(repair));
  }
  std::vector<std::string> removed = removed_parts(repair);
  add_count(removed, findings.dropped_solids, "solid", "smaller than the points can resolve");
  lines.add("removed", removed);
  lines.add("left out", left_out_parts(repair.keep));
  lines.add("simpler", simplified(repair.simplify));
  lines.add("reduced", reduced(repair));
  lines.add("explained", explanation_lines(findings));
  lines.add("checked",
            joined({output.closed() ? "closed" : "NOT CLOSED",
                    output.manifold() ? "manifold" : "NOT MANIFOLD",
                    output.oriented() && repair.certify.inside_out_parts == 0 ? "oriented"
                                                                              : "NOT ORIENTED",
                    repair.certify.pairs + repair.certify.degenerate == 0 && repair.certify.done
                        ? "free of self-intersections"
                        : "WITH SELF-INTERSECTIONS"}));
  if (!std::isfinite(repair.output_volume) || !std::isfinite(repair.output_area)) return;
  lines.add("size", fmt::format("volume {:.6g}, area {:.6g}, in {}", repair.output_volume,
                                repair.output_area, units_text(findings.unit)));
}

void describe_soup(const Findings& findings, double seconds, Lines& lines) {
  lines.add("written", fmt::format("{}: {}, in {:.2f} s", findings.written_name(),
                                   number_of(findings.soup_triangles, "triangle"), seconds));
}

void describe_tree(const Findings& findings, double seconds, Lines& lines) {
  const TreeFacts& tree = *findings.tree_written;
  const std::string what = tree.labelled ? fmt::format("{} of {} solid", grouped(tree.solid_leaves),
                                                       number_of(tree.leaves, "cell"))
                                         : fmt::format("{}, {}", number_of(tree.nodes, "cut"),
                                                       number_of(tree.leaves, "cell"));
  lines.add("written", fmt::format("{}: {}, in {:.2f} s", findings.output_name(), what, seconds));
}

}  // namespace

std::string predicates_summary(const RepairReport& repair) {
  Lines lines;
  describe_predicates(repair, lines);
  return lines.text();
}

std::string purpose_summary(const Purpose& purpose) {
  Lines lines;
  describe_purpose(purpose, lines);
  return lines.text();
}

std::string gaps_summary(const RepairReport& repair) {
  Lines lines;
  describe_gaps(repair.join_gaps, lines);
  return lines.text();
}

std::string walls_summary(const std::string& mesh, const RepairReport& repair) {
  Lines lines(mesh + ": ");
  if (repair.seal.openings + repair.seal.leaks + repair.seal.cannot_cut > 0)
    describe_seals(repair.seal, lines);
  describe_walls(repair.thicken, lines);
  return lines.text();
}

std::string summary_of(const Findings& findings, double seconds) {
  if (!findings.summary.empty()) return findings.summary;
  Lines lines;
  describe_input(findings, lines);
  describe_purpose(findings.purpose, lines);
  describe_gaps(findings.repair.join_gaps, lines);
  describe_sewing(findings.repair.sew, lines);
  describe_holes(findings.repair, lines);
  describe_seals(findings.repair.seal, lines);
  describe_walls(findings.repair.thicken, lines);
  describe_predicates(findings.repair, lines);
  if (findings.repair.inside.solid_cells > 0 || findings.repair.spared_cells) {
    describe_decision(findings.repair, lines);
  }
  lines.add("offset", offset_words(findings.offset));
  lines.add("hollow", hollow_words(findings.hollow));
  if (findings.tree_written) {
    describe_tree(findings, seconds, lines);
  } else if (findings.soup_written) {
    describe_soup(findings, seconds, lines);
  } else {
    describe_mesh(findings, seconds, lines);
  }
  return lines.text() + (findings.thin ? thickness_text(*findings.thin, true) : std::string());
}

void print_summary(Run& run, const Findings& findings) {
  if (run.options.quiet) return;
  const double seconds = run.progress.seconds();
  run.progress.finish();
  show_held_warnings();
  std::string text = summary_of(findings, seconds);
  if (findings.shows_bar) text += change_bar(findings.repair);
  print_summary(text + findings.shown);
}

}  // namespace meshrepair
