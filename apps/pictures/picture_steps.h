// SPDX-License-Identifier: MIT
// --picture: a mesh, or what it was and what was made of it, as a picture.
#pragma once

#include <string>
#include <vector>

#include <mesh/attributes.h>
#include <mesh/coloured_ply.h>
#include <mesh/soup.h>
#include <picture/pixels.h>
#include <picture/view.h>

#include "options/command_line.h"
#include "options/show_requests.h"
#include "program/program.h"
#include "report/findings.h"

namespace meshrepair {

// --picture, --picture-size and --picture-view. `what` is drawn: "IN and OUT, side by side".
void add_picture_options(CommandLine& app, PictureRequest& request, const std::string& what);
// --picture-colours, for programs that know of each triangle what is wrong, or became of it: the
// name and the meaning of these colours.
void add_colours_option(CommandLine& app, PictureRequest& request, const std::string& name,
                        const std::string& meaning);

// --show and --show-as. `otherwise`: for the help, what is shown by terminals without pictures.
void add_show_options(CommandLine& app, PictureRequest& request, const std::string& what,
                      const std::string& otherwise = {});

// Before hours of work, as check_files(): throws UsageError where the picture is another file of
// the run, OutputError where it cannot be written.
void check_picture(const PictureRequest& request, const std::vector<std::string>& files, Run& run);

// Once the input is read: throws UsageError where the picture is one of its textures.
void check_picture(const PictureRequest& request, const Attributes& attributes);

// The axis that is up in what was read: y in glTF, which says so, else z.
[[nodiscard]] View::Up up_of(const Findings& findings);

struct Drawn {
  const TriangleSoup& soup;
  const Attributes& attributes;  // of it, or empty
};

// So that each triangle of a soup is drawn in its colour.
[[nodiscard]] Attributes painted(const std::vector<Colour>& of_triangle);

// Stage "picture", where one is asked for: writes it, and keeps in the findings what the terminal
// is to show. Textures are looked for in the folders of the inputs.
void draw_picture_stage(const PictureRequest& request, View::Up up,
                        const std::vector<std::string>& inputs, const std::vector<Drawn>& meshes,
                        Run& run, Findings& findings);

}  // namespace meshrepair
