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
      "How to decide what is solid:\n"
      "  auto      winding where the orientation can be trusted, else solidity\n"
      "  winding   what the triangles wind around; overlaps are solid, voids empty\n"
      "  solidity  what no way leads into from outside; overlaps and voids are solid\n"
      "  parity    what is inside an odd number of surfaces; overlaps and voids are empty\n")
      ->default_str(std::string(rule_name(inside.rule)))
      ->group("Repair");
  add_choice(
      app, "--cavities", kCavities, [&inside](Cavities value) { inside.cavities = value; },
      "Voids that no way leads into from outside:\n"
      "  keep  as the rule of --inside says\n"
      "  fill  solid, with all that is in them, whatever the rule\n")
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
         "Bring open edges together that nearly meet, before holes are closed:\n"
         "  auto  where corners are far nearer to strange edges than their own are long\n"
         "  none  not at all\n"
         "  a number: those that are no farther apart than this, in the units of IN, or with %\n"
         "            a share of its bounding box's diagonal, as 1%")
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
         "Bring bodies together that touch but for small gaps, or overlap by as little:\n"
         "  auto  where faces are far nearer to each other than anything is thin\n"
         "  none  not at all\n"
         "  a number: faces that are no farther apart than this, in the units of IN, or with %\n"
         "            a share of its bounding box's diagonal, as 0.01%; less than half of what\n"
         "            is thin")
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
         "Close openings that a ball of this diameter cannot pass, and fill what is behind:\n"
         "in the units of IN, or with % a share of its bounding box's diagonal, as 1%.\n"
         "  auto          narrow openings that lead into far wider spaces\n"
         "  double-walls  pinholes of bodies that are hollow by mistake, as generators make them")
      ->check(why_no_sealing)
      ->type_name("auto|double-walls|none|X|X%")
      ->default_str("none")
      ->group("Repair");
}

void add_holes_option(CommandLine& app, HoleOptions& holes) {
  add_choice(
      app, "--holes", kHoleModes, [&holes](HoleMode value) { holes.mode = value; },
      "How to close holes and gaps:\n"
      "  patch   by triangles over each hole, curved as the surface around it is;\n"
      "          what is left, as with extend\n"
      "  curved  the same, also where that makes the bounding box larger or the rim is a cut\n"
      "  flat    the same, without new points\n"
      "  extend  along planes that the mesh already has\n"
      "  none    not at all: a component with a hole encloses nothing\n")
      ->default_str(std::string(hole_mode_name(holes.mode)))
      ->group("Repair");
}

const CommandOption& add_max_hole_option(CommandLine& app, HoleOptions& holes) {
  return *app.add_option_function(
                 "--max-hole",
                 [&holes](const std::string& word) {
                   holes.largest_share = holes.largest_flat_share = *parse_number(word);
                 },
                 "Patch holes of at most this share of the area of the rest of their component")
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
             "Make walls of open sheets, which enclose nothing and are dropped else: so thick,\n"
             "in the units of IN, or with % a share of its bounding box's diagonal, as 1%.\n"
             "auto: a thickness that fits, where nothing encloses anything, or more than half\n"
             "of the area is of parts that do not.\n"
             "Only holes up to SHARE 0.25 are closed then, and no rims of tubes and folded "
             "sheets,\n"
             "unless --max-hole is given")
          ->check(why_no_size_or_word)
          ->type_name("auto|none|X|X%")
          ->default_str("none")
          ->group("Repair");
  add_choice(
      app, "--thicken-side", kThickenSides, [&thicken](ThickenSide side) { thicken.side = side; },
      "Where a sheet is in its wall:\n"
      "  middle   half of the wall is on either side of it\n"
      "  outside  the wall is where its triangles face\n"
      "  inside   the wall is behind them\n")
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
         "Which solids of the result stay, each with its voids:\n"
         "  all      all of them\n"
         "  outer    those that lie in no void of another one\n"
         "  largest  the one of most volume\n"
         "  a number: so many, those of most volume")
      ->check(why_not_kept)
      ->type_name("all|outer|largest|N")
      ->default_str("all")
      ->group("Repair");
  app.add_option("--min-part", keep.smallest_share,
                 "Remove solids of less than this share of the volume of the largest one")
      ->check(why_no_part_of_one)
      ->type_name("SHARE")
      ->capture_default_str()
      ->group("Repair");
}

void add_touching_option(CommandLine& app, Touching& touching) {
  add_choice(
      app, "--touching", kTouchings, [&touching](Touching value) { touching = value; },
      "Solids that touch along an edge:\n"
      "  separate  become separate components\n"
      "  join      become one component, connected there\n"
      "Solids that touch in a point are separate either way.")
      ->default_str("separate")
      ->group("Repair");
}

void add_simplify_option(CommandLine& app, double& simplify) {
  app.add_option("--simplify", simplify,
                 "Remove vertices that cutting made, moving the surface by at most this share\n"
                 "of the diagonal; triangles that were not cut stay as they are; 0: merge only\n"
                 "what lies in one plane. Left out where the result can only be certified\n"
                 "without it.")
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
      "glb, gltf, 3mf. If the name of OUT ends in .gz or .zst, it is packed as well")
      ->default_str("by the name of OUT")
      ->group("Output");
}

void add_sources_option(CommandLine& app, bool& sources) {
  app.add_flag("--sources", sources,
               "PLY only: give each face the property source_triangle, the number of the\n"
               "input triangle that it lies in, counted from 0; -1 where a gap was closed")
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
      "Round the coordinates of OUT to float64 or float32, and certify them so;\n"
      "binary STL and glTF are always float32")
      ->default_str("float64")
      ->group("Output");
  app.add_flag("--strict", strict, "Write nothing if the result cannot be certified")
      ->group("Output");
}

void add_predicates_options(CommandLine& app, RepairOptions& repair, const CommandOption* always) {
  const CommandOption* predicates =
      add_choice(
          app, "--predicates", kPredicates,
          [&repair](Predicates value) { repair.predicates = value; },
          "How to tell on which side of a plane a point lies, while cells are cut:\n"
          "  exact  with integers that are long enough\n"
          "  float  with rounded distances and a tolerance, for comparison; the result is\n"
          "         certified, but not mended\n")
          ->default_str(std::string(predicates_name(repair.predicates)))
          ->group("Repair");
  const CommandOption* epsilon =
      app.add_option("--eps", repair.epsilon,
                     "With --predicates float: a point this near to a plane is on it, as a share\n"
                     "of the largest side of the bounding box")
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
