// SPDX-License-Identifier: MIT
#include "package_writer.h"

#include <map>
#include <unordered_set>
#include <utility>

#include "common/xml_text.h"
#include "formats/common/part_names.h"
#include "package_parts.h"

namespace meshrepair {

std::string uri_of_part(std::string_view part) {
  std::string uri(1, '/');
  return uri += percent_encoded(part);
}

std::string PackageWriter::content_types() const {
  std::map<std::string, std::string> of_extension = {{"model", std::string(kModelType)},
                                                     {"rels", std::string(kRelationshipsType)}};
  for (const WrittenPicture& picture : pictures_) {
    of_extension.emplace(extension_of_part(picture.name), picture.media_type);
  }
  std::string overrides;
  if (kept_ != nullptr) {
    for (const KeptPackage::Part& part : kept_->parts) {
      const std::string type =
          part.media_type.empty() ? "application/octet-stream" : part.media_type;
      const std::string extension = extension_of_part(part.name);
      if (!extension.empty() && of_extension.emplace(extension, type).first->second == type) {
        continue;
      }
      overrides += "<Override";
      append_xml_attribute(overrides, "PartName", uri_of_part(part.name));
      append_xml_attribute(overrides, "ContentType", type);
      overrides += "/>\n";
    }
  }
  std::string xml(kXmlDeclaration);
  xml += "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">\n";
  for (const auto& [extension, type] : of_extension) {
    xml += "<Default";
    append_xml_attribute(xml, "Extension", extension);
    append_xml_attribute(xml, "ContentType", type);
    xml += "/>\n";
  }
  return xml + overrides + "</Types>\n";
}

std::string PackageWriter::of_package() {
  begin();
  add(kModelRelationship, kUsualModelPart);
  if (kept_ != nullptr) {
    for (const auto& one : kept_->of_package) add(one.type, one.target);
  }
  return end();
}

std::string PackageWriter::of_model(const std::vector<std::string>& thumbnails) {
  begin();
  for (const WrittenPicture& picture : pictures_) add(kTextureRelationship, picture.name);
  std::unordered_set<std::string> known;
  if (kept_ != nullptr) {
    for (const auto& one : kept_->of_model) {
      add(one.type, one.target);
      known.insert(part_key(one.target));
    }
  }
  for (const std::string& name : thumbnails) {
    if (known.insert(part_key(name)).second) add(kThumbnailRelationship, name);
  }
  return next_ == 0 ? std::string() : end();
}

void PackageWriter::begin() {
  next_ = 0;
  xml_ = kXmlDeclaration;
  xml_ +=
      "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">\n";
}

void PackageWriter::add(std::string_view type, std::string_view target) {
  xml_ += "<Relationship";
  append_xml_attribute(xml_, "Target", uri_of_part(target));
  append_xml_attribute(xml_, "Id", "rel" + std::to_string(next_++));
  append_xml_attribute(xml_, "Type", type);
  xml_ += "/>\n";
}

std::string PackageWriter::end() { return std::move(xml_) + "</Relationships>\n"; }

}  // namespace meshrepair
