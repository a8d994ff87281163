#include "common/picture_steps.h"

#include <charconv>
#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include <base/atomic_file.h>
#include <base/error.h>
#include <picture/draw_mesh.h>
#include <picture/png_io.h>

#include "common/file_kinds.h"
#include "common/side_file.h"

namespace meshrepair {
namespace {

constexpr std::uint32_t kBarWidth = 2;  // pixels
constexpr Rgba kBarColour = {150, 150, 150, 255};

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

// For CLI11: an empty text where the word is a size.
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
                 Run& run) {
  DrawOptions options;
  options.progress = &run.progress;
  std::optional<Pixels> all;
  for (const Drawn& mesh : meshes) {
    Pixels one = draw_mesh(mesh.soup, mesh.attributes, camera, textures, options);
    all = all ? beside(*all, one, kBarWidth, kBarColour) : std::move(one);
  }
  return std::move(*all);
}

}  // namespace

void add_picture_options(CLI::App& app, PictureRequest& request, const std::string& what) {
  app.add_option("--picture", request.path, "Draw " + what + ", as PNG")
      ->check(names_file(".png"))
      ->type_name("FILE")
      ->group("Picture");
  app.add_option_function<std::string>(
         "--picture-size",
         [&request](const std::string& word) { request.size = *picture_size_of(word); },
         "WIDTHxHEIGHT in pixels, of one mesh")
      ->check(why_no_size)
      ->type_name("SIZE")
      ->default_str(fmt::format("{}x{}", request.size.width, request.size.height))
      ->group("Picture");
  app.add_option_function<std::string>(
         "--picture-view", [&request](const std::string& word) { request.view = *view_of(word); },
         "From where: front, back, left, right, top, bottom, iso, or AZIMUTH,ELEVATION\n"
         "in degrees; 0,0 is the front, 90,0 the right")
      ->check(why_no_view)
      ->type_name("VIEW")
      ->default_str("iso")
      ->group("Picture");
}

void check_picture(const PictureRequest& request, const std::vector<std::string>& files, Run& run) {
  if (!request.wanted()) return;
  const std::string& path = request.path;
  if (lower_extension(path) != ".png")
    throw UsageError("--picture: " + path + " does not end in .png");
  check_side_file({"--picture", path, "picture"}, files, run);
}

void check_picture(const PictureRequest& request, const Attributes& attributes) {
  if (!request.wanted()) return;
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

void draw_picture_stage(const PictureRequest& request, View::Up up,
                        const std::vector<std::string>& inputs, const std::vector<Drawn>& meshes,
                        Run& run, Findings& findings) {
  if (!request.wanted()) return;
  StageMeter meter(findings.repair.stages, &run.progress);
  meter.begin("picture");
  Textures textures(folders_of(inputs));
  View view = request.view;
  view.up = up;
  const Camera camera(view, request.size, {&meshes.front().soup, &meshes.back().soup});
  const Pixels pixels = pixels_of(meshes, camera, textures, run);
  log_warnings(findings.input_name(), textures.warnings());
  write_file_atomically(request.path, format_png(pixels), &run.progress);
  run.report.set_section("picture", {{"path", request.path},
                                     {"width", pixels.size.width},
                                     {"height", pixels.size.height},
                                     {"warnings", textures.warnings()}});
}

}  // namespace meshrepair
