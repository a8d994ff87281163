// SPDX-License-Identifier: MIT
#include "pictures/picture_steps.h"

#include <array>
#include <charconv>
#include <filesystem>
#include <map>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include <base/atomic_file.h>
#include <base/error.h>
#include <picture/draw_mesh.h>
#include <picture/png_io.h>
#include <picture/terminal_text.h>

#include "options/choice_option.h"
#include "options/file_kinds.h"
#include "options/show_requests.h"
#include "program/command_files.h"
#include "program/program.h"
#include "report/findings.h"
#include "report/report_sections.h"
#include "terminal/terminal_pictures.h"
#include "terminal/warning_log.h"

namespace meshrepair {
namespace {

constexpr std::uint32_t kBarWidth = 2;  // pixels
constexpr Rgba kBarColour = {150, 150, 150, 255};
constexpr PictureSize kShownSize = {240, 180};  // in a terminal, of each mesh

constexpr std::array<Choice<Shown>, 3> kShownAs = {
    {{"sixel", Shown::sixel}, {"kitty", Shown::kitty}, {"none", Shown::bar}}};

std::optional<std::uint32_t> side_of(std::string_view text) {
  std::uint32_t side = 0;
  const char* const end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data(), end, side);
  if (error != std::errc() || at != end || side == 0 || side > kMostPictureSide) {
    return std::nullopt;
  }
  return side;
}

// "640x480".
std::optional<PictureSize> picture_size_of(std::string_view text) {
  const std::size_t cross = text.find('x');
  if (cross == std::string_view::npos) return std::nullopt;
  const auto width = side_of(text.substr(0, cross));
  const auto height = side_of(text.substr(cross + 1));
  if (!width || !height) return std::nullopt;
  return PictureSize{*width, *height};
}

// For check(): an empty text where the word is a size.
std::string why_no_size(const std::string& word) {
  if (picture_size_of(word)) return {};
  return fmt::format("'{}' is no size: WIDTHxHEIGHT, of 1 to {} pixels", word, kMostPictureSide);
}

std::string why_no_view(const std::string& word) {
  if (view_of(word)) return {};
  return "'" + word +
         "' is no view: front, back, left, right, top, bottom, iso, or AZIMUTH,ELEVATION";
}

std::vector<std::filesystem::path> folders_of(const std::vector<std::string>& files) {
  std::vector<std::filesystem::path> folders;
  for (const std::string& file : files) {
    if (file != "-") folders.push_back(std::filesystem::path(file).parent_path());
  }
  return folders;
}

Pixels pixels_of(const std::vector<Drawn>& meshes, const Camera& camera, Textures& textures,
                 bool both_sides, Run& run) {
  DrawOptions options;
  options.both_sides = both_sides;
  options.progress = &run.progress;
  std::optional<Pixels> all;
  for (const Drawn& mesh : meshes) {
    Pixels one = draw_mesh(mesh.soup, mesh.attributes, camera, textures, options);
    all = all ? beside(*all, one, kBarWidth, kBarColour) : std::move(one);
  }
  return std::move(*all);
}

Shown shown_for(const PictureRequest& request, Run& run) {
  if (run.options.quiet) return Shown::nothing;
  if (request.shown != Shown::automatic) return request.shown;
  switch (ask_terminal_for_pictures(run.progress)) {
    case TerminalPictures::sixel:
      return Shown::sixel;
    case TerminalPictures::kitty:
      return Shown::kitty;
    case TerminalPictures::none:
      break;
  }
  return Shown::bar;
}

void write_picture(const PictureRequest& request, const Pixels& pixels,
                   const std::vector<Warning>& warnings, Run& run) {
  write_file_atomically(request.path, format_png(pixels), &run.progress);
  run.report.set_section("picture", {{"path", request.path},
                                     {"width", pixels.size.width},
                                     {"height", pixels.size.height},
                                     {"warnings", texts_of(warnings)}});
}

}  // namespace

void add_picture_options(CommandLine& app, PictureRequest& request, const std::string& what) {
  app.add_option("--picture", request.path, "Draw " + what + ", as PNG")
      ->check(names_side_file(".png"))
      ->type_name("FILE")
      ->group("Picture");
  app.add_option_function(
         "--picture-size",
         [&request](const std::string& word) { request.size = *picture_size_of(word); },
         "Size of each mesh in pixels, WIDTHxHEIGHT")
      ->check(why_no_size)
      ->type_name("SIZE")
      ->default_str(fmt::format("{}x{}", request.size.width, request.size.height))
      ->group("Picture");
  app.add_option_function(
         "--picture-view", [&request](const std::string& word) { request.view = *view_of(word); },
         "Viewpoint: front, back, left, right, top, bottom, iso, or AZIMUTH,ELEVATION\n"
         "in degrees; 0,0 is the front, 90,0 the right")
      ->check(why_no_view)
      ->type_name("VIEW")
      ->default_str("iso")
      ->group("Picture");
}

