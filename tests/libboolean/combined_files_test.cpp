// SPDX-License-Identifier: MIT
// Three textured solids of three materials are read from files of their own and combined: what is
// on the surface of the file that is written is what theirs had there.
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <boolean/boolean.h>
#include <repair/transfer_attributes.h>

#include "attributes_in_files.h"
#include "shapes.h"
#include "share_of_cases.h"
#include "temporary_folder.h"

namespace meshrepair {
namespace {

using namespace testing;

struct Operands {
  std::vector<TriangleSoup> solids;
  TexturedSoup joined;
};

Operands read_operands(const FileFormat& file, const std::filesystem::path& folder) {
  const std::vector<TriangleSoup> balls = {sphere(800), sphere(600, 0.8, {0.7, 0.3, 0.1}),
                                           sphere(500, 0.6, {-0.4, 0.5, -0.6})};
  Operands operands;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const std::string name = std::string(i + 1, 'm');
    const TexturedSoup made = textured_solid(balls[i], name, file.one_colour_at_a_point);
    TexturedSoup read =
        through_file(folder / (name + file.extension), made.soup, made.attributes, file.format);
    append_attributes(operands.joined.attributes, operands.joined.soup.triangles.size(),
                      std::move(read.attributes), read.soup.triangles.size());
    append(operands.joined.soup, read.soup);
    operands.solids.push_back(std::move(read.soup));
  }
  return operands;
}

TexturedSurface combined_for(SoupFormat format, const Operands& operands, SetOperation operation) {
  BooleanOptions options;
  options.repair.certify.precision = is_single(format) ? Precision::float32 : Precision::float64;
  options.repair.certify.welded = welds_points(format);
  keep_attributes(operands.joined.soup, operands.joined.attributes, options.repair);
  BooleanReport report;
  TexturedSurface result;
  result.surface = boolean(operands.solids, operation, options, report);
  EXPECT_TRUE(report.result.certify.passed());
  result.attributes =
      transfer_attributes(operands.joined.soup, operands.joined.attributes, result.surface);
  return result;
}

class CombinedFiles : public ::testing::TestWithParam<FileFormat> {};

TEST_P(CombinedFiles, HaveWhatTheirOperandsHaveAtRandomPoints) {
  const FileFormat& file = GetParam();
  const TemporaryFolder folder;
  const Operands operands = read_operands(file, folder.path());
  for (const SetOperation operation :
       {SetOperation::unite, SetOperation::subtract, SetOperation::exclude}) {
    const TexturedSurface result = combined_for(file.format, operands, operation);
    TexturedSoup output = through_file(folder.path() / ("out" + file.extension),
                                       result.surface.mesh, result.attributes, file.format);
    TexturedSurface read_back;
    read_back.surface.mesh = std::move(output.soup);
    read_back.attributes = std::move(output.attributes);
    expect_same_on_surface(operands.joined, read_back, share_of_cases(10000), file.bounds());
    if (HasFatalFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, CombinedFiles, ::testing::ValuesIn(formats_of_files()),
                         name_of_case);

}  // namespace
}  // namespace meshrepair
