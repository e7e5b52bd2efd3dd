// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/simd/instruction_set.h"

/// Declares the table `name` of a family of kernels once per instruction set; the family's source, compiled
/// once per set, defines it in namespace cairn::CAIRN_ISA.
#ifdef CAIRN_X86_KERNELS
#define CAIRN_KERNEL_TABLES(Table, name) \
  namespace plain {                      \
  extern const Table name;               \
  }                                      \
  namespace sse42 {                      \
  extern const Table name;               \
  }                                      \
  namespace avx2 {                       \
  extern const Table name;               \
  }                                      \
  namespace avx512 {                     \
  extern const Table name;               \
  }
#define CAIRN_CHOOSE_KERNELS(set, name)            \
  ((set) == InstructionSet::avx512  ? avx512::name \
   : (set) == InstructionSet::avx2  ? avx2::name   \
   : (set) == InstructionSet::sse42 ? sse42::name  \
                                    : plain::name)
#else
#define CAIRN_KERNEL_TABLES(Table, name) \
  namespace plain {                      \
  extern const Table name;               \
  }
#define CAIRN_CHOOSE_KERNELS(set, name) (static_cast<void>(set), plain::name)
#endif
