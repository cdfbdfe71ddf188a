// Transforms by pocketfft, compiled once for each set of instructions: LANES is the name of the set
//
// As many rows or columns as a register holds are transformed together; the result of a row does not depend on its neighbours.
// A plan is not changed when it is executed, so that threads may share it.
#define POCKETFFT_NO_MULTITHREADING
// a name of its own for each set, or else the linker would take the functions of one for both
#define pocketfft LANES_NAME(pocketfft_, LANES)
#define LANES_NAME(a, b) LANES_JOIN(a, b)
#define LANES_JOIN(a, b) a##b
#include <complex>
#include <memory>

#include "pocketfft/pocketfft_hdronly.h"
#include "pocketfft_plans.hpp"

namespace LANES {

using pocketfft::detail::arr;
using pocketfft::detail::cmplx;
using pocketfft::detail::pocketfft_c;
using pocketfft::detail::pocketfft_r;
using pocketfft::detail::vtype_t;

constexpr size_t lanes = pocketfft::detail::VLEN<double>::val;
using wide = vtype_t<double>;

struct tables : plan_tables {
  tables(transform_kind what, size_t n) {
    if (what == transform_kind::complex)
      of_complex.reset(new pocketfft_c<double>(n));
    else
      of_real.reset(new pocketfft_r<double>(n));
  }
  std::unique_ptr<pocketfft_c<double>> of_complex;
  std::unique_ptr<pocketfft_r<double>> of_real;
};

plan_tables *new_tables(transform_kind what, size_t n) { return new tables(what, n); }

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
  t.of_complex->exec(work, 1.0, b.forward);
  for (size_t j = 0; j < b.n; ++j)
    for (size_t k = 0; k < count; ++k) {
      double *to = out + 2*(static_cast<std::ptrdiff_t>(k)*b.out_distance + static_cast<std::ptrdiff_t>(j)*b.out_stride);
      to[0] = take(work[j].r, k);
      to[1] = take(work[j].i, k);
    }
}

// Real values to their coefficients: pocketfft gives r0 r1 i1 r2 i2 ...
template <typename V>
void run_forward(const batch &b, const tables &t, V *work, const double *in, double *out, size_t count) {
  for (size_t j = 0; j < b.n; ++j)
    for (size_t k = 0; k < count; ++k)
      put(work[j], in[static_cast<std::ptrdiff_t>(k)*b.in_distance + static_cast<std::ptrdiff_t>(j)*b.in_stride], k);
  t.of_real->exec(work, 1.0, true);
  for (size_t k = 0; k < count; ++k) {
    double *to = out + 2*static_cast<std::ptrdiff_t>(k)*b.out_distance;
    to[0] = take(work[0], k);
    to[1] = 0.0;
    for (size_t j = 1; 2*j <= b.n; ++j) {
      to += 2*b.out_stride;
      to[0] = take(work[2*j - 1], k);
      to[1] = 2*j < b.n ? take(work[2*j], k) : 0.0;
    }
  }
}

template <typename V>
void run_backward(const batch &b, const tables &t, V *work, const double *in, double *out, size_t count) {
  for (size_t k = 0; k < count; ++k) {
    const double *from = in + 2*static_cast<std::ptrdiff_t>(k)*b.in_distance;
    put(work[0], from[0], k);
    for (size_t j = 1; 2*j <= b.n; ++j) {
      from += 2*b.in_stride;
      put(work[2*j - 1], from[0], k);
      if (2*j < b.n) put(work[2*j], from[1], k);
    }
  }
  t.of_real->exec(work, 1.0, false);
  for (size_t j = 0; j < b.n; ++j)
    for (size_t k = 0; k < count; ++k)
      out[static_cast<std::ptrdiff_t>(k)*b.out_distance + static_cast<std::ptrdiff_t>(j)*b.out_stride] = take(work[j], k);
}

template <typename V>
void run_some(const batch &b, const tables &t, arr<cmplx<V>> &work, const double *in, double *out, size_t count) {
  switch (b.what) {
    case transform_kind::complex: run_complex<V>(b, t, work.data(), in, out, count); break;
    case transform_kind::forward: run_forward<V>(b, t, &work[0].r, in, out, count); break;
    case transform_kind::backward: run_backward<V>(b, t, &work[0].r, in, out, count); break;
  }
}

void run(const batch &b, const double *in, double *out) {
  const tables &t = static_cast<const tables &>(*b.table);
  const std::ptrdiff_t in_size = b.what == transform_kind::forward ? 1 : 2, out_size = b.what == transform_kind::backward ? 1 : 2;
  size_t done = 0;
  if (lanes > 1 && b.many >= lanes) {
    arr<cmplx<wide>> work(b.n);
    for (; done + lanes <= b.many; done += lanes, in += in_size*b.in_distance*static_cast<std::ptrdiff_t>(lanes),
                                   out += out_size*b.out_distance*static_cast<std::ptrdiff_t>(lanes))
      run_some<wide>(b, t, work, in, out, lanes);
  }
  if (done == b.many) return;
  arr<cmplx<double>> work(b.n);
  for (; done < b.many; ++done, in += in_size*b.in_distance, out += out_size*b.out_distance)
    run_some<double>(b, t, work, in, out, 1);
}

}  // namespace LANES
