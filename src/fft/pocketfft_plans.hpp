// Declarations shared by plans and transforms of pocketfft
#pragma once
#include <cstddef>

// Tables of a length, different ones for each set of instructions
struct plan_tables {
  virtual ~plan_tables() = default;
};

// Several transforms of one length. Strides and distances are in complex elements
struct batch {
  bool forward;
  size_t n, many;
  std::ptrdiff_t in_stride, in_distance, out_stride, out_distance;
  const plan_tables *table;
};

// One for each set of instructions
namespace portable {
plan_tables *new_tables(size_t n);
void run(const batch &b, const double *in, double *out);
}
#ifdef CONTACT_HAS_AVX2
namespace avx2 {
plan_tables *new_tables(size_t n);
void run(const batch &b, const double *in, double *out);
}
#endif
