// SPDX-License-Identifier: MIT
// Packages that are broken, or made to do harm: each is read, or refused in one line, and costs no
// memory that its bytes do not account for.
#include <algorithm>
#include <chrono>
#include <functional>
#include <gmock/gmock.h>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <mesh/soup_io.h>

#include "formats/threemf/zip_writer.h"
#include "package_bytes.h"
#include "soup_fixtures.h"
#include "warning_texts.h"

namespace meshrepair {
namespace {

using ::testing::HasSubstr;

struct OddPackage {
  std::string name;                    // of the test
  std::function<std::string()> bytes;  // made when it is its turn: some are large
  std::string refusal;                 // a part of the message; empty: it is read
  std::string warning = {};            // a part of one, if it is read
  std::size_t triangles = 4;           // if it is read
};

std::string good_model() { return model_of(tetrahedron_object(1), item_of(1)); }

std::string model_with(const std::string& triangles) {
  return model_of(object_of(1, triangles), item_of(1));
}

std::string package_with(const std::string& triangles) { return package_of(model_with(triangles)); }

// A package with this part, deflated, and a good model if it is another.
std::string packed(const std::string& name, const std::string& bytes) {
  ZipWriter writer;
  writer.add_text("_rels/.rels", kRelationships);
  if (name != "3D/3dmodel.model") writer.add_text("3D/3dmodel.model", good_model());
  writer.add(name, bytes, false);
  return writer.finish();
}

// The number of four bytes at the first place of `mark`, `offset` behind it, becomes another.
std::string with_number(std::string bytes, const std::string& mark, std::size_t offset,
                        std::uint32_t number) {
  bytes.replace(bytes.find(mark) + offset, 4, little_endian(number, 4));
  return bytes;
}

std::string doubling_components(int levels) {
  std::string objects = tetrahedron_object(1);
  for (int i = 2; i <= levels; ++i) {
    objects += assembly_of(i, component_of(i - 1) + component_of(i - 1));
  }
  return package_of(model_of(objects, item_of(levels)));
}

std::string nested_components(int levels) {
  std::string objects = tetrahedron_object(1), items;
  for (int i = 2; i <= levels; ++i) objects += assembly_of(i, component_of(i - 1));
  return package_of(model_of(objects, item_of(levels)));
}

// Each item looks one level deep, as those before have been looked into; all levels are one inside
// the other.
std::string nested_items(int levels) {
  std::string objects = tetrahedron_object(1), items = item_of(1);
  for (int i = 2; i <= levels; ++i) {
    objects += assembly_of(i, component_of(i - 1));
    items += item_of(i);
  }
  return package_of(model_of(objects, items));
}

// An object with many empty components, many times.
std::string empty_components() {
  std::string many, copies;
  for (int i = 0; i < 1000; ++i) many += component_of(1);
  for (int i = 0; i < 1000; ++i) copies += component_of(2);
  std::string objects = object_of(1, "") + tetrahedron_object(9) +
                        assembly_of(2, many + component_of(9)) + assembly_of(3, copies) +
                        assembly_of(4, replaced(copies, "\"2\"", "\"3\""));
  return package_of(model_of(objects, item_of(4)));
}

std::string zip64_with_many_entries() {
  std::string bytes = package_of(good_model());
  const std::size_t end = bytes.find("PK\x05\x06");
  const std::string record = "PK\x06\x06" + little_endian(44, 8) + little_endian(0x2D002D, 4) +
                             std::string(8, '\0') + little_endian(std::uint64_t{1} << 40, 8) +
                             little_endian(std::uint64_t{1} << 40, 8) + little_endian(100, 8) +
                             little_endian(0, 8);
  const std::string locator =
      "PK\x06\x07" + std::string(4, '\0') + little_endian(end, 8) + little_endian(1, 4);
  return bytes.substr(0, end) + record + locator + bytes.substr(end);
}

std::string in_doctype(const std::string& declarations) {
  return package_of(
      replaced(good_model(), "<model", "<!DOCTYPE model [" + declarations + "]>\n<model"));
}

const std::string kGoodTriangle = "<triangle v1=\"0\" v2=\"1\" v3=\"2\"/>";

std::vector<OddPackage> odd_archives() {
  const auto good = [] { return package_of(good_model()); };
  return {
      {"Truncated", [=] { return good().substr(0, good().size() / 2); }, "ZIP archive"},
      {"WithoutItsEnd", [=] { return good().substr(0, good().size() - 22); }, "ZIP archive"},
      {"WithoutDirectory", [] { return std::string("PK\x03\x04"); }, "ZIP archive"},
      {"EmptyArchive", [] { return zip_of({}); }, "holds no mesh"},
      {"NoArchive", [] { return good_model(); }, "an XML file"},
      {"Text", [] { return std::string("hello"); }, "it is no ZIP archive"},
      {"NoModel",
       [] {
         return zip_of({{"a.txt", "hello"}});
       },
       "holds no mesh"},
      {"ManyEntriesPromised", [] { return zip64_with_many_entries(); }, "ZIP archive"},
      {"SizeTooLarge",
       [] {
         return zip_of({{"3D/3dmodel.model", good_model()}}, {.size = 1000});
       },
       "3D/3dmodel.model"},
      {"SizeOfFourGigabytes",
       [] {
         return zip_of({{"3D/3dmodel.model", good_model()}}, {.size = 0xF0000000});
       },
       "unpacks to more than"},
      {"WrongChecksum",
       [] {
         return zip_of({{"3D/3dmodel.model", good_model()}}, {.crc = 1});
       },
       "is damaged"},
      {"Encrypted",
       [] {
         return zip_of({{"3D/3dmodel.model", good_model()}}, {.flags = 1});
       },
       "is encrypted"},
      {"UnknownCompression",
       [] {
         return zip_of({{"3D/3dmodel.model", good_model()}}, {.method = 77});
       },
       "cannot be read: compression method not supported"},
      {"OffsetOutside", [=] { return with_number(good(), "PK\x01\x02", 42, 0x7FFFFFFF); }, "",
       "relationships of the package cannot be read"},
      {"DirectoryOutside", [=] { return with_number(good(), "PK\x05\x06", 16, 0x7FFFFFFF); },
       "ZIP archive"},
      {"ZipBombOfBlanks",
       [] {
         std::string model = good_model();
         model.resize(1u << 30, ' ');
         return packed("3D/3dmodel.model", model);
       },
       "unpacks to more than a file of this size should hold"},
      {"ZipBombOfZeros", [] { return packed("Metadata/zeros.bin", std::string(1u << 30, '\0')); },
       "", "1 part of the package that cannot be read"},
      {"NamesThatLeadOut",
       [] {
         return package_of(
             good_model(),
             {{"../../evil.txt", "x"}, {"/etc/passwd", "x"}, {"a/%2e%2e/b", "x"}, {"C:\\x", "x"}});
       },
       "", "4 parts ignored: names that lead out of the package, or duplicate names"},
      {"ModelThatLeadsOut",
       [] {
         return zip_of({{"../3dmodel.model", good_model()}});
       },
       "holds no mesh"},
      {"NameTwice",
       [] {
         return package_of(good_model(), {{"3D/3DMODEL.model", "x"}});
       },
       "", "1 part ignored: names that lead out of the package, or duplicate names"},
  };
}

std::vector<OddPackage> odd_packages() {
  const std::string two = replaced(
      kRelationships, "</Relationships>",
      "<Relationship Target=\"/3D/b.model\" Id=\"b\" "
      "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>");
  return {
      {"TwoStartParts",
       [=] {
         return zip_of({{"_rels/.rels", two},
                        {"3D/3dmodel.model", good_model()},
                        {"3D/b.model", "no model"}});
       },
       "", "several first models"},
      {"MissingRelationships",
       [] {
         return zip_of({{"3D/3dmodel.model", good_model()}});
       },
       "", "does not say which part"},
      {"BrokenRelationships",
       [] {
         return zip_of({{"_rels/.rels", "<a><b>"}, {"x/y.model", good_model()}});
       },
       "", "cannot be read"},
      {"StartPartMissing",
       [] {
         return zip_of({{"_rels/.rels", kRelationships}, {"b.model", good_model()}});
       },
       "", "does not say which part"},
      {"NoXml", [] { return package_of("hello"); }, "is not readable XML"},
      {"CutXml", [] { return package_of(good_model().substr(0, good_model().size() / 2)); },
       "is not readable XML"},
      {"EmptyModel", [] { return package_of(""); }, "is not readable XML"},
      {"OtherXml", [] { return package_of("<html/>"); }, "is no 3D model"},
      {"UnknownEncoding", [] { return package_of(replaced(good_model(), "UTF-8", "EBCDIC-9")); },
       "is not readable XML"},
      {"EntityBomb",
       [] {
         return in_doctype(
             "<!ENTITY a \"ha\"><!ENTITY b \"&a;&a;&a;&a;&a;&a;&a;&a;\">"
             "<!ENTITY c \"&b;&b;&b;&b;&b;&b;&b;&b;\">");
       },
       "3D/3dmodel.model:2: has a document type"},
      {"ExternalEntity", [] { return in_doctype("<!ENTITY a SYSTEM \"file:///etc/passwd\">"); },
       "has a document type"},
      {"NestedElements",
       [] {
         std::string deep;
         for (int i = 0; i < 10000; ++i) deep += "<a>";
         for (int i = 0; i < 10000; ++i) deep += "</a>";
         return package_of(replaced(good_model(), "<resources>", deep + "<resources>"));
       },
       "nested too deep"},
      {"HugeTag",
       [] {
         const std::string tag = "<build a=\"" + std::string(9u << 20, 'x') + "\">";
         return packed("3D/3dmodel.model", replaced(good_model(), "<build>", tag));
       },
       "longer than a megabyte"},
      {"LongNamespace",
       [] {
         return package_of(replaced(good_model(), "<build>",
                                    "<build xmlns:q=\"" + std::string(5000, 'x') + "\">"));
       },
       "the name of a namespace is too long"},
      {"UnknownUnit",
       [] { return package_of(model_of(tetrahedron_object(1), item_of(1), "unit=\"yard\"")); }, "",
       "the unit yard"},
      {"UnknownExtension",
       [] {
         return package_of(
             model_of(tetrahedron_object(1), item_of(1), "requiredextensions=\"m zz\""));
       },
       "", "the extension zz"},
      {"PartOfObjectsMissing",
       [] {
         return package_of(
             model_of(tetrahedron_object(1), item_of(1) + item_of(7, "p:path=\"/3D/none.model\"")));
       },
       "", "1 part with objects missing"},
  };
}

std::vector<OddPackage> odd_models() {
  return {
      {"IndexOutside",
       [] { return package_with(kGoodTriangle + replaced(kGoodTriangle, "2", "4")); }, "",
       "1 triangle left out", 1},
      {"IndexHuge",
       [] { return package_with(kGoodTriangle + replaced(kGoodTriangle, "\"2", "\"99999999999")); },
       "", "1 triangle left out", 1},
      {"IndexNegative",
       [] { return package_with(kGoodTriangle + replaced(kGoodTriangle, "\"0", "\"-1")); }, "",
       "1 triangle left out", 1},
      {"IndexMissing", [] { return package_with(kGoodTriangle + "<triangle v1=\"0\"/>"); }, "",
       "1 triangle left out", 1},
      {"OnlyBadTriangles", [] { return package_with("<triangle/>"); }, "holds no readable faces"},
      {"NoTriangles", [] { return package_with(""); }, "holds no triangles"},
      {"NoObjects", [] { return package_of(model_of("")); }, "holds no triangles"},
      {"CoordinateIsNaN", [] { return package_of(replaced(good_model(), "x=\"1\"", "x=\"nan\"")); },
       ""},
      {"CoordinateIsNoNumber",
       [] { return package_of(replaced(good_model(), "x=\"1\"", "x=\"one\"")); }, "",
       "1 point with coordinates"},
      {"CoordinateMissing", [] { return package_of(replaced(good_model(), "x=\"1\"", "")); }, "",
       "1 point with coordinates"},
      {"TrianglesBeforeVertices",
       [] {
         return package_of(model_of("<object id=\"1\"><mesh><triangles>" + kTetrahedronTriangles +
                                        "</triangles>" + kTetrahedronVertices + "</mesh></object>",
                                    item_of(1)));
       },
       ""},
      {"TransformTooShort",
       [] { return package_of(model_of(tetrahedron_object(1), item_of(1, "transform=\"1 0\""))); },
       "a transform that is not twelve numbers"},
      {"TransformIsNaN",
       [] {
         return package_of(model_of(tetrahedron_object(1),
                                    item_of(1, "transform=\"nan 0 0 0 1 0 0 0 1 0 0 0\"")));
       },
       "a transform that is not twelve numbers"},
      {"ItemOfNothing",
       [] { return package_of(model_of(tetrahedron_object(1), item_of(1) + item_of(2))); }, "",
       "1 reference to objects that are not there"},
      {"ItemWithoutId",
       [] { return package_of(model_of(tetrahedron_object(1), item_of(1) + "<item/>")); }, "",
       "1 reference to objects that are not there"},
      {"SameIdTwice",
       [] {
         return package_of(
             model_of(tetrahedron_object(1) + object_of(1, kGoodTriangle), item_of(1)));
       },
       "", "1 object passed over"},
      {"ComponentOfItself",
       [] { return package_of(model_of(assembly_of(1, component_of(1)), item_of(1))); },
       "is a component of itself"},
      {"CycleOfComponents",
       [] {
         return package_of(
             model_of(tetrahedron_object(1) + assembly_of(2, component_of(1) + component_of(4)) +
                          assembly_of(3, component_of(2)) + assembly_of(4, component_of(3)),
                      item_of(4)));
       },
       "is a component of itself"},
      {"DoublingComponents", [] { return doubling_components(50); }, "its components would make"},
      {"NestedComponents", [] { return nested_components(100000); }, "nested too deep"},
      {"NestedItems", [] { return nested_items(100000); }, "nested too deep"},
      {"FewNestedComponents", [] { return nested_components(60); }, ""},
      {"EmptyComponents", [] { return empty_components(); }, "its components would make"},
      {"PropertyMissing",
       [] { return package_with(replaced(kGoodTriangle, "/>", " pid=\"9\" p1=\"3\"/>")); }, "",
       "1 triangle with properties that are not there", 1},
      {"PaintedTriangle",
       [] { return package_with(replaced(kGoodTriangle, "/>", " paint_flavour=\"4\"/>")); }, "",
       "1 triangle with painted data of other programs", 1},
      {"TextureMissing",
       [] {
         return package_of(
             model_of("<m:texture2d id=\"5\" path=\"/../../etc/passwd\" "
                      "contenttype=\"image/png\"/><m:texture2dgroup id=\"6\" "
                      "texid=\"5\"><m:tex2coord u=\"0\" v=\"x\"/></m:texture2dgroup>" +
                          tetrahedron_object(1, "pid=\"6\" pindex=\"0\""),
                      item_of(1)));
       },
       "", "1 texture without a picture"},
      {"LayersInACircle",
       [] {
         return package_of(
             model_of("<m:multiproperties id=\"5\" pids=\"5 6\"><m:multi "
                      "pindices=\"0 0\"/></m:multiproperties><m:multiproperties "
                      "id=\"6\" pids=\"5\"><m:multi/></m:multiproperties>" +
                          tetrahedron_object(1, "pid=\"6\" pindex=\"0\""),
                      item_of(1)));
       },
       ""},
      {"ElementsInWrongPlaces",
       [] {
         return package_of(replaced(good_model(), "<resources>",
                                    "<vertex x=\"1\"/><triangle/><mesh/><color/><multi/><base/>"
                                    "<component/><item/><resources><vertex/><triangle/><base/>"
                                    "<mesh><triangle/></mesh>"));
       },
       "",
       "what is not known here is left out: base, color, component, item, mesh, multi, triangle"},
      {"BeamsAndSlices",
       [] {
         return package_of(replaced(good_model(), "</triangles>",
                                    "</triangles><b:beamlattice xmlns:b=\"urn:b\"><b:beams/>"
                                    "</b:beamlattice>"));
       },
       "", "what is not known here is left out: beamlattice"},
  };
}

class OddThreemf : public ::testing::TestWithParam<OddPackage> {};

TEST_P(OddThreemf, IsReadOrRefusedInOneLine) {
  const std::string bytes = GetParam().bytes();
  const auto start = std::chrono::steady_clock::now();
  ReadOptions options;
  options.attributes = true;
  try {
    const ReadResult result = read_soup(std::string_view(bytes), "a.3mf", options);
    EXPECT_EQ(GetParam().refusal, "");
    expect_valid_indices(result.soup);
    EXPECT_EQ(result.soup.triangles.size(), GetParam().triangles);
    EXPECT_THAT(::testing::PrintToString(texts(result.report.warnings)),
                HasSubstr(GetParam().warning));
    EXPECT_NE(GetParam().warning.empty(), !result.report.warnings.empty());
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(GetParam().refusal, "") << message;
    EXPECT_THAT(message, HasSubstr(GetParam().refusal));
    EXPECT_THAT(message, ::testing::StartsWith("a.3mf: "));
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  RecordProperty("seconds", std::to_string(took.count()));
}

const auto kTestName = [](const auto& tested) { return tested.param.name; };
INSTANTIATE_TEST_SUITE_P(Archives, OddThreemf, ::testing::ValuesIn(odd_archives()), kTestName);
INSTANTIATE_TEST_SUITE_P(Packages, OddThreemf, ::testing::ValuesIn(odd_packages()), kTestName);
INSTANTIATE_TEST_SUITE_P(Models, OddThreemf, ::testing::ValuesIn(odd_models()), kTestName);

TEST(ReadThreemf, CutAtManyPlacesIsReadOrRefused) {
  const std::string bytes = packed("Metadata/a.txt", "hello");
  for (std::size_t size = 4; size < bytes.size(); ++size) {
    EXPECT_THROW((void)read_text(bytes.substr(0, size), "a.3mf"), InputError) << size;
  }
}

}  // namespace
}  // namespace meshrepair
