// SPDX-License-Identifier: MIT
// Texts as XML holds them.
#pragma once

#include <string>
#include <string_view>

namespace meshrepair {

inline constexpr std::string_view kXmlDeclaration = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";

// Appends a text for between tags or inside quotes. What is no UTF-8 is taken for Latin-1; what XML
// cannot hold becomes '?'.
void append_xml_text(std::string& xml, std::string_view text);

// ` name="text"`.
void append_xml_attribute(std::string& xml, std::string_view name, std::string_view text);

}  // namespace meshrepair
