// SPDX-License-Identifier: MIT
#include "steps/scene_steps.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include <base/error.h>
#include <mesh/append_soup.h>

#include "page/scene_page.h"
#include "pictures/explanation_file.h"
#include "pictures/picture_steps.h"
#include "report/report_sections.h"
#include "report/words.h"
#include "steps/guarantees.h"
#include "steps/mesh_steps.h"
#include "summary/summary.h"
#include "summary/volumes_words.h"
#include "summary/warnings.h"

namespace meshrepair {
namespace {

constexpr std::size_t kMostLines = 20;

// One mesh of a scene, and what became of it.
struct MeshOutcome {
  explicit MeshOutcome(Findings facts) : findings(std::move(facts)) {}

  std::string name;            // for people
  Findings findings;           // as if it were alone
  std::string trouble;         // why it is no solid; empty: it is one
  bool left_as_it_is = false;  // it encloses nothing
  std::size_t triangles_in = 0, triangles = 0;
};

void append(const Surface& mesh, std::size_t first_source, Surface& all) {
  append_soup(all.mesh, mesh.mesh);
  for (const std::uint32_t source : mesh.source) {
    all.source.push_back(
        source == Surface::kNoSource ? source : source + static_cast<std::uint32_t>(first_source));
  }
  all.input_point.insert(all.input_point.end(), mesh.input_point.begin(), mesh.input_point.end());
}

// What the triangles of one mesh carry of what all do: values and labels without their names.
Attributes carried_by(const Attributes& all, std::size_t first, std::size_t triangles) {
  Attributes one;
  const auto part = [&](const std::vector<std::uint32_t>& of_all, std::size_t each) {
    if (of_all.empty()) return std::vector<std::uint32_t>();
    const auto begin = of_all.begin() + static_cast<std::ptrdiff_t>(each * first);
    return std::vector(begin, begin + static_cast<std::ptrdiff_t>(each * triangles));
  };
  for (const CornerAttribute& given : all.corners) {
    CornerAttribute& own = one.corners.emplace_back();
    own.kind = given.kind;
    own.name = given.name;
    own.place = given.place;
    own.storage = given.storage;
    own.components = given.components;
    own.of_corner = part(given.of_corner, 3);
    for (std::uint32_t& value : own.of_corner) {
      if (value == kNone) continue;
      const auto at = given.values.begin() + static_cast<std::ptrdiff_t>(given.components * value);
      value = static_cast<std::uint32_t>(own.count());
      own.values.insert(own.values.end(), at, at + static_cast<std::ptrdiff_t>(given.components));
    }
    share_values(own);
  }
  one.materials.of_triangle = part(all.materials.of_triangle, 1);
  one.groups.of_triangle = part(all.groups.of_triangle, 1);
  one.objects.of_triangle = part(all.objects.of_triangle, 1);
  one.smoothing.of_triangle = part(all.smoothing.of_triangle, 1);
  for (const TrianglePaint& paint : all.paints) {
    one.paints.push_back({paint.name, {paint.codes.names, part(paint.codes.of_triangle, 1)}});
  }
  return one;
}

class SceneRepair {
 public:
  SceneRepair(const AnySoup& input, const Attributes& given, RepairOptions repair_options,
              const WriteOptions& format, const StepOptions& options, Run& run, Findings& findings)
      : input_(input),
        given_(given),
        reach_(std::exchange(repair_options.reach, {})),
        repair_options_(std::move(repair_options)),
        format_(format),
        options_(options),
        run_(run),
        findings_(findings),
        scene_(input.scene) {}

