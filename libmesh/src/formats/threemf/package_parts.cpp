// SPDX-License-Identifier: MIT
#include "package_parts.h"

#include <utility>

#include "common/xml_stream.h"
#include "formats/common/part_names.h"

namespace meshrepair {
namespace {

class RelationshipReader final : public XmlHandler {
 public:
  explicit RelationshipReader(std::string_view base) : base_(base) {}

  void start(std::string_view /*space*/, std::string_view name,
             const XmlAttributes& attributes) override {
    if (name != "Relationship" || attributes.text("TargetMode") == "External") return;
    std::string target = part_name(attributes.text("Target"), base_);
    if (!target.empty()) found.push_back({attributes.text("Type"), std::move(target)});
  }

  std::vector<PackageRelationship> found;

 private:
  std::string_view base_;
};

class ContentTypeReader final : public XmlHandler {
 public:
  void start(std::string_view /*space*/, std::string_view name,
             const XmlAttributes& attributes) override {
    const std::string type = attributes.text("ContentType");
    if (name == "Default") {
      of_extension.try_emplace(in_lower_case(attributes.text("Extension")), type);
    } else if (name == "Override") {
      of_part.try_emplace(part_key(attributes.text("PartName")), type);
    }
  }

  std::unordered_map<std::string, std::string> of_extension, of_part;
};

void read_xml_part(const MeshSource& source, ZipReader& archive, const ZipReader::Entry& entry,
                   XmlHandler& handler) {
  XmlStream stream(source, entry.name, handler);
  archive.read(entry, [&](std::string_view piece) { stream.feed(piece); });
  stream.finish();
}

}  // namespace

std::vector<PackageRelationship> read_relationships(const MeshSource& source, ZipReader& archive,
                                                    std::string_view part) {
  const ZipReader::Entry* const entry = archive.find(relationships_part_of(part));
  if (entry == nullptr) return {};
  RelationshipReader reader(part);
  read_xml_part(source, archive, *entry, reader);
  return std::move(reader.found);
}

void ContentTypes::read(const MeshSource& source, ZipReader& archive) {
  const ZipReader::Entry* const entry = archive.find(kContentTypesPart);
  if (entry == nullptr) return;
  ContentTypeReader reader;
  read_xml_part(source, archive, *entry, reader);
  of_extension_ = std::move(reader.of_extension);
  of_part_ = std::move(reader.of_part);
}

std::string ContentTypes::of(std::string_view part) const {
  const auto by_name = of_part_.find(part_key(part));
  if (by_name != of_part_.end()) return by_name->second;
  const auto by_extension = of_extension_.find(extension_of_part(part));
  return by_extension == of_extension_.end() ? std::string() : by_extension->second;
}

}  // namespace meshrepair
