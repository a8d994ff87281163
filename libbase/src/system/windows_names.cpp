// SPDX-License-Identifier: MIT
// Text that becomes a std::filesystem::path is UTF-8, as is the text that a path gives. libstdc++
// converts what it is given by the facet codecvt<wchar_t, char>, which follows the code page of the
// C library; that of msvcrt cannot be UTF-8. So the functions of this facet are defined here, and
// the linker takes them instead of those of libstdc++. longest_path() is here, too, because
// whatever writes files calls it: that brings this object into each program.
#include <codecvt>
#include <cwchar>
#include <locale>

#include <base/internal/system.h>

namespace {

using Utf8 = std::codecvt_utf8_utf16<wchar_t>;

const Utf8& utf8() {
  static const Utf8& facet = *new Utf8;
  return facet;
}

}  // namespace

namespace std {

using Conversion = codecvt<wchar_t, char, mbstate_t>;

codecvt_base::result Conversion::do_in(mbstate_t& state, const char* from, const char* from_end,
                                       const char*& from_next, wchar_t* to, wchar_t* to_end,
                                       wchar_t*& to_next) const {
  return utf8().in(state, from, from_end, from_next, to, to_end, to_next);
}

codecvt_base::result Conversion::do_out(mbstate_t& state, const wchar_t* from,
                                        const wchar_t* from_end, const wchar_t*& from_next,
                                        char* to, char* to_end, char*& to_next) const {
  return utf8().out(state, from, from_end, from_next, to, to_end, to_next);
}

int Conversion::do_encoding() const noexcept { return utf8().encoding(); }

int Conversion::do_max_length() const noexcept { return utf8().max_length(); }

int Conversion::do_length(mbstate_t& state, const char* from, const char* end, size_t most) const {
  return utf8().length(state, from, end, most);
}

}  // namespace std

namespace meshrepair::internal {

std::size_t longest_path() noexcept { return 32767; }

}  // namespace meshrepair::internal
