// SPDX-License-Identifier: MIT
// The vectors of 64-bit ARM as Eigen uses those of x86-64, so that numbers have the same bits: a
// product is rounded before it is added, and the smaller or larger of two is that of std::min or
// std::max, also of zeros of both signs and of what is not a number. Eigen calls these by name,
// whatever -ffp-contract says. It is looked up before the compiler's own header, which it includes.
#pragma once
#include_next <arm_neon.h>

namespace meshrepair_arm64 {

inline float64x2_t smaller(float64x2_t a, float64x2_t b) {
  return vbslq_f64(vcltq_f64(b, a), b, a);
}
inline float64x2_t larger(float64x2_t a, float64x2_t b) { return vbslq_f64(vcgtq_f64(b, a), b, a); }

// Of the halves of a vector, in both halves. Of equal ones SSE takes the second.
inline float64x2_t smallest(float64x2_t a) { return smaller(vextq_f64(a, a, 1), a); }
inline float64x2_t largest(float64x2_t a) { return larger(vextq_f64(a, a, 1), a); }

}  // namespace meshrepair_arm64

#undef vfma_f32
#undef vfmaq_f32
#undef vfmaq_f64
#define vfma_f32(sum, a, b) vmla_f32(sum, a, b)
#define vfmaq_f32(sum, a, b) vmlaq_f32(sum, a, b)
#define vfmaq_f64(sum, a, b) vmlaq_f64(sum, a, b)

#undef vminq_f64
#undef vmaxq_f64
#undef vpminq_f64
#undef vpmaxq_f64
#define vminq_f64(a, b) meshrepair_arm64::smaller(a, b)
#define vmaxq_f64(a, b) meshrepair_arm64::larger(a, b)
#define vpminq_f64(a, same) meshrepair_arm64::smallest(a)
#define vpmaxq_f64(a, same) meshrepair_arm64::largest(a)
