// Turning the triangles of each part the same way round.
#pragma once

#include <cstddef>

#include <bsp/clean_soup.h>
#include <bsp/progress.h>

namespace meshrepair {

struct OrientReport {
  std::size_t parts = 0;  // connected through edges with exactly two triangles
  std::size_t turned_triangles = 0;
  std::size_t unorientable_parts = 0;  // one-sided like a Moebius strip: left as they are
};

// How each triangle is turned against its plane's normal after every part has been oriented
// consistently, the way round that turns the smaller area. A soup that is consistent is not
// changed. `progress` is asked whether to go on.
[[nodiscard]] IdVector<TriangleId, std::int32_t> orient_parts(const CleanSoup& soup,
                                                              OrientReport& report,
                                                              ProgressObserver* progress = nullptr);

// The same as the soup has it.
[[nodiscard]] IdVector<TriangleId, std::int32_t> windings_of(const CleanSoup& soup);

// The triangles as indices into the soup's points.
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> index_triangles(const CleanSoup& soup);

}  // namespace meshrepair
