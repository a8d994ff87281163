// What a program did, in a few lines for people.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "common/repair_steps.h"

namespace meshrepair {

// 1234567 as "1,234,567", whatever the locale.
[[nodiscard]] std::string grouped(std::uint64_t number);

// "1 triangle", "1,200 triangles".
[[nodiscard]] std::string number_of(std::uint64_t count, std::string_view noun);

// With the plural of a noun that has another one than with an s.
[[nodiscard]] std::string number_of(std::uint64_t count, std::string_view noun,
                                    std::string_view plural);

// "the input's units" where the unit is not known.
[[nodiscard]] std::string units_text(std::optional<LengthUnit> unit);

// "OBJ", "OBJ in gzip", "OBJ in ZIP, part.obj": what was read.
[[nodiscard]] std::string format_words(std::string_view format, const PackedFile& packed);

// A dozen aligned lines or so: what was read, what was wrong with it, how it was decided what is
// solid, and what came out, each as far as it is known. `seconds` is the time that it all took.
[[nodiscard]] std::string summary_of(const Findings& findings, double seconds);

// Of these the lines that say what floating predicates did; nothing of exact ones.
[[nodiscard]] std::string predicates_summary(const RepairReport& repair);

// Of these the line that says which gaps were joined; nothing where none were.
[[nodiscard]] std::string gaps_summary(const RepairReport& repair);

// Of these the lines that say what --for has set; nothing without it.
[[nodiscard]] std::string purpose_summary(const Purpose& purpose);

// Of these, each text with the mesh's name before it, those of openings that were sealed and of
// sheets that were thickened; nothing where there are none.
[[nodiscard]] std::string walls_summary(const std::string& mesh, const RepairReport& repair);

// Clears the progress bar and prints the summary to stderr, unless the run is to be quiet.
void print_summary(Run& run, const Findings& findings);

}  // namespace meshrepair
