// Plans of pocketfft for contact_fft_library
//
// What they need is asked for by malloc of this object, to which the guard of base/guard.c attends (C++14: later standards have a
// function of their own). Where pocketfft would throw, the process would end, to which the guard attends as well.
#include "pocketfft_plans.hpp"

#include <cstdlib>
#include <memory>
#include <vector>

namespace {

#ifdef CONTACT_HAS_AVX2
bool has_avx2() { return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"); }
#else
bool has_avx2() { return false; }
namespace no_avx2 {
plan_tables *new_tables(transform_kind, size_t) { return nullptr; }
void run(const batch &, const double *, double *) {}
}
namespace avx2 = no_avx2;
#endif

void run(const batch &b, const double *in, double *out) {
  if (has_avx2())
    avx2::run(b, in, out);
  else
    portable::run(b, in, out);
}

// The transform of a plane has two steps: its rows, and then the columns of the spectrum
struct plan {
  std::vector<batch> steps;
  std::vector<std::unique_ptr<plan_tables>> tables;
};

void add(plan &p, transform_kind what, bool forward, int n, int many, int in_stride, int in_distance, int out_stride, int out_distance) {
  const size_t length = static_cast<size_t>(n);
  p.tables.emplace_back(has_avx2() ? avx2::new_tables(what, length) : portable::new_tables(what, length));
  p.steps.push_back({what, forward, length, static_cast<size_t>(many), in_stride, in_distance, out_stride, out_distance,
                     p.tables.back().get()});
}

template <typename work>
auto or_end(work &&does) -> decltype(does()) {
  try {
    return does();
  } catch (...) {
    std::abort();
  }
}

void *one_step(transform_kind what, bool forward, int n, int many, int in_stride, int in_distance, int out_stride, int out_distance) {
  return or_end([&]() -> void * {
    std::unique_ptr<plan> p(new plan);
    add(*p, what, forward, n, many, in_stride, in_distance, out_stride, out_distance);
    return p.release();
  });
}

void execute(const void *p, const double *in, double *out) {
  or_end([&] {
    const double *from = in;
    for (const batch &step : static_cast<const plan *>(p)->steps) {
      run(step, from, out);
      from = out;
    }
  });
}

}  // namespace

// Complex values are pairs of real ones
extern "C" {

void *contact_pocketfft_complex(int n, int many, double *, int stride, int distance, double *, int to_stride, int to_distance, int sign) {
  return one_step(transform_kind::complex, sign < 0, n, many, stride, distance, to_stride, to_distance);
}

void *contact_pocketfft_forward(int n, int many, double *, int stride, int distance, double *, int to_stride, int to_distance) {
  return one_step(transform_kind::forward, true, n, many, stride, distance, to_stride, to_distance);
}

void *contact_pocketfft_backward(int n, int many, double *, int stride, int distance, double *, int to_stride, int to_distance) {
  return one_step(transform_kind::backward, false, n, many, stride, distance, to_stride, to_distance);
}

void *contact_pocketfft_plane(int rows, int columns, double *, double *) {
  return or_end([&]() -> void * {
    std::unique_ptr<plan> p(new plan);
    const int kept = columns/2 + 1;
    add(*p, transform_kind::forward, true, columns, rows, 1, columns, 1, kept);
    add(*p, transform_kind::complex, true, rows, kept, kept, 1, kept, 1);
    return p.release();
  });
}

void contact_pocketfft_run_complex(const void *p, const double *in, double *out) { execute(p, in, out); }
void contact_pocketfft_run_forward(const void *p, const double *in, double *out) { execute(p, in, out); }
void contact_pocketfft_run_backward(const void *p, const double *in, double *out) { execute(p, in, out); }
void contact_pocketfft_destroy(void *p) { delete static_cast<plan *>(p); }
}
