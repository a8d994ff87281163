// The options that several programs have, beyond those that every program has.
#pragma once

#include <optional>
#include <string>

#include <CLI/App.hpp>

#include <bsp/soup_io.h>
#include <repair/certify.h>
#include <repair/inside_rule.h>

namespace meshrepair {

// --inside and --cavities: which parts of space are solid.
void add_inside_options(CLI::App& app, InsideOptions& inside);

// -o: the file to write, where it does not stand beside IN.
void add_output_option(CLI::App& app, std::string& output, const std::string& type,
                       const std::string& description);

// --format: the format of the mesh that is written, whatever its name.
void add_format_option(CLI::App& app, std::optional<SoupFormat>& format);

// --precision and --strict: what is to be certified, and what happens when it cannot be.
void add_certify_options(CLI::App& app, CertifyOptions& certify, bool& strict);

// --check-cells: the debugging aid RepairOptions::check_cells.
void add_check_cells_option(CLI::App& app, bool& check_cells);

}  // namespace meshrepair
