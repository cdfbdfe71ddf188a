/* Vectors of four numbers for loops that are compiled twice: for all processors, and for those with AVX2, selected at run time.
 * Both versions give identical digits. The vector types are extensions of GCC and Clang.
 *
 * A file of loops is included through twice.h by the file that defines their entry points. OF(name) is the name of a function
 * in that version, TARGET its attribute; ROOTS takes four square roots. */
#ifndef CONTACT_LANES_H
#define CONTACT_LANES_H
#include <math.h>

typedef double four __attribute__((vector_size(32), aligned(8), may_alias));
typedef double two __attribute__((vector_size(16), aligned(8), may_alias));
typedef long long four_masks __attribute__((vector_size(32), aligned(8), may_alias));
typedef int four_flags __attribute__((vector_size(16), aligned(4), may_alias));

#define FOUR(at) (*(four *)(at))
#define READ_FOUR(at) (*(const four *)(at))

/* Two numbers, each repeated for both parts of a complex number; real and imaginary parts of two complex numbers swapped */
#define EACH_TWICE(at) __builtin_shufflevector(*(const two *)(at), *(const two *)(at), 0, 0, 1, 1)
#define PARTS_SWAPPED(v) __builtin_shufflevector(v, v, 1, 0, 3, 2)

/* Numbers where a mask is set, else 0, or other numbers */
#define WHERE(mask, v) ((four)((mask) & (four_masks)(v)))
#define CHOOSE(mask, v, w) ((four)(((mask) & (four_masks)(v)) | (~(mask) & (four_masks)(w))))
/* Mask from Fortran logicals */
#define TRUE_OF(at) (__builtin_convertvector(*(const four_flags *)(at), four_masks) != 0)
#define ALL_OF(mask) (((mask)[0] & (mask)[1] & (mask)[2] & (mask)[3]) != 0)
#define SUM_OF(v) (((v)[0] + (v)[2]) + ((v)[1] + (v)[3]))
#define MAGNITUDES(v) ((four)((four_masks)(v)&0x7fffffffffffffffLL))
#define ROOTS_ONE_BY_ONE(v) ((four){sqrt((v)[0]), sqrt((v)[1]), sqrt((v)[2]), sqrt((v)[3])})

#ifdef __x86_64__
#include <immintrin.h>
#define CALL(name, ...) (__builtin_cpu_supports("avx2") ? name##_avx2(__VA_ARGS__) : name##_anywhere(__VA_ARGS__))
#else
#define CALL(name, ...) name##_anywhere(__VA_ARGS__)
#endif
#endif
