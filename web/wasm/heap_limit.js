// SPDX-License-Identifier: MIT
// In place of emscripten's own: memory does not grow beyond what --max-memory says (libbase/src/system/wasm_process.cpp). One page less
// than 4 GB, as 32 bits name no more.
mergeInto(LibraryManager.library, {
  emscripten_get_heap_max: function() {
    return Math.min(Module['heapLimit'] || Infinity, 4294901760);
  },
});