  void run() {
    const std::vector<TriangleSoup> meshes = meshes_of(input_.soup, input_.scene);
    for (std::size_t m = 0; m < meshes.size(); ++m) {
      Surface surface;
      if (!meshes[m].triangles.empty()) surface = repair_one(meshes[m], m);
      scene_.meshes[m].points = surface.mesh.points.size();
      scene_.meshes[m].triangles = surface.mesh.triangles.size();
      append(surface, first_, all_);
      explain(meshes[m], surface);
      first_ += meshes[m].triangles.size();
    }
    report();
    require_a_solid();
    judge();
    if (!corners_.empty()) corners_.resize(3 * all_.mesh.triangles.size());
    findings_.repair.fewer.corners = std::move(corners_);
    const Attributes attributes =
        transfer_attributes_stage(input_.soup, input_.attributes, all_, run_, findings_);
    if (!findings_.withheld) write(attributes);
    write_explanation_stage(options_.explained, {input_.soup, input_.scene}, {all_.mesh, scene_},
                            run_, findings_);
    draw(attributes);
    write_scene_page_stage(options_.html,
                           {up_of(findings_),
                            {input_.soup, given_, input_.scene},
                            SceneOnPage{all_.mesh, attributes, scene_}},
                           run_, findings_);
    findings_.summary = summary();
  }

 private:
  Surface repair_one(const TriangleSoup& soup, std::size_t number) {
    const std::string shown = mesh_name(scene_, number);
    MeshOutcome& outcome =
        outcomes_.emplace_back(Findings(findings_.input_name() + ": " + shown, findings_.output));
    outcome.name = shown;
    outcome.triangles_in = soup.triangles.size();
    outcome.findings.mesh_read.emplace().format = findings_.mesh_read->format;
    outcome.findings.wants_fidelity = findings_.wants_fidelity;
    Surface surface = made_solid(soup, outcome);
    outcome.triangles = surface.mesh.triangles.size();
    return surface;
  }

  Surface made_solid(const TriangleSoup& soup, MeshOutcome& outcome) {
    try {
      Surface surface = repair(soup, options_of(soup), outcome.findings.repair);
      findings_.has_walls |= outcome.findings.repair.thicken.triangles > 0;
      append_corners(outcome.findings.repair.fewer);
      measure_distance_stage(soup, surface, repair_options_.certify.precision, run_,
                             outcome.findings);
      look_at_file(surface, *format_.format, outcome.findings);
      outcome.trouble = missing_guarantees(outcome.findings, *format_.format);
      warn_of_findings(outcome.findings);
      judge_requirements(options_.required, outcome.findings);
      for (const std::string& one : outcome.findings.not_met) {
        findings_.not_met.push_back(outcome.name + ": " + one);
      }
      return surface;
    } catch (const NoSolidError& error) {
      outcome.trouble =
          error.what() + advice_to_thicken(outcome.findings.repair) + "; left as it is";
      outcome.left_as_it_is = true;
      return as_given(soup);
    }
  }

  // What became of the last mesh, behind what is known of those before it.
  void explain(const TriangleSoup& soup, const Surface& surface) {
    if (!repair_options_.explain || soup.triangles.empty()) return;
    RepairExplanation& all = findings_.repair.explanation;
    const MeshOutcome& outcome = outcomes_.back();
    if (outcome.left_as_it_is) {
      all.fates.resize(all.fates.size() + soup.triangles.size(), TriangleFate::whole);
      all.origins.resize(all.origins.size() + surface.source.size(), TriangleOrigin::whole);
      return;
    }
    const RepairExplanation& one = outcome.findings.repair.explanation;
    all.fates.insert(all.fates.end(), one.fates.begin(), one.fates.end());
    all.origins.insert(all.origins.end(), one.origins.begin(), one.origins.end());
  }

  // Where those of the mesh in hand have their values, behind those of the meshes before it.
  void append_corners(FewerTrianglesReport& fewer) {
    if (fewer.corners.empty()) return;
    corners_.resize(3 * all_.mesh.triangles.size());
    for (CornerOrigin origin : std::exchange(fewer.corners, {})) {
      if (origin.source != Surface::kNoSource) origin.source += static_cast<std::uint32_t>(first_);
      corners_.push_back(origin);
    }
  }