void add_colours_option(CommandLine& app, PictureRequest& request, const std::string& name,
                        const std::string& meaning) {
  app.add_option_function(
         "--picture-colours",
         [&request, name](const std::string& word) { request.painted = word == name; },
         fmt::format("looks: the colours of the mesh; {}: {}", name, meaning))
      ->check(is_one_of(std::vector<std::string>{"looks", name}))
      ->type_name("NAME")
      ->default_str("looks")
      ->group("Picture");
}

void add_show_options(CommandLine& app, PictureRequest& request, const std::string& what,
                      const std::string& otherwise) {
  app.add_flag_callback(
         "--show",
         [&request] {
           if (request.shown == Shown::nothing) request.shown = Shown::automatic;
         },
         "Draw " + what + " in the terminal, if it supports\nkitty graphics or sixels" + otherwise)
      ->group("Picture");
  add_choice(
      app, "--show-as", kShownAs, [&request](Shown shown) { request.shown = shown; },
      "Like --show, but use this protocol without asking the terminal: sixel or kitty;\n"
      "none: act as if the terminal supported neither")
      ->group("Picture");
}

void check_picture(const PictureRequest& request, const std::vector<std::string>& files, Run& run) {
  if (request.path.empty()) return;
  const std::string& path = request.path;
  if (lower_extension(path) != ".png")
    throw UsageError("--picture: " + path + " does not end in .png");
  check_side_file({"--picture", path, "picture"}, files, run);
}

void check_picture(const PictureRequest& request, const Attributes& attributes) {
  if (request.path.empty()) return;
  for (const Image& image : attributes.images) {
    if (image.bytes || image.path.empty() || !is_same_file(request.path, image.path)) continue;
    throw UsageError("--picture: " + request.path + " is a texture of the input");
  }
}

View::Up up_of(const Findings& findings) {
  if (!findings.mesh_read) return View::Up::z;
  const SoupFormat format = findings.mesh_read->format;
  return format == SoupFormat::glb || format == SoupFormat::gltf ? View::Up::y : View::Up::z;
}

Attributes painted(const std::vector<Colour>& of_triangle) {
  CornerAttribute colours;
  colours.kind = CornerAttribute::Kind::colour;
  colours.place = CornerAttribute::Place::triangle;
  colours.components = 3;
  std::map<Colour, std::uint32_t> known;
  colours.of_corner.reserve(3 * of_triangle.size());
  for (const Colour& colour : of_triangle) {
    const auto [at, is_new] = known.try_emplace(colour, static_cast<std::uint32_t>(known.size()));
    if (is_new) {
      for (const std::uint8_t value : colour) colours.values.push_back(value / 255.0);
    }
    colours.of_corner.insert(colours.of_corner.end(), 3, at->second);
  }
  Attributes attributes;
  attributes.corners.push_back(std::move(colours));
  return attributes;
}

void draw_picture_stage(const PictureRequest& request, View::Up up,
                        const std::vector<std::string>& inputs, const std::vector<Drawn>& meshes,
                        Run& run, Findings& findings) {
  if (!request.wanted()) return;
  StageMeter meter(findings.repair.stages, &run.progress);
  meter.begin("picture");
  Textures textures(folders_of(inputs));
  View view = request.view;
  view.up = up;
  const auto drawn = [&](const PictureSize& size) {
    const Camera camera(view, size, {&meshes.front().soup, &meshes.back().soup});
    return pixels_of(meshes, camera, textures, request.painted, run);
  };
  const Shown shown = shown_for(request, run);
  if (shown == Shown::sixel) findings.shown = format_sixel(drawn(kShownSize)) + "\n";
  if (shown == Shown::kitty) findings.shown = format_kitty(drawn(kShownSize)) + "\n";
  findings.shows_bar = shown == Shown::bar;
  const std::optional<Pixels> picture =
      request.path.empty() ? std::nullopt : std::optional(drawn(request.size));
  warn(findings.input_name(), textures.warnings());
  if (picture) write_picture(request, *picture, textures.warnings(), run);
}

}  // namespace meshrepair
