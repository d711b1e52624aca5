// SPDX-License-Identifier: Apache-2.0
// Which instruction sets Highway compiles the batch kernels for. Include before any Highway header.
#pragma once

// Baseline, SSE4, AVX2 and AVX-512: SSSE3 and the AVX-512 extensions gain nothing here and each set costs a compilation. The
// kernels keep vectors in structures and arrays, which the sizeless vectors of SVE and RVV do not allow; ARM processors
// use NEON.
#ifndef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS \
  (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#endif