  [[nodiscard]] RepairOptions options_of(const TriangleSoup& soup) {
    RepairOptions options = repair_options_;
    if (options.fewer.wanted() && options.fewer.attributes != nullptr) {
      carried_ = carried_by(input_.attributes, first_, soup.triangles.size());
      options.fewer.attributes = &carried_;
    }
    const auto take_own = [&](const auto& of_all, auto& own) {
      if (of_all.empty()) return;
      const auto first = of_all.begin() + static_cast<std::ptrdiff_t>(first_);
      own.assign(first, first + static_cast<std::ptrdiff_t>(soup.triangles.size()));
    };
    take_own(reach_, options.reach);
    return options;
  }

  [[nodiscard]] std::size_t in_trouble() const {
    return static_cast<std::size_t>(std::count_if(
        outcomes_.begin(), outcomes_.end(), [](const auto& one) { return !one.trouble.empty(); }));
  }

  void report() {
    Json list = Json::array();
    for (const MeshOutcome& one : outcomes_) {
      JsonReport sections("", {});
      add_sections(one.findings, sections);
      Json facts = {{"name", one.name},
                    {"triangles_in", one.triangles_in},
                    {"triangles", one.triangles},
                    {"certified", one.trouble.empty()},
                    {"trouble", one.trouble.empty() ? Json() : Json(one.trouble)}};
      Json others = sections.take_sections();
      others.erase("read");
      facts.update(others);
      facts["stages"] = stages_section(one.findings.repair.stages);
      list.push_back(std::move(facts));
    }
    run_.report.set_section("meshes", std::move(list));
  }

  void require_a_solid() const {
    const bool has_one = std::any_of(outcomes_.begin(), outcomes_.end(), [](const auto& one) {
      return one.findings.repair.output.triangles > 0;
    });
    if (has_one) return;
    throw NoSolidError(outcomes_.size() == 1
                           ? outcomes_.front().name + ": " + outcomes_.front().trouble
                           : "none of its " + number_of(outcomes_.size(), "mesh", "meshes") +
                                 " encloses anything");
  }

  void judge() {
    const std::size_t count = in_trouble();
    findings_.withheld = options_.strict && (count > 0 || !findings_.not_met.empty());
    if (count == 0) return;
    const auto first = std::find_if(outcomes_.begin(), outcomes_.end(),
                                    [](const auto& one) { return !one.trouble.empty(); });
    findings_.missing_guarantees =
        fmt::format("{} of {} {} not the boundary of a solid; {}: {}", count,
                    number_of(outcomes_.size(), "mesh", "meshes"), count == 1 ? "is" : "are",
                    first->name, first->trouble);
  }

  void draw(Attributes attributes) {
    if (!options_.picture.wanted()) return;
    TriangleSoup before = input_.soup, after = all_.mesh;
    Attributes given;
    if (options_.picture.painted) {
      std::array<Attributes, 2> fates = painted_fates(options_.picture, findings_);
      given = std::move(fates[0]);
      attributes = std::move(fates[1]);
    } else {
      given = given_;
    }
    place_instances(before, given, input_.scene);
    place_instances(after, attributes, scene_);
    draw_picture_stage(options_.picture, up_of(findings_), {options_.input},
                       {{before, given}, {after, attributes}}, run_, findings_);
  }

  void write(const Attributes& attributes) {
    StageMeter meter(findings_.repair.stages, &run_.progress);
    meter.begin("write");
    WriteOptions format = format_;
    if (!attributes.empty()) format.extras.attributes = &attributes;
    format.extras.scene = &scene_;
    format.progress = &run_.progress;
    write_with_files(all_.mesh, format, run_, findings_);
  }

