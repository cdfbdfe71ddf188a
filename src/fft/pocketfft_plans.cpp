// Plans of pocketfft for contact_fft_library
//
// What they need is asked for by malloc of this object, to which the guard of base/guard.c attends (C++14: later standards have a
// function of their own). What operator new throws is caught, and left to the guard as well.
#include "pocketfft_plans.hpp"

#include <memory>

extern "C" [[noreturn]] void contact_guard_without_memory();

namespace {

#ifdef CONTACT_HAS_AVX2
bool has_avx2() { return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"); }
#else
bool has_avx2() { return false; }
namespace no_avx2 {
plan_tables *new_tables(size_t) { return nullptr; }
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

struct plan {
  batch step;
  std::unique_ptr<plan_tables> table;
};

// The guard is left to behind the handler, where the exception is gone
template <typename work>
auto or_end(work &&does) -> decltype(does()) {
  try {
    return does();
  } catch (...) {
  }
  contact_guard_without_memory();
}

}  // namespace

// Complex values are pairs of real ones
extern "C" {

void *contact_pocketfft_complex(int n, int many, double *, int stride, int distance, double *, int to_stride, int to_distance, int sign) {
  return or_end([&]() -> void * {
    const size_t length = static_cast<size_t>(n);
    std::unique_ptr<plan> p(new plan);
    p->table.reset(has_avx2() ? avx2::new_tables(length) : portable::new_tables(length));
    p->step = {sign < 0, length, static_cast<size_t>(many), stride, distance, to_stride, to_distance, p->table.get()};
    return p.release();
  });
}

void contact_pocketfft_run_complex(const void *p, const double *in, double *out) {
  or_end([&] { run(static_cast<const plan *>(p)->step, in, out); });
}

void contact_pocketfft_destroy(void *p) { delete static_cast<plan *>(p); }
}
