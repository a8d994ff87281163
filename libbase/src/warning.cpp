// SPDX-License-Identifier: MIT
#include <array>
#include <cstddef>

#include <base/warning.h>

namespace meshrepair {
namespace {

constexpr auto kWarningKinds = std::to_array<WarningKind>({
    {"W-FILE-CUT-OFF", true, "The file holds fewer faces or points than it promises"},
    {"W-FACES-UNREADABLE", true, "Faces are left out: they are cut off, or name no points"},
    {"W-POINTS-UNREADABLE", true, "Points are left out: their coordinates are not numbers"},
    {"W-REFERENCES-MISSING", true, "The file refers to objects or parts that it does not hold"},
    {"W-EXTENSION-UNKNOWN", true, "The file needs an extension of its format that is unknown"},
    {"W-UNIT-UNKNOWN", true, "The unit of the file is unknown, and another one is assumed"},
    {"W-START-UNCLEAR", true, "The package does not say clearly which of its models is the first"},
    {"W-OBJECTS-LEFT-OUT", true, "Objects of the file are not part of the model and left out"},
    {"W-NOT-SUBTRACTED", true, "A negative volume is not subtracted from its object"},
    {"W-NONE-PRINTED", true, "No object is to be printed, and all are taken for the model"},
    {"W-PROJECT-UNREADABLE", true, "What a slicer says of objects and volumes cannot be read"},
    {"W-FLOAT32-STEP", true, "The coordinates are too large for the single precision of OUT"},
    {"W-AREA-LOST", true, "Much of the surface encloses nothing and is not in the result"},
    {"W-AREA-MADE-UP", true, "Much of the result's surface is patches"},
    {"W-DETAIL-LOST", true, "Triangles smaller than the gaps that were sewn are lost"},
    {"W-BELOW-GRID", true, "Triangles smaller than the step of the working grid are dropped"},
    {"W-THIN-PARTS-LOST", true, "Parts too thin for the numbers of OUT are left out"},
    {"W-SLITS-FILLED", true, "Slits too narrow for the numbers of OUT are filled"},
    {"W-HOLLOW-FILLED", true, "The hollow of double walls, or of negative volumes, is filled"},
    {"W-WALL-POKES-OUT", true, "The wall of a cavity pokes out of the solid around it"},
    {"W-NOT-HOLLOWED", true,
     "Cavities, walls or drains are not as `--hollow` asked for, or distances as `--offset` did"},
    {"W-POINTS-NOISY", true, "The points are noisy, and the triangles of few of them agree"},
    {"W-POINTS-UNUSED", true, "Many points are not on the result"},
    {"W-OPERAND-REPAIRED", true, "An operand is not the boundary of a solid and repaired first"},
    {"W-OPERAND-UNCERTIFIED", true, "An operand could not be certified as a solid"},
    {"W-BODY-GONE", true, "A body lies in other bodies, which have all of it"},
    {"W-BYTES-IGNORED", false, "Bytes after the end of the content are ignored"},
    {"W-CONTENT-IGNORED", false, "Lines, points, curves, or elements that are unknown are ignored"},
    {"W-ATTRIBUTES-UNREADABLE", false, "Some normals, texture coordinates, colours are not read"},
    {"W-MATERIALS-UNDEFINED", false, "Materials, or libraries of materials, are not found"},
    {"W-ATTRIBUTES-LOST", false, "OUT cannot store some of the attributes"},
    {"W-PACKAGE-PARTS-LOST", false, "Parts of the package are not written again"},
    {"W-PICTURE-UNREADABLE", false, "A picture cannot be read and is not drawn"},
    {"W-PARTS-ALL-KEPT", false, "No part is removed, as the surface is not closed"},
    {"W-ONE-BLOCK", false, "The input is a single block, and several machines do not help"},
    {"W-STATES-NOT-SAVED", false, "Saved states are ignored, or none are saved"},
    {"W-TRIANGLES-LEFT", false,
     "More triangles stay than `--triangles` or `--max-error` asked for"},
    {"W-THIN", false, "The result is thinner than `--thickness` in places"},
    {"W-REPORT-NOT-WRITTEN", false, "The report cannot be written"},
});
static_assert(kWarningKinds.size() ==
              static_cast<std::size_t>(WarningCode::report_not_written) + 1);

}  // namespace

const WarningKind& kind_of(WarningCode code) {
  return kWarningKinds[static_cast<std::size_t>(code)];
}

std::span<const WarningKind> warning_kinds() { return kWarningKinds; }

}  // namespace meshrepair
