// SPDX-License-Identifier: MIT
// 3MF packages and ZIP archives of all kinds, made in code.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace meshrepair {

using PackageParts = std::vector<std::pair<std::string, std::string>>;  // names and bytes

inline std::uint32_t crc32_of(std::string_view bytes) {
  std::uint32_t crc = 0xFFFFFFFF;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int i = 0; i < 8; ++i) crc = crc >> 1 ^ ((crc & 1) != 0 ? 0xEDB88320u : 0u);
  }
  return ~crc;
}

// `count` bytes, the lowest first.
inline std::string little_endian(std::uint64_t value, int count) {
  std::string bytes;
  for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> 8 * i & 0xFF);
  return bytes;
}

// What the headers of an archive may lie about.
struct ZipLies {
  std::uint32_t size = 0;    // added to the size of each part
  std::uint16_t flags = 0;   // 1: encrypted
  std::uint16_t method = 0;  // 0: stored
  std::uint32_t crc = 0;     // added
};

// A ZIP archive of parts that are stored as they are.
inline std::string zip_of(const PackageParts& parts, const ZipLies& lies = {}) {
  std::string archive, directory;
  for (const auto& [name, bytes] : parts) {
    const std::string common =
        little_endian(lies.flags, 2) + little_endian(lies.method, 2) + little_endian(0x21, 4) +
        little_endian(crc32_of(bytes) + lies.crc, 4) + little_endian(bytes.size(), 4) +
        little_endian(bytes.size() + lies.size, 4) + little_endian(name.size(), 2) +
        little_endian(0, 2);
    directory += "PK\x01\x02" + little_endian(20, 2) + little_endian(20, 2) + common +
                 std::string(10, '\0') + little_endian(archive.size(), 4) + name;
    archive += "PK\x03\x04" + little_endian(20, 2) + common + name + bytes;
  }
  const std::string counts = little_endian(parts.size(), 2) + little_endian(parts.size(), 2) +
                             little_endian(directory.size(), 4) + little_endian(archive.size(), 4);
  return archive + directory + "PK\x05\x06" + std::string(4, '\0') + counts + std::string(2, '\0');
}

inline const std::string kRelationships =
    "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"
    "<Relationship Target=\"/3D/3dmodel.model\" Id=\"rel0\" "
    "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>";

// A package with this model, and other parts.
inline std::string package_of(const std::string& model, const PackageParts& others = {}) {
  PackageParts parts = {{"_rels/.rels", kRelationships}, {"3D/3dmodel.model", model}};
  parts.insert(parts.end(), others.begin(), others.end());
  return zip_of(parts);
}

// A model with these resources and items.
inline std::string model_of(const std::string& resources, const std::string& items = {},
                            const std::string& attributes = {}) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model " + attributes +
         " xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\""
         " xmlns:m=\"http://schemas.microsoft.com/3dmanufacturing/material/2015/02\""
         " xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\">\n"
         "<resources>" +
         resources + "</resources>\n<build>" + items + "</build>\n</model>\n";
}

inline const std::string kTetrahedronVertices =
    "<vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/>"
    "<vertex x=\"0\" y=\"1\" z=\"0\"/><vertex x=\"0\" y=\"0\" z=\"1\"/></vertices>";

// An object; `triangles` are elements.
inline std::string object_of(int id, const std::string& triangles,
                             const std::string& attributes = {}) {
  return "<object id=\"" + std::to_string(id) + "\" " + attributes + "><mesh>" +
         kTetrahedronVertices + "<triangles>" + triangles + "</triangles></mesh></object>";
}

inline const std::string kTetrahedronTriangles =
    "<triangle v1=\"0\" v2=\"2\" v3=\"1\"/><triangle v1=\"0\" v2=\"1\" v3=\"3\"/>"
    "<triangle v1=\"1\" v2=\"2\" v3=\"3\"/><triangle v1=\"0\" v2=\"3\" v3=\"2\"/>";

inline std::string tetrahedron_object(int id, const std::string& attributes = {}) {
  return object_of(id, kTetrahedronTriangles, attributes);
}

// An object made of components, which are elements.
inline std::string assembly_of(int id, const std::string& components) {
  return "<object id=\"" + std::to_string(id) + "\"><components>" + components +
         "</components></object>";
}

inline std::string component_of(int id, const std::string& attributes = {}) {
  return "<component objectid=\"" + std::to_string(id) + "\" " + attributes + "/>";
}

inline std::string item_of(int id, const std::string& attributes = {}) {
  return "<item objectid=\"" + std::to_string(id) + "\" " + attributes + "/>";
}

}  // namespace meshrepair
