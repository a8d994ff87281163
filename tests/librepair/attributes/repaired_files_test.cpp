// SPDX-License-Identifier: MIT
// Textured solids are read from a file, repaired, written and read back: what is on the surface is
// what the file had there.
#include <gtest/gtest.h>

#include <repair/repair.h>
#include <repair/transfer_attributes.h>

#include "attributes_in_files.h"
#include "shapes.h"
#include "share_of_cases.h"
#include "temporary_folder.h"

namespace meshrepair {
namespace {

using namespace testing;

TexturedSoup two_spheres(bool linear_colours) {
  TexturedSoup all = textured_solid(sphere(2000), "wood", linear_colours);
  const TriangleSoup second = sphere(1500, 0.8, {0.7, 0.3, 0.1});
  append_attributes(all.attributes, all.soup.triangles.size(),
                    textured_solid(second, "steel", linear_colours).attributes,
                    second.triangles.size());
  append(all.soup, second);
  return all;
}

TexturedSurface repaired_for(SoupFormat format, const TexturedSoup& input) {
  RepairOptions options;
  options.certify.precision = is_single(format) ? Precision::float32 : Precision::float64;
  options.certify.welded = welds_points(format);
  keep_attributes(input.soup, input.attributes, options);
  RepairReport report;
  TexturedSurface result;
  result.surface = repair(input.soup, options, report);
  EXPECT_TRUE(report.certify.passed());
  result.attributes = transfer_attributes(input.soup, input.attributes, result.surface);
  return result;
}

class RepairedFiles : public ::testing::TestWithParam<FileFormat> {};

TEST_P(RepairedFiles, HaveWhatTheInputHasAtRandomPoints) {
  const FileFormat& file = GetParam();
  const TemporaryFolder folder;
  const TexturedSoup made = two_spheres(file.one_colour_at_a_point);
  const TexturedSoup input = through_file(folder.path() / ("in" + file.extension), made.soup,
                                          made.attributes, file.format);
  const TexturedSurface result = repaired_for(file.format, input);
  TexturedSoup output = through_file(folder.path() / ("out" + file.extension), result.surface.mesh,
                                     result.attributes, file.format);
  expect_whole_triangles_by_place(input, output);
  TexturedSurface read_back;
  read_back.surface.mesh = std::move(output.soup);
  read_back.attributes = std::move(output.attributes);
  expect_same_on_surface(input, read_back, share_of_cases(10000), file.bounds());
}

INSTANTIATE_TEST_SUITE_P(Formats, RepairedFiles, ::testing::ValuesIn(formats_of_files()),
                         name_of_case);

}  // namespace
}  // namespace meshrepair
