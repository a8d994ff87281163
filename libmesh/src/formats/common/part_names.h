// SPDX-License-Identifier: MIT
// Names of the parts of a package: with '/' between folders, none before the first.
#pragma once

#include <string>
#include <string_view>

namespace meshrepair {

// Letters of ASCII in lower case.
[[nodiscard]] std::string in_lower_case(std::string_view text);

// "%20" becomes a blank; what is no such thing stays.
[[nodiscard]] std::string percent_decoded(std::string_view name);

// As names of parts are written: what they may not hold as it is becomes "%20" and the like. What
// has that form already stays.
[[nodiscard]] std::string percent_encoded(std::string_view name);

// Relative, without "..", and nothing that could be taken for more than a name.
[[nodiscard]] bool is_part_name(std::string_view name);

// What two names of one part have in common: no '/' before them, decoded, in lower case.
[[nodiscard]] std::string part_key(std::string_view name);

// The part that `path` names in the part `base`, decoded. Empty where it leads out of the package.
[[nodiscard]] std::string part_name(std::string_view path, std::string_view base);

// The part that has the relationships of another: "3D/_rels/3dmodel.model.rels". Of the package, if
// the name is empty.
[[nodiscard]] std::string relationships_part_of(std::string_view part);

// Behind the last '.', in lower case.
[[nodiscard]] std::string extension_of_part(std::string_view part);

// Behind the last '/'.
[[nodiscard]] std::string_view last_of_part(std::string_view part);

}  // namespace meshrepair
