// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <base/error.h>
#include <base/parallel.h>
#include <base/shared_progress.h>
#include <mesh/placed_pictures.h>
#include <picture/draw_mesh.h>

#include "raster/visible_triangles.h"
#include "shade/shader.h"

namespace meshrepair {
namespace {

constexpr unsigned kMostSamples = 8;

std::uint8_t byte_of(double share) {
  return static_cast<std::uint8_t>(std::floor(std::clamp(share, 0.0, 1.0) * 255 + 0.5));
}

// The mean of samples, those without a triangle being background.
class PixelSum {
 public:
  void add(const Light& light) {
    for (std::size_t k = 0; k < 3; ++k) sum_[k] += light[k];
    ++covered_;
  }

  [[nodiscard]] Rgba mean(unsigned samples, const Rgba& background) const {
    if (covered_ == 0) return background;
    const double rest = (samples - covered_) * (background[3] / 255.0);  // samples of background
    const Light behind = light_of(background);
    const double opaque = covered_ + rest;
    Rgba pixel;
    for (std::size_t k = 0; k < 3; ++k) {
      pixel[k] = byte_of(std::sqrt((sum_[k] + rest * behind[k]) / opaque));
    }
    pixel[3] = byte_of(opaque / samples);
    return pixel;
  }

 private:
  Light sum_ = {0, 0, 0};
  unsigned covered_ = 0;
};

class Drawing {
 public:
  Drawing(const VisibleTriangles& visible, const Shader& shader, const DrawOptions& options,
          Pixels& pixels)
      : visible_(visible), shader_(shader), options_(options), pixels_(pixels) {}

  void draw_band(std::size_t band, SharedProgress& progress) const {
    std::vector<VisibleTriangles::Sample> samples;
    visible_.look(band, progress, samples);
    const auto first = static_cast<std::size_t>(visible_.rows(band).first);
    const std::size_t per_row = visible_.columns() * options_.samples;
    ShadedFace face(visible_, shader_);
    for (std::size_t row = 0; row * per_row < samples.size(); ++row) {
      const std::size_t y = first / options_.samples + row;
      for (std::size_t x = 0; x < pixels_.size.width; ++x) {
        pixels_.values[y * pixels_.size.width + x] = pixel(x, row, first, samples, face);
      }
    }
  }

 private:
  // The triangle of the last sample: that of the next is mostly the same.
  class ShadedFace {
   public:
    ShadedFace(const VisibleTriangles& visible, const Shader& shader)
        : visible_(visible), shader_(shader) {}

    Light light(VisibleTriangles::Seen seen, std::size_t column, std::size_t row) {
      if (!triangle_ || seen.triangle != number_) {
        number_ = seen.triangle;
        triangle_ = visible_.snapped_triangle(number_);
        face_ = shader_.face(number_, seen.from_behind);
      }
      if (face_.is_even) return face_.light;
      return shader_.light(face_, triangle_->shares(static_cast<std::int64_t>(column),
                                                    static_cast<std::int64_t>(row)));
    }

   private:
    const VisibleTriangles& visible_;
    const Shader& shader_;
    std::uint32_t number_ = 0;
    std::optional<SnappedTriangle> triangle_;
    Shader::Face face_;
  };

  Rgba pixel(std::size_t x, std::size_t row, std::size_t first_row,
             const std::vector<VisibleTriangles::Sample>& samples, ShadedFace& face) const {
    PixelSum sum;
    for (std::size_t j = 0; j < options_.samples; ++j) {
      const std::size_t line = row * options_.samples + j;
      for (std::size_t i = 0; i < options_.samples; ++i) {
        const std::size_t column = x * options_.samples + i;
        const VisibleTriangles::Sample sample = samples[line * visible_.columns() + column];
        if (sample == VisibleTriangles::kNothing) continue;
        sum.add(face.light(VisibleTriangles::seen(sample), column, first_row + line));
      }
    }
    return sum.mean(options_.samples * options_.samples, options_.background);
  }

  const VisibleTriangles& visible_;
  const Shader& shader_;
  const DrawOptions& options_;
  Pixels& pixels_;
};

}  // namespace

Pixels draw_mesh(const TriangleSoup& soup, const Attributes& attributes, const Camera& camera,
                 Textures& textures, const DrawOptions& options) {
  if (options.samples == 0 || options.samples > kMostSamples) {
    throw UsageError("a pixel has 1 to " + std::to_string(kMostSamples) + " samples on a side");
  }
  const VisibleTriangles visible(soup, camera, options.samples);
  const std::optional<Attributes> placed = with_placed_pictures(attributes);
  const Attributes& drawn = placed ? *placed : attributes;
  const Shader shader(soup, drawn, textures.of(drawn), camera,
                      {options.samples, options.both_sides});
  Pixels pixels = filled(camera.size(), options.background);
  const Drawing drawing(visible, shader, options, pixels);
  SharedProgress progress(options.progress, visible.bands());
  parallel_for(visible.bands(), [&](std::size_t band) {
    drawing.draw_band(band, progress);
    progress.done();
  });
  return pixels;
}

}  // namespace meshrepair
