// --picture: a mesh, or what it was and what was made of it, as a picture.
#pragma once

#include <string>
#include <vector>

#include <CLI/App.hpp>

#include <mesh/attributes.h>
#include <mesh/soup.h>
#include <picture/pixels.h>
#include <picture/view.h>

#include "common/picture_request.h"
#include "common/repair_steps.h"

namespace meshrepair {

// --picture, --picture-size and --picture-view. `what` is drawn: "IN and OUT, side by side".
void add_picture_options(CLI::App& app, PictureRequest& request, const std::string& what);

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

// Stage "picture", where one is asked for. Textures are looked for in the folders of the inputs.
void draw_picture_stage(const PictureRequest& request, View::Up up,
                        const std::vector<std::string>& inputs, const std::vector<Drawn>& meshes,
                        Run& run, Findings& findings);

}  // namespace meshrepair
