// SPDX-License-Identifier: MIT
// calibration: a fixed work of about a second, whose CPU time says how fast the machine is at this
// moment. bench/compare.py runs it between the runs that it records.
//
// A third each is arithmetic, sorting, and waiting for a cache, as in a repair. Nothing waits for
// main memory: on a busy machine that varied by 16 %, and repairs by 2 to 5 %, so that dividing by
// it made figures worse. Divided by this, they varied by less than 2 %.
//
// It uses nothing of the project, so that no change of the project changes it. Never change it: all
// rows of bench/history.csv are measured by it.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <vector>

namespace {

// xorshift64, Marsaglia 2003.
std::uint64_t next(std::uint64_t& state) {
  state ^= state << 13;
  state ^= state >> 7;
  state ^= state << 17;
  return state;
}

std::uint64_t sort_numbers(std::size_t count, std::uint64_t seed) {
  std::vector<std::uint64_t> numbers(count);
  for (std::uint64_t& number : numbers) number = next(seed);
  std::sort(numbers.begin(), numbers.end());
  return numbers[count / 2];
}

// Signs of determinants, as of points and planes.
std::uint64_t count_positive(std::size_t count, std::uint64_t seed) {
  const auto real = [&] { return static_cast<double>(next(seed) >> 11) * 0x1p-52 - 1; };
  std::uint64_t positive = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double a = real(), b = real(), c = real(), d = real(), e = real(), f = real();
    positive += a * (d * f - e * e) - b * (b * f - e * c) + c * (b * e - d * c) > 0 ? 1 : 0;
  }
  return positive;
}

// Around a circle through all places of an array that a second-level cache hardly holds.
std::uint64_t walk(std::size_t count, std::size_t rounds, std::uint64_t seed) {
  std::vector<std::uint32_t> order(count);
  std::vector<std::uint32_t> next_place(count);
  for (std::size_t i = 0; i < count; ++i) order[i] = static_cast<std::uint32_t>(i);
  for (std::size_t i = count - 1; i > 0; --i) std::swap(order[i], order[next(seed) % (i + 1)]);
  for (std::size_t i = 0; i < count; ++i) next_place[order[i]] = order[(i + 1) % count];
  std::uint64_t sum = 0;
  std::uint32_t at = 0;
  for (std::size_t i = 0; i < rounds * count; ++i) {
    sum = 31 * sum + at;
    at = next_place[at];
  }
  return sum;
}

}  // namespace

int main() {
  // What was found is printed, so that no compiler leaves the work out.
  const std::uint64_t found =
      sort_numbers(4'000'000, 1) + count_positive(25'000'000, 2) + walk(200'000, 300, 3);
  std::printf("%016llx\n", static_cast<unsigned long long>(found));
  return 0;
}
