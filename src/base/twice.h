/* Include a file of loops, LOOPS, twice: for all processors and for those with AVX2; see lanes.h. The name is relative to this
 * folder */
#define OF(name) name##_anywhere
#define TARGET
#define ROOTS ROOTS_ONE_BY_ONE
#include LOOPS
#undef OF
#undef TARGET
#undef ROOTS

#ifdef __x86_64__
#define OF(name) name##_avx2
#define TARGET __attribute__((target("avx2")))
#define ROOTS(v) ((four)_mm256_sqrt_pd((__m256d)(v)))
#include LOOPS
#undef OF
#undef TARGET
#undef ROOTS
#endif
#undef LOOPS
