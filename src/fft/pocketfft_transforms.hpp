// Transforms by pocketfft, compiled once for each set of instructions: LANES is the name of the set
//
// One row or column per lane of a register is transformed at a time; the result of a row does not depend on its neighbours.
// A plan is not changed when it is executed, so that threads may share it.
#define POCKETFFT_NO_MULTITHREADING
// a separate name for each set, otherwise the linker would use the functions of one set for both
#define pocketfft LANES_NAME(pocketfft_, LANES)
#define LANES_NAME(a, b) LANES_JOIN(a, b)
#define LANES_JOIN(a, b) a##b
#include <complex>

#include "pocketfft/pocketfft_hdronly.h"
#include "pocketfft_plans.hpp"

namespace LANES {

using pocketfft::detail::arr;
using pocketfft::detail::cmplx;
using pocketfft::detail::pocketfft_c;
using pocketfft::detail::vtype_t;

constexpr size_t lanes = pocketfft::detail::VLEN<double>::val;
using wide = vtype_t<double>;

struct tables : plan_tables {
  explicit tables(size_t n) : of_complex(n) {}
  pocketfft_c<double> of_complex;
};

plan_tables *new_tables(size_t n) { return new tables(n); }

// One element of a batch, or the only one
inline void put(double &to, double from, size_t) { to = from; }
inline double take(double from, size_t) { return from; }
template <typename V> inline void put(V &to, double from, size_t k) { to[k] = from; }
template <typename V> inline double take(const V &from, size_t k) { return from[k]; }

// `count` complex transforms with first elements at `in` and `out`
template <typename V>
void run_complex(const batch &b, const tables &t, cmplx<V> *work, const double *in, double *out, size_t count) {
  for (size_t j = 0; j < b.n; ++j)
    for (size_t k = 0; k < count; ++k) {
      const double *from = in + 2*(static_cast<std::ptrdiff_t>(k)*b.in_distance + static_cast<std::ptrdiff_t>(j)*b.in_stride);
      put(work[j].r, from[0], k);
      put(work[j].i, from[1], k);
    }
  t.of_complex.exec(work, 1.0, b.forward);
  for (size_t j = 0; j < b.n; ++j)
    for (size_t k = 0; k < count; ++k) {
      double *to = out + 2*(static_cast<std::ptrdiff_t>(k)*b.out_distance + static_cast<std::ptrdiff_t>(j)*b.out_stride);
      to[0] = take(work[j].r, k);
      to[1] = take(work[j].i, k);
    }
}

void run(const batch &b, const double *in, double *out) {
  const tables &t = static_cast<const tables &>(*b.table);
  size_t done = 0;
  if (lanes > 1 && b.many >= lanes) {
    arr<cmplx<wide>> work(b.n);
    for (; done + lanes <= b.many; done += lanes, in += 2*b.in_distance*static_cast<std::ptrdiff_t>(lanes),
                                   out += 2*b.out_distance*static_cast<std::ptrdiff_t>(lanes))
      run_complex<wide>(b, t, work.data(), in, out, lanes);
  }
  if (done == b.many) return;
  arr<cmplx<double>> work(b.n);
  for (; done < b.many; ++done, in += 2*b.in_distance, out += 2*b.out_distance)
    run_complex<double>(b, t, work.data(), in, out, 1);
}

}  // namespace LANES
