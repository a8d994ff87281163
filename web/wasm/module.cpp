// SPDX-License-Identifier: MIT
// The module has no main(): its functions are those of meshrepair.h, which JavaScript calls. This
// file makes the linker take them.
#include <meshrepair.h>
