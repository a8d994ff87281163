// SPDX-License-Identifier: MIT
// boolean_identities [PAIRS]: Boolean operations on so many random pairs of solids (1,000), of
// which half share faces, edges or corners. Do the volumes add up, and is everything certified?
// Prints how far they are apart at most, as a share of what goes in; exit code 1 if beyond 1e-7, or
// something is not certified.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <boolean/boolean.h>

#include "random_solids.h"

using namespace meshrepair;
using Solids = std::vector<TriangleSoup>;

namespace {

constexpr double kAllowed = 1e-7;

class Identities {
 public:
  void check(std::uint64_t seed) {
    seed_ = seed;
    const Solids pair = testing::random_pair(seed);
    const double a = signed_volume(pair[0]), b = signed_volume(pair[1]);
    given_ = a + b;
    const double both = volume(pair, SetOperation::intersect);
    expect("union", volume(pair, SetOperation::unite), a + b - both);
    expect("difference", volume(pair, SetOperation::subtract), a - both);
    expect("turned difference", volume({pair[1], pair[0]}, SetOperation::subtract), b - both);
    expect("xor", volume(pair, SetOperation::exclude), a + b - 2 * both);
    with_itself_and_nothing(pair[0], a);
    de_morgan(pair);
  }

  // Whether all held.
  [[nodiscard]] bool report(std::uint64_t pairs) const {
    std::printf(
        "%llu pairs, %zu operations: %zu not certified, %zu beyond %g, at most %.2g apart\n",
        static_cast<unsigned long long>(pairs), operations_, uncertified_, wrong_, kAllowed,
        worst_);
    return uncertified_ + wrong_ == 0;
  }

 private:
  void with_itself_and_nothing(const TriangleSoup& solid, double volume_given) {
    expect("union with itself", volume({solid, solid}, SetOperation::unite), volume_given);
    expect("intersection with itself", volume({solid, solid}, SetOperation::intersect),
           volume_given);
    expect("difference with itself", volume({solid, solid}, SetOperation::subtract), 0);
    expect("xor with itself", volume({solid, solid}, SetOperation::exclude), 0);
    expect("union with nothing", volume({solid, {}}, SetOperation::unite), volume_given);
    expect("intersection with nothing", volume({solid, {}}, SetOperation::intersect), 0);
    expect("difference with nothing", volume({solid, {}}, SetOperation::subtract), volume_given);
    expect("nothing without it", volume({{}, solid}, SetOperation::subtract), 0);
  }

  // The complement in a box of the union is the intersection of the complements.
  void de_morgan(const Solids& pair) {
    const TriangleSoup all = testing::box({-9, -9, -9}, {9, 9, 9});
    const double of_union =
        volume({all, result({pair[0], pair[1]}, SetOperation::unite)}, SetOperation::subtract);
    const double of_both = volume({result({all, pair[0]}, SetOperation::subtract),
                                   result({all, pair[1]}, SetOperation::subtract)},
                                  SetOperation::intersect);
    given_ = signed_volume(all);
    expect("De Morgan", of_union, of_both);
  }

  TriangleSoup result(const Solids& solids, SetOperation operation) {
    ++operations_;
    BooleanReport report;
    Surface surface = boolean(solids, operation, {}, report);
    if (surface.mesh.triangles.empty()) return {};
    const Topology& topology = report.result.output;
    if (!topology.closed() || !topology.manifold() || !topology.oriented() ||
        !report.result.certify.passed()) {
      ++uncertified_;
      std::printf("pair %llu, %s: not certified\n", static_cast<unsigned long long>(seed_),
                  std::string(operation_name(operation)).c_str());
    }
    return std::move(surface.mesh);
  }

  double volume(const Solids& solids, SetOperation operation) {
    return signed_volume(result(solids, operation));
  }

  void expect(const char* what, double is, double should) {
    const double apart = std::abs(is - should) / given_;
    worst_ = std::max(worst_, apart);
    if (apart <= kAllowed) return;
    ++wrong_;
    std::printf("pair %llu, %s: %.17g, not %.17g\n", static_cast<unsigned long long>(seed_), what,
                is, should);
  }

  std::uint64_t seed_ = 0;
  double given_ = 0;
  double worst_ = 0;
  std::size_t operations_ = 0;
  std::size_t uncertified_ = 0;
  std::size_t wrong_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t pairs = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1000;
  Identities identities;
  for (std::uint64_t seed = 0; seed < pairs; ++seed) identities.check(seed);
  return identities.report(pairs) ? 0 : 1;
}
