// SPDX-License-Identifier: MIT
#include "page/boolean_page.h"

#include <array>
#include <cstdint>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include <base/stage_meter.h>

#include "options/show_requests.h"
#include "page/joined_check.h"
#include "program/program.h"
#include "report/findings.h"
#include "report/report_sections.h"

namespace meshrepair {
namespace {

// One after the other, then from the first again.
constexpr std::array<Colour, 10> kOperandColours = {{{86, 140, 220},
                                                     {236, 150, 60},
                                                     {84, 176, 110},
                                                     {206, 96, 160},
                                                     {220, 200, 70},
                                                     {120, 110, 200},
                                                     {70, 190, 200},
                                                     {190, 110, 80},
                                                     {150, 190, 70},
                                                     {160, 120, 170}}};
constexpr Colour kMadeNew = {150, 150, 150};

TriangleSoup soup_of(const TriangleSoup& all, const GivenOperand& operand, std::size_t first_point,
                     std::size_t first_triangle) {
  const auto at = [](const auto& list, std::size_t i) {
    return list.begin() + static_cast<std::ptrdiff_t>(i);
  };
  TriangleSoup soup;
  soup.points.assign(at(all.points, first_point), at(all.points, first_point + operand.points));
  soup.triangles.assign(at(all.triangles, first_triangle),
                        at(all.triangles, first_triangle + operand.triangles));
  for (auto& t : soup.triangles) {
    for (std::uint32_t& p : t) p -= static_cast<std::uint32_t>(first_point);
  }
  return soup;
}

// All operands as one; `list` gets what the page says of each.
SurfaceCheck check_operands(const BooleanPage& page, Run& run, Json& list) {
  SurfaceCheck all;
  for (const GivenOperand& operand : page.operands) {
    SurfaceCheck check =
        check_for_page(soup_of(page.given.soup, operand, all.points, all.triangles), run);
    Json volume = nullptr;
    if (check.closed()) volume = check.volume;
    list.push_back({{"name", operand.name},
                    {"triangles", operand.triangles},
                    {"volume", volume},
                    {"valid_solid", check.valid_solid()}});
    append_check(std::move(check), all);
  }
  return all;
}

std::vector<PageKind> kinds_of_operands(const BooleanPage& page) {
  std::vector<PageKind> kinds;
  for (std::size_t i = 0; i < page.operands.size(); ++i) {
    kinds.push_back({fmt::format("operand_{}", i + 1), page.operands[i].name,
                     kOperandColours[i % kOperandColours.size()]});
  }
  kinds.push_back({"made_new", "of no operand: closes a gap", kMadeNew});
  return kinds;
}

std::vector<std::uint32_t> kinds_of_given(const BooleanPage& page) {
  std::vector<std::uint32_t> kinds;
  kinds.reserve(page.given.soup.triangles.size());
  for (std::uint32_t i = 0; i < page.operands.size(); ++i) {
    kinds.insert(kinds.end(), page.operands[i].triangles, i);
  }
  return kinds;
}

std::vector<std::uint32_t> kinds_of_result(const BooleanPage& page) {
  std::vector<std::uint32_t> operand_of;  // of each triangle of all solids
  for (std::uint32_t i = 0; i < page.operands.size(); ++i) {
    operand_of.insert(operand_of.end(), page.operands[i].solid_triangles, i);
  }
  const auto made_new = static_cast<std::uint32_t>(page.operands.size());
  std::vector<std::uint32_t> kinds(page.result.mesh.triangles.size(), made_new);
  for (std::size_t t = 0; t < page.result.source.size(); ++t) {
    const std::uint32_t source = page.result.source[t];
    if (source < operand_of.size()) kinds[t] = operand_of[source];
  }
  return kinds;
}

Json sections_of_result(const Findings& findings, const Json& operands) {
  JsonReport report("", {});
  report.set_section("operands", operands);
  add_sections(findings, report);
  return report.take_sections();
}

}  // namespace

void write_boolean_page_stage(const HtmlRequest& request, const BooleanPage& page, Run& run,
                              Findings& findings) {
  if (!request.wanted()) return;
  StageMeter meter(findings.repair.stages, nullptr);  // the check tells of its own stages
  meter.begin("html");
  Json operands = Json::array();
  PageContent content{"boolean", page.up, page.unit};
  content.meshes.push_back({"input",
                            fmt::format("{} meshes", page.operands.size()),
                            page.given.soup,
                            check_operands(page, run, operands),
                            kinds_of_operands(page),
                            kinds_of_given(page),
                            {},
                            &page.given.attributes});
  content.meshes.push_back({"result",
                            page_name(findings.output, findings.output_name()),
                            page.result.mesh,
                            check_for_page(page.result.mesh, run),
                            kinds_of_operands(page),
                            kinds_of_result(page),
                            {},
                            &page.result_attributes});
  content.inputs = page.inputs;
  content.more = {{"operands", operands}};
  content.report = sections_of_result(findings, operands);
  write_page(request, std::move(content), run);
}

}  // namespace meshrepair
