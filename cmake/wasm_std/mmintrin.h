// SPDX-License-Identifier: MIT
// Eigen includes this header where there are vectors of 128 bits, and uses nothing of it; the
// compiler's own refuses all but x86.
#pragma once
