// SPDX-License-Identifier: MIT
#include "options/repair_options.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include <base/error.h>

#include "options/choice_option.h"
#include "options/file_kinds.h"
#include "options/numbers.h"

namespace meshrepair {
namespace {

constexpr std::array<Choice<InsideRule>, 4> kRules = {{{"auto", InsideRule::automatic},
                                                       {"solidity", InsideRule::solidity},
                                                       {"parity", InsideRule::parity},
                                                       {"winding", InsideRule::winding}}};

constexpr std::array<Choice<HoleMode>, 5> kHoleModes = {{{"patch", HoleMode::patch},
                                                         {"curved", HoleMode::curved},
                                                         {"flat", HoleMode::flat},
                                                         {"extend", HoleMode::extend},
                                                         {"none", HoleMode::none}}};

constexpr std::array<Choice<Cavities>, 2> kCavities = {
    {{"keep", Cavities::keep}, {"fill", Cavities::fill}}};

constexpr std::array<Choice<SoupFormat>, 9> kFormats = {{{"stl", SoupFormat::stl_binary},
                                                         {"stl-ascii", SoupFormat::stl_ascii},
                                                         {"obj", SoupFormat::obj},
                                                         {"off", SoupFormat::off},
                                                         {"ply", SoupFormat::ply_binary},
                                                         {"ply-ascii", SoupFormat::ply_ascii},
                                                         {"glb", SoupFormat::glb},
                                                         {"gltf", SoupFormat::gltf},
                                                         {"3mf", SoupFormat::threemf}}};

constexpr std::array<Choice<Precision>, 2> kPrecisions = {
    {{"float64", Precision::float64}, {"float32", Precision::float32}}};

constexpr std::array<Choice<Predicates>, 2> kPredicates = {
    {{"exact", Predicates::exact}, {"float", Predicates::floating}}};

constexpr std::array<Choice<Touching>, 2> kTouchings = {
    {{"separate", Touching::separate}, {"join", Touching::join}}};

constexpr std::array<Choice<NegativeVolumes>, 3> kNegatives = {
    {{"subtract", NegativeVolumes::subtract},
     {"drop", NegativeVolumes::drop},
     {"keep", NegativeVolumes::keep}}};

constexpr std::array<Choice<SewMode>, 2> kSewModes = {
    {{"auto", SewMode::automatic}, {"none", SewMode::none}}};

constexpr std::array<Choice<JoinGapsMode>, 2> kJoinGapsModes = {
    {{"auto", JoinGapsMode::automatic}, {"none", JoinGapsMode::none}}};

constexpr std::array<Choice<ThickenSide>, 3> kThickenSides = {{{"middle", ThickenSide::middle},
                                                               {"outside", ThickenSide::outside},
                                                               {"inside", ThickenSide::inside}}};

// For check(): an empty text where the word is a number from 0 on.
std::string why_no_share(const std::string& word) {
  const std::optional<double> value = parse_number(word);
  return value && std::isfinite(*value) && *value >= 0
             ? std::string()
             : word + " is not a share: a number from 0 on";
}

// For check(): an empty text where the word is a number from 0 to 1.
std::string why_no_part_of_one(const std::string& word) {
  const std::optional<double> value = parse_number(word);
  return value && *value >= 0 && *value <= 1 ? std::string()
                                             : word + " is not a share: a number from 0 to 1";
}

// What --keep says; nothing where it is none of its words.
std::optional<KeepPartsOptions> kept_by(const std::string& word) {
  KeepPartsOptions keep;
  if (word == "all") return keep;
  keep.outer = word == "outer";
  if (word == "largest") keep.most = 1;
  if (keep.wanted()) return keep;
  keep.most = parse_count(word).value_or(0);
  return keep.most > 0 ? std::optional(keep) : std::nullopt;
}

// For check(): an empty text where the word is one.
std::string why_not_kept(const std::string& word) {
  return kept_by(word) ? std::string()
                       : word + " is none of all, outer, largest, and a number from 1 on";
}

// What --triangles says; nothing where it is neither a number nor a share.
std::optional<std::pair<std::size_t, double>> fewer_by(const std::string& word) {
  if (word.ends_with('%')) {
    const double share = parse_number(word.substr(0, word.size() - 1)).value_or(0) / 100;
    return share > 0 && share <= 1 ? std::optional(std::pair(std::size_t{0}, share)) : std::nullopt;
  }
  const std::size_t most = parse_count(word).value_or(0);
  return most >= 4 ? std::optional(std::pair(most, 0.0)) : std::nullopt;
}

// For check(): an empty text where the word is one.
std::string why_not_fewer(const std::string& word) {
  return fewer_by(word) ? std::string()
                        : word + " is neither a number from 4 on nor a share such as 10%";
}

// For check(): an empty text where the word is a way to sew, or to join gaps.
std::string why_no_sewing(const std::string& word) {
  const bool is_one = word == "auto" || word == "none" || distance_in(word);
  return is_one
             ? std::string()
             : word + " is none of auto, none, and a distance from 0 on, maybe with a % behind it";
}

// For check(): an empty text where the word is a length, auto or none.
std::string why_no_size_or_word(const std::string& word) {
  return word == "auto" || word == "none" ? std::string() : why_no_length(word);
}

// For check(): an empty text where the word is what --seal takes.
std::string why_no_sealing(const std::string& word) {
  return word == "double-walls" ? std::string() : why_no_size_or_word(word);
}

// For check(): an empty text where the word is a tolerance.
std::string why_no_epsilon(const std::string& word) {
  const std::optional<double> value = parse_number(word);
  return value && *value >= 0 && *value <= 1
             ? std::string()
             : word + " is not a share of the largest side: a number from 0 to 1";
}

}  // namespace

void add_inside_options(CommandLine& app, InsideOptions& inside) {
  add_choice(
      app, "--inside", kRules, [&inside](InsideRule value) { inside.rule = value; },
      "Rule that decides what is solid:\n"
      "  auto      winding if the orientation is reliable, else solidity\n"
      "  winding   points with a positive winding number; overlaps are solid, voids empty\n"
      "  solidity  what cannot be reached from outside; overlaps and voids are solid\n"
      "  parity    points inside an odd number of surfaces; overlaps and voids are empty\n")
      ->default_str(std::string(rule_name(inside.rule)))
      ->group("Repair");
  add_choice(
      app, "--cavities", kCavities, [&inside](Cavities value) { inside.cavities = value; },
      "How to treat closed voids:\n"
      "  keep  as the rule of --inside decides\n"
      "  fill  solid, with everything in them, under every rule\n")
      ->default_str("keep")
      ->group("Repair");
}

void add_sew_option(CommandLine& app, SewOptions& sew) {
  app.add_option_function(
         "--sew",
         [&sew](const std::string& word) {
           const auto known = std::find_if(kSewModes.begin(), kSewModes.end(),
                                           [&](const auto& mode) { return mode.first == word; });
           sew.mode = known == kSewModes.end() ? SewMode::distance : known->second;
           std::tie(sew.distance, sew.is_share) = distance_in(word).value_or(std::pair(0.0, false));
         },
         "Join open edges that nearly meet, before holes are filled:\n"
         "  auto  where corners are much closer to edges of others than their own are long\n"
         "  none  not at all\n"
         "  a number: edges at most this far apart, in units of IN, or as a percentage of the\n"
         "            bounding box diagonal, such as 1%")
      ->check(why_no_sewing)
      ->type_name("auto|none|X|X%")
      ->default_str("auto")
      ->group("Repair");
}

void add_join_gaps_option(CommandLine& app, JoinGapsOptions& gaps) {
  app.add_option_function(
         "--join-gaps",
         [&gaps](const std::string& word) {
           const auto known = std::find_if(kJoinGapsModes.begin(), kJoinGapsModes.end(),
                                           [&](const auto& mode) { return mode.first == word; });
           gaps.mode = known == kJoinGapsModes.end() ? JoinGapsMode::distance : known->second;
           std::tie(gaps.distance, gaps.is_share) =
               distance_in(word).value_or(std::pair(0.0, false));
         },
         "Join bodies that have small gaps between them, or overlap slightly:\n"
         "  auto  where gaps are much smaller than the thinnest wall\n"
         "  none  not at all\n"
         "  a number: faces at most this far apart, in units of IN, or as a percentage of the\n"
         "            bounding box diagonal, such as 0.01%; less than half the thinnest wall")
      ->check(why_no_sewing)
      ->type_name("auto|none|X|X%")
      ->default_str("none")
      ->group("Repair");
}

void add_seal_option(CommandLine& app, SealOptions& seal) {
  app.add_option_function(
         "--seal",
         [&seal](const std::string& word) {
           seal.automatic = word == "auto";
           seal.double_walls = word == "double-walls";
           std::tie(seal.size, seal.is_share) = length_in(word).value_or(std::pair(0.0, false));
         },
         "Close openings that a ball of this diameter cannot pass, and fill the space behind:\n"
         "in units of IN, or as a percentage of the bounding box diagonal, such as 1%.\n"
         "  auto          narrow openings of much wider spaces\n"
         "  double-walls  pinholes of double walls, which mesh generators make by mistake")
      ->check(why_no_sealing)
      ->type_name("auto|double-walls|none|X|X%")
      ->default_str("none")
      ->group("Repair");
}

void add_holes_option(CommandLine& app, HoleOptions& holes) {
  add_choice(
      app, "--holes", kHoleModes, [&holes](HoleMode value) { holes.mode = value; },
      "How to fill holes and gaps:\n"
      "  patch   a patch of triangles for each hole, curved like the surface around it;\n"
      "          extend for what remains open\n"
      "  curved  like patch, also where it enlarges the bounding box or the rim is a cut\n"
      "  flat    like patch, without new vertices\n"
      "  extend  extend the planes of existing triangles\n"
      "  none    leave them open: a component with a hole encloses nothing\n")
      ->default_str(std::string(hole_mode_name(holes.mode)))
      ->group("Repair");
}

const CommandOption& add_max_hole_option(CommandLine& app, HoleOptions& holes) {
  return *app.add_option_function(
                 "--max-hole",
                 [&holes](const std::string& word) {
                   holes.largest_share = holes.largest_flat_share = *parse_number(word);
                 },
                 "Largest hole to patch, as a share of the area of the rest of its component")
              ->check(why_no_share)
              ->type_name("SHARE")
              ->default_str(fmt::format("{}, or {} in a plane", holes.largest_share,
                                        holes.largest_flat_share))
              ->group("Repair");
}

void add_thicken_options(CommandLine& app, const CommandOption& max_hole, ThickenOptions& thicken) {
  CommandOption* walls =
      app.add_option_function(
             "--thicken",
             [&thicken, &max_hole](const std::string& word) {
               thicken.automatic = word == "auto";
               std::tie(thicken.thickness, thicken.is_share) =
                   length_in(word).value_or(std::pair(0.0, false));
               if (max_hole.count() > 0) {
                 thicken.largest_hole_share = std::numeric_limits<double>::infinity();
               }
             },
             "Give open sheets, which are dropped otherwise, this thickness, in units of IN, or\n"
             "as a percentage of the bounding box diagonal, such as 1%.\n"
             "auto: choose a thickness, if nothing encloses a volume or open sheets make up more\n"
             "than half of the area.\n"
             "Unless --max-hole is given, only holes up to SHARE 0.25 are then filled, and no\n"
             "rims of tubes and folded sheets")
          ->check(why_no_size_or_word)
          ->type_name("auto|none|X|X%")
          ->default_str("none")
          ->group("Repair");
  add_choice(
      app, "--thicken-side", kThickenSides, [&thicken](ThickenSide side) { thicken.side = side; },
      "Position of a sheet in its wall:\n"
      "  middle   in the middle\n"
      "  outside  the wall lies in front of its triangles\n"
      "  inside   the wall lies behind its triangles\n")
      ->needs(walls)
      ->default_str("middle")
      ->group("Repair");
}

void add_keep_options(CommandLine& app, KeepPartsOptions& keep) {
  app.add_option_function(
         "--keep",
         [&keep](const std::string& word) {
           const KeepPartsOptions asked = *kept_by(word);
           keep.outer = asked.outer;
           keep.most = asked.most;
         },
         "Which solids of the result to keep, with their voids:\n"
         "  all      all of them\n"
         "  outer    those that are not in a void of another\n"
         "  largest  the one with the largest volume\n"
         "  a number: this many, by volume")
      ->check(why_not_kept)
      ->type_name("all|outer|largest|N")
      ->default_str("all")
      ->group("Repair");
  app.add_option("--min-part", keep.smallest_share,
                 "Remove solids with less than this share of the largest solid's volume")
      ->check(why_no_part_of_one)
      ->type_name("SHARE")
      ->capture_default_str()
      ->group("Repair");
}

void add_triangles_option(CommandLine& app, FewerTrianglesOptions& fewer) {
  app.add_option_function(
         "--triangles",
         [&fewer](const std::string& word) { std::tie(fewer.most, fewer.share) = *fewer_by(word); },
         "Reduce the result to this many triangles, or to this share of them, such as 10%.\n"
         "No collapse makes triangles intersect, opens the surface or changes its genus;\n"
         "more triangles stay where that takes them")
      ->check(why_not_fewer)
      ->type_name("N|N%")
      ->group("Repair");
}

void add_max_error_option(CommandLine& app, FewerTrianglesOptions& fewer) {
  app.add_option_function(
         "--max-error",
         [&fewer](const std::string& word) {
           std::tie(fewer.distance, fewer.distance_is_share) = *length_in(word);
         },
         "Reduce the result until it would be farther than this from the repaired mesh, in\n"
         "either direction: in units of IN, or as a percentage of the bounding box diagonal,\n"
         "such as 0.1%. The distance is proven, not sampled. With --triangles, whichever\n"
         "comes first")
      ->check(why_no_length)
      ->type_name("X|X%")
      ->group("Repair");
}

void add_touching_option(CommandLine& app, Touching& touching) {
  add_choice(
      app, "--touching", kTouchings, [&touching](Touching value) { touching = value; },
      "Solids that touch along an edge:\n"
      "  separate  become separate components\n"
      "  join      become one component, connected there\n"
      "Solids that touch at a point always become separate.")
      ->default_str("separate")
      ->group("Repair");
}

void add_negative_option(CommandLine& app, NegativeVolumes& negative) {
  add_choice(
      app, "--negative", kNegatives, [&negative](NegativeVolumes value) { negative = value; },
      "Negative volumes of a slicer's project (3MF), when all its volumes are joined:\n"
      "  subtract  take them off the other volumes of their object\n"
      "  drop      leave them out\n"
      "  keep      join them with the others")
      ->default_str("subtract")
      ->group("Repair");
}

void add_simplify_option(CommandLine& app, double& simplify) {
  app.add_option("--simplify", simplify,
                 "Remove vertices that cutting has added, moving the surface by at most this\n"
                 "share of the diagonal; uncut triangles do not change; 0: merge only coplanar\n"
                 "triangles. Skipped if the result can be certified only without it.")
      ->check(why_no_share)
      ->type_name("SHARE")
      ->capture_default_str()
      ->group("Repair");
}

void add_output_option(CommandLine& app, std::string& output, const std::string& type,
                       std::string_view extensions, const std::string& description) {
  app.add_option("-o,--output", output, description)
      ->check(names_file(extensions))
      ->required()
      ->type_name(type)
      ->group("Output");
}

void add_format_option(CommandLine& app, std::optional<SoupFormat>& format) {
  add_choice(
      app, "--format", kFormats, [&format](SoupFormat value) { format = value; },
      "Format of OUT: stl (binary), stl-ascii, obj, off, ply (binary), ply-ascii,\n"
      "glb, gltf, 3mf. A name of OUT that ends in .gz or .zst\n"
      "compresses the file")
      ->default_str("from the name of OUT")
      ->group("Output");
}

void add_sources_option(CommandLine& app, bool& sources) {
  app.add_flag("--sources", sources,
               "PLY only: add the face property source_triangle: the index, from 0, of the input\n"
               "triangle that the face lies in, or -1 for patches")
      ->group("Output");
}

void add_staging_option(CommandLine& app, std::string& folder) {
  app.add_option(
         "--staging", folder,
         "Write OUT and the files beside it into this folder, from where they can be moved\n"
         "to their place: names of pictures are right there")
      ->type_name("FOLDER")
      ->group("");
}

void add_certify_options(CommandLine& app, CertifyOptions& certify, bool& strict) {
  add_choice(
      app, "--precision", kPrecisions, [&certify](Precision value) { certify.precision = value; },
      "Round the coordinates of OUT to float64 or float32 before certification;\n"
      "binary STL and glTF always have float32")
      ->default_str("float64")
      ->group("Output");
  app.add_flag("--strict", strict, "Do not write OUT if the result cannot be certified")
      ->group("Output");
}

void add_predicates_options(CommandLine& app, RepairOptions& repair, const CommandOption* always) {
  const CommandOption* predicates =
      add_choice(
          app, "--predicates", kPredicates,
          [&repair](Predicates value) { repair.predicates = value; },
          "Arithmetic of the side tests when cells are cut:\n"
          "  exact  integers of sufficient length\n"
          "  float  rounded distances with a tolerance, for comparison; the result is\n"
          "         checked, but not repaired further\n")
          ->default_str(std::string(predicates_name(repair.predicates)))
          ->group("Repair");
  const CommandOption* epsilon =
      app.add_option("--eps", repair.epsilon,
                     "Tolerance of --predicates float, as a share of the longest side of the\n"
                     "bounding box")
          ->check(why_no_epsilon)
          ->type_name("SHARE")
          ->capture_default_str()
          ->group("Repair");
  app.parse_complete_callback([&repair, predicates, epsilon, always] {
    if (predicates->count() > 0 && always != nullptr && always->count() == 0) {
      throw UsageError("--predicates: needs --always");
    }
    if (epsilon->count() > 0 && repair.predicates == Predicates::exact) {
      throw UsageError("--eps: needs --predicates float");
    }
    if (repair.seal.wanted() && repair.predicates == Predicates::floating) {
      throw UsageError("--seal: needs --predicates exact");
    }
  });
}

}  // namespace meshrepair
