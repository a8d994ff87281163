// SPDX-License-Identifier: MIT
// Packed files as programs make them, and as no program should.
#include <functional>
#include <gmock/gmock.h>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <base/error.h>
#include <mesh/packing.h>
#include <mesh/recognize_format.h>
#include <mesh/soup_io.h>

#include "formats/threemf/zip_writer.h"
#include "packed_bytes.h"
#include "soup_fixtures.h"
#include "warning_texts.h"

namespace meshrepair {
namespace {

using ::testing::HasSubstr;

struct OddPacked {
  std::string name;
  std::function<std::string()> bytes;
  std::string refusal = {};  // part of it; empty: it is read
  std::string warning = {};
};

std::string obj() { return format_soup(tetrahedron(), SoupFormat::obj); }
std::string first_half() { return obj().substr(0, obj().size() / 2); }
std::string second_half() { return obj().substr(obj().size() / 2); }

std::string changed(std::string bytes, std::size_t from_end) {
  bytes[bytes.size() - from_end] = static_cast<char>(bytes[bytes.size() - from_end] ^ 0x55);
  return bytes;
}

std::string cut(const std::string& bytes, std::size_t from_end) {
  return bytes.substr(0, bytes.size() - from_end);
}

// 64 MB of few bytes.
std::string zstd_bomb() {
  std::string blocks;
  for (int i = 0; i < 512; ++i) blocks += zstd_run_block('v', std::size_t{128} << 10, false);
  return zstd_frame(blocks + zstd_run_block('v', 1, true));
}

std::string many_empty_members() {
  std::string bytes;
  for (int i = 0; i < 20000; ++i) bytes += gzip_member("");
  return bytes + gzip_of(obj());
}

std::vector<OddPacked> odd_gzip() {
  const std::string extra = little_endian(4, 2) + "abcd";
  const std::string name_and_comment = std::string("part.stl\0what it is\0", 20);
  return {
      {"Plain", [] { return gzip_of(obj()); }},
      {"StoredMember", [] { return gzip_member(obj()); }},
      {"SeveralMembers", [] { return gzip_of(first_half()) + gzip_member(second_half()); }},
      {"EmptyMembers", [] { return gzip_member("") + gzip_of(obj()) + gzip_of(""); }},
      {"ManyEmptyMembers", many_empty_members},
      {"NameAndComment",
       [=] {
         return gzip_member(obj(), {.flags = 4 | 8 | 16, .fields = extra + name_and_comment});
       }},
      {"ByteOrderMark", [] { return gzip_of("\xEF\xBB\xBF" + obj()); }},
      {"ZerosBehind", [] { return gzip_of(obj()) + std::string(512, '\0'); }},
      {"MoreBehind", [] { return gzip_of(obj()) + "hello"; }, "",
       "5 bytes behind what gzip packed"},
      {"HalfAMemberBehind", [] { return gzip_of(obj()) + "\x1F\x8B"; }, "", "2 bytes behind"},
      {"CutInHeader", [] { return gzip_of(obj()).substr(0, 5); }, "is cut off"},
      {"CutInName", [] { return cut(gzip_member("", {.flags = 8, .fields = "pa"}), 13); },
       "is cut off"},
      {"CutInData", [] { return cut(gzip_of(obj()), 30); }, "is cut off"},
      {"CutInChecksum", [] { return cut(gzip_of(obj()), 1); }, "is cut off"},
      {"CutInSecondMember", [] { return gzip_of(first_half()) + cut(gzip_of(second_half()), 9); },
       "is cut off"},
      {"WrongChecksum", [] { return gzip_member(obj(), {.crc = 1}); }, "wrong gzip checksum"},
      {"WrongLength", [] { return gzip_member(obj(), {.length = 1}); }, "wrong gzip checksum"},
      {"WrongData", [] { return changed(gzip_of(obj()), 20); }, "is damaged"},
      {"WrongStoredLength",
       [] {
         std::string bytes = gzip_member(obj());
         bytes[11] ^= 1;
         return bytes;
       },
       "invalid stored block lengths"},
      {"WrongHeaderChecksum", [] { return gzip_member(obj(), {.flags = 2, .fields = "ab"}); },
       "header crc mismatch"},
      {"UnknownFlags", [] { return gzip_member(obj(), {.flags = 0xE0}); }, "unknown header flags"},
      {"UnknownMethod", [] { return gzip_member(obj(), {.method = 7}); }, "by gzip"},
      {"Empty", [] { return gzip_of(""); }, "is empty"},
      {"NoMesh", [] { return gzip_of("hello"); }, "is in no known format"},
      {"Tree", [] { return gzip_of(kTreeSignature); }, "is a BSP tree"},
      {"Bomb", [] { return gzip_of(std::string(std::size_t{64} << 20, 'v')); },
       "unpacks to more than"},
      {"Twice", [] { return gzip_of(gzip_of(obj())); }, "packed twice, by gzip within gzip"},
      {"AroundZstd", [] { return gzip_of(zstd_of(obj())); }, "packed twice, by zstd within gzip"},
      {"AroundZip",
       [] {
         return gzip_of(zip_of({{"a.obj", obj()}}));
       },
       "packed twice, by ZIP within gzip"},
      {"AroundThreemf", [] { return gzip_of(format_soup(tetrahedron(), SoupFormat::threemf)); }},
      {"AroundGlb", [] { return gzip_of(format_soup(tetrahedron(), SoupFormat::glb)); }},
  };
}

std::vector<OddPacked> odd_zstd() {
  return {
      {"Plain", [] { return zstd_of(obj()); }},
      {"RawBlocks",
       [] {
         return zstd_frame(zstd_raw_block(first_half(), false) +
                           zstd_raw_block(second_half(), true));
       }},
      {"RunOfOneByte",
       [] { return zstd_frame(zstd_run_block('\n', 1000, false) + zstd_raw_block(obj(), true)); }},
      {"SeveralFrames", [] { return zstd_of(first_half()) + zstd_of(second_half()); }},
      {"EmptyFrames", [] { return zstd_of("") + zstd_of(obj()) + zstd_of(""); }},
      {"SkippableFirst", [] { return zstd_skippable("index") + zstd_of(obj()); }},
      {"SkippableBetween",
       [] { return zstd_of(first_half()) + zstd_skippable("") + zstd_of(second_half()); }},
      {"SkippableLast", [] { return zstd_of(obj()) + zstd_skippable("seek table"); }},
      {"SkippableAlone", [] { return zstd_skippable("index"); }, "is empty"},
      {"SkippableBeyondTheEnd", [] { return zstd_of(obj()) + cut(zstd_skippable("index"), 2); },
       "is cut off"},
      {"ZerosBehind", [] { return zstd_of(obj()) + std::string(100, '\0'); }},
      {"MoreBehind", [] { return zstd_of(obj()) + "hello"; }, "",
       "5 bytes behind what zstd packed"},
      {"GzipBehind", [] { return zstd_of(obj()) + gzip_of(obj()); }, "", "behind what zstd packed"},
      {"CutInHeader", [] { return zstd_of(obj()).substr(0, 5); }, "is cut off"},
      {"CutInData", [] { return cut(zstd_of(obj()), 10); }, "is cut off"},
      {"CutInChecksum", [] { return cut(zstd_of(obj()), 1); }, "is cut off"},
      {"WithoutItsLastBlock", [] { return zstd_frame(zstd_raw_block(obj(), false)); },
       "is cut off"},
      {"WrongChecksum", [] { return changed(zstd_of(obj()), 1); }, "wrong zstd checksum"},
      {"ReservedBlock", [] { return zstd_frame(zstd_block(3, 5, true) + "hello"); }, "is damaged"},
      {"ReservedBit", [] { return kZstdMagic + '\x08' + std::string(20, '\0'); }, "is damaged"},
      {"Dictionary",
       [] { return kZstdMagic + '\x01' + '\x50' + '\x07' + zstd_raw_block(obj(), true); },
       "with a dictionary"},
      {"HugeWindow", [] { return zstd_frame(zstd_raw_block(obj(), true), 21); },
       "a window that is too large"},
      {"LargestWindowThatIsAllowed", [] { return zstd_frame(zstd_raw_block(obj(), true), 17); }},
      {"HugeContentSize",
       [] {
         return kZstdMagic + '\xC0' + '\x50' + little_endian(std::uint64_t{1} << 60, 8) +
                zstd_raw_block(obj(), true);
       },
       "is damaged"},
      {"Bomb", zstd_bomb, "unpacks to more than"},
      {"Empty", [] { return zstd_of(""); }, "is empty"},
      {"Twice", [] { return zstd_of(zstd_of(obj())); }, "packed twice, by zstd within zstd"},
  };
}

std::string deflated(const PackageParts& parts) {
  ZipWriter writer;
  for (const auto& [name, bytes] : parts) writer.add(name, bytes, false);
  return writer.finish();
}

std::string zip_bomb(const std::string& name) {
  const std::string bytes(std::size_t{64} << 20, 'v');
  const std::string packed = gzip_of(bytes);
  const std::string data = packed.substr(10, packed.size() - 18);  // without header and checksum
  return zip_of({{name, data}}, {.size = static_cast<std::uint32_t>(bytes.size() - data.size()),
                                 .method = 8,
                                 .crc = crc32_of(bytes) - crc32_of(data)});
}

PackageParts several(int count) {
  PackageParts parts;
  for (int i = 0; i < count; ++i) {
    std::string name = "folder/part_" + std::to_string(i);
    parts.emplace_back(name += ".obj", obj());
  }
  return parts;
}

std::vector<OddPacked> zips_that_are_read() {
  return {
      {"Stored",
       [] {
         return zip_of({{"part.obj", obj()}});
       }},
      {"Deflated",
       [] {
         return deflated({{"part.obj", obj()}});
       }},
      {"BesideOthers",
       [] {
         return zip_of({{"README.txt", "1 2 3\n"},
                        {"part.mtl", "newmtl a\n"},
                        {"part.OBJ", obj()},
                        {"a.png", "\x89PNG"},
                        {"license", "solid rights"}});
       }},
      {"HiddenFiles",
       [] {
         return zip_of({{"part.obj", obj()},
                        {"__MACOSX/._part.obj", "Mac"},
                        {".part.obj", "x"},
                        {"__MACOSX/part.stl", "x"}});
       }},
      {"Folders",
       [] {
         return zip_of({{"a/", ""}, {"a/b.stl/", ""}, {"a/b.stl/c.obj", obj()}});
       }},
      {"Backslashes",
       [] {
         return zip_of({{"a\\b\\part.obj", obj()}});
       }},
      {"ByContent",
       [] {
         return zip_of({{"part", obj()}, {"readme", "hello"}});
       }},
      {"ByContentThoughAnotherFormat",
       [] {
         return zip_of({{"part.dat", obj()}});
       }},
      {"Threemf",
       [] {
         return zip_of({{"part.3mf", format_soup(tetrahedron(), SoupFormat::threemf)}});
       }},
      {"ThreemfWithAMeshInIt",
       [] {
         return package_of(model_of(tetrahedron_object(1), item_of(1)),
                           {{"Metadata/other.obj", obj()}});
       }},
      {"MoreBehind",
       [] {
         return zip_of({{"part.obj", obj()}}) + "hello";
       }},
      {"LongName",
       [] {
         return zip_of({{std::string(300, 'a') + "/" + std::string(300, 'b') + ".obj", obj()}});
       }},
      {"NameLeadsOutOfAnother",
       [] {
         return zip_of({{"../a.obj", "x"}, {"b.obj", obj()}});
       }},
  };
}

std::vector<OddPacked> zips_that_are_refused() {
  const auto lying = [](const ZipLies& lies) { return zip_of({{"part.obj", obj()}}, lies); };
  return {
      {"SeveralMeshes", [] { return zip_of(several(3)); },
       "holds several meshes, and which one is meant is not clear: folder/part_0.obj, "
       "folder/part_1.obj, folder/part_2.obj"},
      {"ManyMeshes", [] { return zip_of(several(9)); }, "folder/part_3.obj and 5 more"},
      {"SeveralByContent",
       [] {
         return zip_of({{"a", obj()}, {"b", obj()}});
       },
       "several meshes, and which one is meant is not clear: a, b"},
      {"NoMesh",
       [] {
         return zip_of({{"a.txt", "hello"}, {"b.png", "x"}});
       },
       "holds no mesh"},
      {"Notes",
       [] {
         return zip_of({{"1", "1 mesh"}, {"2", "solid rights"}, {"3", "g is a letter"}, {"4", ""}});
       },
       "holds no mesh"},
      {"NoFiles", [] { return zip_of({}); }, "holds no mesh"},
      {"NameLeadsOut",
       [] {
         return zip_of({{"../a.obj", obj()}});
       },
       "holds no mesh; passed over: 1 file"},
      {"Gzip",
       [] {
         return zip_of({{"part.obj.gz", gzip_of(obj())}});
       },
       "part.obj.gz: is packed twice, by gzip within ZIP"},
      {"Zip",
       [] {
         return zip_of({{"parts.zip", zip_of({{"part.obj", obj()}})}});
       },
       "holds no mesh"},
      {"ZipNamedAsMesh",
       [] {
         return zip_of({{"part.obj", zip_of({{"part.obj", obj()}})}});
       },
       "packed twice, by ZIP within ZIP"},
      {"Encrypted", [=] { return lying({.flags = 1}); }, "part.obj is encrypted"},
      {"EncryptedByContent",
       [] {
         return zip_of({{"part", obj()}}, {.flags = 1});
       },
       "part is encrypted"},
      {"UnknownMethod", [=] { return lying({.method = 7}); }, "compression method not supported"},
      {"WrongChecksum", [=] { return lying({.crc = 1}); }, "part.obj is damaged"},
      {"WrongSize", [=] { return lying({.size = 10}); }, "part.obj"},
      {"Truncated",
       [] {
         return cut(zip_of({{"part.obj", obj()}}), 30);
       },
       "is no usable ZIP archive"},
      {"HeaderAlone", [] { return std::string("PK\x03\x04"); }, "is no usable ZIP archive"},
      {"EmptyMesh",
       [] {
         return zip_of({{"part.obj", ""}});
       },
       "part.obj: is empty"},
      {"NotWhatItsNameSays",
       [] {
         return zip_of({{"a/part.glb", "hello"}});
       },
       "a/part.glb: does not begin with 'glTF'"},
      {"Bomb", [] { return zip_bomb("part.obj"); }, "unpacks to more than"},
      {"BombByContent", [] { return zip_bomb("part"); }, "unpacks to more than"},
  };
}

class OddPackedFiles : public ::testing::TestWithParam<OddPacked> {};

TEST_P(OddPackedFiles, AreReadOrRefusedInOneLine) {
  const std::string bytes = GetParam().bytes();
  ReadOptions options;
  options.attributes = true;
  try {
    const ReadResult result = read_soup(std::string_view(bytes), "any", options);
    EXPECT_EQ(GetParam().refusal, "");
    EXPECT_EQ(result.soup.triangles.size(), 4u);
    EXPECT_THAT(::testing::PrintToString(texts(result.report.warnings)),
                HasSubstr(GetParam().warning));
    EXPECT_NE(GetParam().warning.empty(), !result.report.warnings.empty());
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(GetParam().refusal, "") << message;
    EXPECT_THAT(message, HasSubstr(GetParam().refusal));
    EXPECT_THAT(message, ::testing::StartsWith("any: "));
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
}

const auto kTestName = [](const auto& tested) { return tested.param.name; };
INSTANTIATE_TEST_SUITE_P(Gzip, OddPackedFiles, ::testing::ValuesIn(odd_gzip()), kTestName);
INSTANTIATE_TEST_SUITE_P(Zstd, OddPackedFiles, ::testing::ValuesIn(odd_zstd()), kTestName);
INSTANTIATE_TEST_SUITE_P(ZipRead, OddPackedFiles, ::testing::ValuesIn(zips_that_are_read()),
                         kTestName);
INSTANTIATE_TEST_SUITE_P(ZipRefused, OddPackedFiles, ::testing::ValuesIn(zips_that_are_refused()),
                         kTestName);

TEST(PackedFiles, CutAtAnyPlaceAreRefused) {
  for (const std::string& bytes : {gzip_of(obj()), zstd_of(obj()), zip_of({{"a.obj", obj()}})}) {
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      EXPECT_THROW((void)read_text(bytes.substr(0, size), "a.dat"), InputError) << size;
    }
  }
}

TEST(PackedFiles, WithAnyByteChangedAreReadOrRefused) {
  for (const std::string& bytes : {gzip_of(obj()), zstd_of(obj()), zip_of({{"a.obj", obj()}})}) {
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      for (const int flip : {1, 0x80, 0xFF}) {
        std::string copy = bytes;
        copy[i] = static_cast<char>(copy[i] ^ flip);
        try {
          expect_valid_indices(read_text(copy, "a.dat").soup);
        } catch (const InputError& error) {
          EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        }
      }
    }
  }
}

}  // namespace
}  // namespace meshrepair
