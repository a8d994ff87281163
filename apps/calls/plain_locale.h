// SPDX-License-Identifier: MIT
// Numbers have a point, wherever the process that calls lives.
#pragma once

#include <clocale>
#include <locale.h>

namespace meshrepair {

// While it lives, this thread has the C locale, whatever the process has chosen.
class PlainLocale {
 public:
  PlainLocale() : before_(uselocale(plain())) {}
  PlainLocale(const PlainLocale&) = delete;
  PlainLocale& operator=(const PlainLocale&) = delete;
  ~PlainLocale() { uselocale(before_); }

 private:
  static locale_t plain() {
    static locale_t the_one = newlocale(LC_ALL_MASK, "C", nullptr);
    return the_one;
  }

  locale_t before_;
};

}  // namespace meshrepair