  [[nodiscard]] std::string summary() const {
    const std::string meshes = number_of(outcomes_.size(), "mesh", "meshes");
    std::string text = fmt::format("read      {}: {}, {}, {}\n", findings_.input_name(),
                                   format_name(findings_.mesh_read->format), meshes,
                                   number_of(input_.soup.triangles.size(), "triangle"));
    if (const auto words = volumes_words(findings_.mesh_read->volumes); !words.empty()) {
      text += fmt::format("{:<9} {}\n", "volumes", words);
    }
    text += purpose_summary(findings_.purpose);
    for (std::size_t i = 0; i < std::min(kMostLines, outcomes_.size()); ++i) {
      const MeshOutcome& one = outcomes_[i];
      text += fmt::format("{:<9} {}: {} of {}, {}\n", i == 0 ? "meshes" : "", one.name,
                          number_of(one.triangles, "triangle"), grouped(one.triangles_in),
                          fate_of(one));
    }
    if (outcomes_.size() > kMostLines) {
      text += fmt::format("{:<9} and {} more\n", "", outcomes_.size() - kMostLines);
    }
    text += walls_text();
    for (const std::string& line : explanation_lines(findings_)) {
      text += fmt::format("{:<9} {}\n", line == findings_.explained ? "explained" : "", line);
    }
    return text + fmt::format("written   {}: {}, {}, in {:.2f} s\n", findings_.written_name(),
                              meshes, number_of(all_.mesh.triangles.size(), "triangle"),
                              run_.progress.seconds());
  }

  // What was sealed and thickened, of each mesh; what is asked for in vain as well.
  [[nodiscard]] std::string walls_text() const {
    std::string text;
    std::size_t meshes = 0;
    bool any_sealed = !repair_options_.seal.wanted() || repair_options_.seal.double_walls;
    for (const MeshOutcome& one : outcomes_) {
      const RepairReport& repair = one.findings.repair;
      any_sealed |= repair.seal.openings + repair.seal.leaks + repair.seal.cannot_cut > 0;
      const std::string lines = walls_summary(one.name, repair);
      meshes += lines.empty() ? 0 : 1;
      if (meshes <= kMostLines) text += lines;
    }
    if (meshes > kMostLines) text += fmt::format("{:<9} and {} more\n", "", meshes - kMostLines);
    return any_sealed ? text : text + "sealed    nothing: no opening leads into a space\n";
  }

  static std::string fate_of(const MeshOutcome& one) {
    if (one.left_as_it_is) return "encloses nothing, left as it is";  // why is in the report
    if (!one.trouble.empty()) return one.trouble;
    return one.findings.repair.same_triangles ? "a solid as it was" : "a solid now";
  }

  const AnySoup& input_;
  const Attributes& given_;
  std::vector<double> reach_;     // of all meshes
  RepairOptions repair_options_;  // without these
  const WriteOptions& format_;
  const StepOptions& options_;
  Run& run_;
  Findings& findings_;
  Scene scene_;
  std::size_t first_ = 0;  // triangle of the mesh in hand
  Surface all_;
  Attributes carried_;                 // by the mesh in hand
  std::vector<CornerOrigin> corners_;  // of all_, or empty
  std::vector<MeshOutcome> outcomes_;
};

}  // namespace

Surface as_given(const TriangleSoup& soup) {
  Surface surface{soup, {}, {}};
  surface.source.resize(soup.triangles.size());
  std::iota(surface.source.begin(), surface.source.end(), 0);
  surface.input_point.assign(soup.points.size(), 1);
  return surface;
}

void check_scene(const Scene& scene, SoupFormat format) {
  if (has_instances(format) || is_plain(scene)) return;
  throw UsageError("--scene each: " + std::string(format_name(format)) +
                   " cannot say where the meshes of the scene stand; GLB, glTF and 3MF can");
}

void repair_scene(const AnySoup& input, const Attributes& given,
                  const RepairOptions& repair_options, const WriteOptions& format,
                  const StepOptions& options, Run& run, Findings& findings) {
  check_scene(input.scene, *format.format);
  SceneRepair(input, given, repair_options, format, options, run, findings).run();
}

}  // namespace meshrepair
