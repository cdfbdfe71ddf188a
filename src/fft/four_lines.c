/* Complex transforms of four lines at once, described in four_lines.f90.
 *
 * A line of n = r1 r2 ... numbers is transformed in place, one step per factor. Forward, the first step divides it into r1 lines of
 * n/r1 numbers each, and so on, which leaves the frequencies in permuted positions; back, the steps are done in reverse order, and
 * the results are in their natural order. All steps do the same to the numbers of four lines, which are therefore interleaved. The
 * transform back is one of exchanged real and imaginary parts. If half of a line is zero on entry, or not needed on exit, the
 * first or last step takes this into account.
 *
 * Unlike the loops of lanes.h, these use multiplications with additions where they are available: their last digits depend on the
 * processor, as those of FFTW do. */
#include "../base/lanes.h"
#include <stdint.h>
#include <string.h>

/* Rows that are transformed at once, two in a line; largest factor of a length with a step of its own */
enum { ROWS = 8, LARGEST = 8 };

/* Kinds of steps */
enum { FORWARD, BACK, LAST_BACK };

typedef struct {
  four re, im;
} number;

/* As in four_lines.f90: length, number of steps, their factors with a final zero, and where the numbers of a step start */
enum { MOST_STEPS = 32 };
typedef struct {
  int n, count, radices[MOST_STEPS], starts[MOST_STEPS];
} line_steps;

/* With the positions of frequencies, and the factors between the steps */
typedef struct {
  const line_steps *steps;
  const int *positions;
  const double *factors;
} line_plan;

#define PAIR(at) (*(two *)(at))
#define BOTH(v, w) __builtin_shufflevector(*(const two *)(v), *(const two *)(w), 0, 1, 2, 3)
#define LOWER(v) __builtin_shufflevector(v, v, 0, 1)
#define UPPER(v) __builtin_shufflevector(v, v, 2, 3)
#define FIRST_OF_PAIRS(v, w) __builtin_shufflevector(v, w, 0, 4, 2, 6)
#define SECOND_OF_PAIRS(v, w) __builtin_shufflevector(v, w, 1, 5, 3, 7)

#define OF(name) name##_anywhere
#define TARGET
#include "four_steps.h"
#include "four_bodies.h"
#include "pair_bodies.h"
#undef OF
#undef TARGET
#ifdef __x86_64__
#define OF(name) name##_fma
#define TARGET __attribute__((target("avx2,fma")))
#include "four_steps.h"
#include "four_bodies.h"
#include "pair_bodies.h"
#undef OF
#undef TARGET
#define EITHER(name, ...) \
  (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") ? name##_fma(__VA_ARGS__) : name##_anywhere(__VA_ARGS__))
#else
#define EITHER(name, ...) name##_anywhere(__VA_ARGS__)
#endif

void contact_four_rows_forward(const line_steps *steps, const int *positions, const double *factors, int mx, int rows, int all,
                               const double *field, double *half, double *work);
void contact_four_rows_backward(const line_steps *steps, const int *positions, const double *factors, int mx, int rows, int all,
                                const double *half, double *field, double *work);
void contact_four_columns_forward(const line_steps *steps, const int *positions, const double *factors, int my, int columns,
                                  const double *half, double *spectrum, double *work);
void contact_four_columns_backward(const line_steps *steps, const int *positions, const double *factors, int my, int columns,
                                   const double *spectrum, double *half, double *work);
void contact_four_columns_one(const line_steps *steps, const int *positions, const double *factors, int my, int columns,
                              const double *xx, double *half, double *work);
void contact_four_columns_two(const line_steps *steps, const int *positions, const double *factors, int my, int columns,
                              const double *xx, const double *yy, const double *xy, const double *turn, double *half,
                              double *work);
void contact_four_pair(const line_steps *x_steps, const int *x_positions, const double *x_factors, const line_steps *y_steps,
                       const int *y_positions, const double *y_factors, const int *places, int mx, int my, int ahead,
                       const double *mean, const double *difference, const double *mixed, const double *fields, double *products,
                       double *half, double *work);

/* Start of a line of the cache within the work space, which has room for it */
static double *aligned(double *work) { return (double *)(((uintptr_t)work + 63) / 64 * 64); }

void contact_four_rows_forward(const line_steps *steps, const int *positions, const double *factors, int mx, int rows, int all,
                               const double *field, double *half, double *work) {
  const line_plan plan = {steps, positions, factors};
  EITHER(rows_forward, &plan, mx, rows, all, field, half, aligned(work));
}

void contact_four_rows_backward(const line_steps *steps, const int *positions, const double *factors, int mx, int rows, int all,
                                const double *half, double *field, double *work) {
  const line_plan plan = {steps, positions, factors};
  EITHER(rows_backward, &plan, mx, rows, all, half, field, aligned(work));
}

void contact_four_columns_forward(const line_steps *steps, const int *positions, const double *factors, int my, int columns,
                                  const double *half, double *spectrum, double *work) {
  const line_plan plan = {steps, positions, factors};
  EITHER(columns_forward, &plan, my, columns, half, spectrum, aligned(work));
}

void contact_four_columns_backward(const line_steps *steps, const int *positions, const double *factors, int my, int columns,
                                   const double *spectrum, double *half, double *work) {
  const line_plan plan = {steps, positions, factors};
  EITHER(columns_backward, &plan, my, columns, spectrum, half, aligned(work));
}

void contact_four_columns_one(const line_steps *steps, const int *positions, const double *factors, int my, int columns,
                              const double *xx, double *half, double *work) {
  const line_plan plan = {steps, positions, factors};
  EITHER(columns_one, &plan, my, columns, xx, half, aligned(work));
}

void contact_four_columns_two(const line_steps *steps, const int *positions, const double *factors, int my, int columns,
                              const double *xx, const double *yy, const double *xy, const double *turn, double *half,
                              double *work) {
  const line_plan plan = {steps, positions, factors};
  const double *const block[3] = {xx, yy, xy};
  EITHER(columns_two, &plan, my, columns, block, turn, half, aligned(work));
}

void contact_four_pair(const line_steps *x_steps, const int *x_positions, const double *x_factors, const line_steps *y_steps,
                       const int *y_positions, const double *y_factors, const int *places, int mx, int my, int ahead,
                       const double *mean, const double *difference, const double *mixed, const double *fields, double *products,
                       double *half, double *work) {
  const line_plan along_x = {x_steps, x_positions, x_factors}, along_y = {y_steps, y_positions, y_factors};
  const double *const block[3] = {mean, difference, mixed};
  EITHER(pair, &along_x, &along_y, places, mx, my, ahead, block, fields, products, half, aligned(work));
}
