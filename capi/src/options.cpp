// Options of the C interface: kept as they are said; the calls know which there are.
#include <base/error.h>

#include "handles.h"

using namespace meshrepair;

meshrepair_options* meshrepair_options_new() {
  meshrepair_options* options = nullptr;
  (void)guarded([&] { options = new meshrepair_options; });
  return options;
}

void meshrepair_options_free(meshrepair_options* options) { delete options; }

meshrepair_code meshrepair_options_set(meshrepair_options* options, const char* name,
                                       const char* value) {
  return guarded([&] {
    if (options == nullptr) throw UsageError("there is NULL for options");
    if (name == nullptr || *name == '\0') throw UsageError("the option has no name");
    Keyword keyword(name, true);
    if (value != nullptr) keyword.second = std::string(value);
    options->keywords.push_back(std::move(keyword));
  });
}

void meshrepair_options_set_progress(meshrepair_options* options, meshrepair_progress told,
                                     void* data) {
  if (options == nullptr) return;
  options->told = told;
  options->data = data;
}
