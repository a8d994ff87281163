// SPDX-License-Identifier: MIT
// What the command line of a program that repairs says; not every program has all of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <mesh/soup_format.h>
#include <repair/repair_options.h>

#include "options/asset_options.h"
#include "options/purposes.h"
#include "options/show_requests.h"
#include "steps/origin_steps.h"
#include "steps/requirements.h"

namespace meshrepair {

struct StepOptions {
  std::string input;
  std::string output;
  std::optional<SoupFormat> format;
  bool sources = false;  // write of each triangle which one of the input it lies in
  AssetOptions assets;
  bool strict = false;
  std::vector<Requirement> required;
  OriginOptions origin;
  std::string staging;  // folder that OUT is written into first; empty: none
  PictureRequest picture;
  HtmlRequest html;
  std::string explained;  // file that is to say what became of the triangles; empty: none
  Purpose purpose;
  RepairOptions repair;
};

}  // namespace meshrepair
