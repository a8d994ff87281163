// Spaces behind openings that were sealed.
#pragma once

#include <vector>

#include <bsp/clean_soup.h>
#include <repair/cell_graph.h>
#include <repair/repair_options.h>
#include <repair/repair_report.h>

namespace meshrepair::internal {

// Makes cells solid that are empty, that no way leads to from infinity but past triangles, and but
// one across triangles of seals. These are the last of the soup; report.seal says how many there
// are, and is told what was filled.
void fill_sealed(const CellGraph& graph, const CleanSoup& soup, const RepairOptions& options,
                 RepairReport& report, std::vector<char>& solid);

}  // namespace meshrepair::internal
