/* Loops of src/fft/lines.c, of all kinds of processors that this one can be, against their definition, and against each other */
#include "lines.c"

#include <complex.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Longest line, one more number of which on either side must stay as it is */
enum { LONGEST = 19, ROOM = LONGEST, GUARD = 1 };

typedef struct {
  double complex a[ROOM + 2 * GUARD];
} buffers;

typedef struct {
  void (*one)(int, const double *, double *);
  void (*pair)(int, const double *, const double *, const double *, double *);
  void (*turn_pair)(int, const double *, double *);
} loops;

static double complex factor[LONGEST];
static double xx[LONGEST], yy[LONGEST], xy[LONGEST];

static double any_number(void) { return 2.0 * rand() / RAND_MAX - 1.0; }

static double complex any_complex(void) {
  const double re = any_number(), im = any_number();
  return re + I * im;
}

static double *reals(double complex *z) { return (double *)z; }

enum { ONE, PAIR, TURN_PAIR, KINDS };

/* Test with n numbers; true if it takes a line of that length, as those of real rows are even or 1 */
static int takes(int kind, int n) { return kind < PAIR || n == 1 || n % 2 == 0; }

static void try_loop(const loops *l, int kind, int n, buffers *z) {
  double *a = reals(z->a + GUARD);
  switch (kind) {
    case ONE: l->one(n, xx, a); break;
    case PAIR: l->pair(n, xx, yy, xy, a); break;
    default: l->turn_pair(n, reals(factor), a); break;
  }
}

/* The same by the definition */
static void define(int kind, int n, buffers *z) {
  const buffers from = *z;
  const double complex *a = from.a + GUARD;
  double complex *to_a = z->a + GUARD;
  for (int k = 0; k < n; k++) {
    const int back = (n - k) % n, at = k <= n / 2 ? k : back;
    switch (kind) {
      case ONE: to_a[k] = xx[k] * a[k]; break;
      case PAIR: to_a[k] = 0.5 * (xx[at] + yy[at]) * a[k] + (0.5 * (xx[at] - yy[at]) + I * xy[at]) * conj(a[back]); break;
      default: to_a[k] = (at == k ? factor[at] : conj(factor[at])) * a[k]; break;
    }
  }
}

static int differences(const buffers *found, const buffers *right) {
  int wrong = 0;
  for (int k = 0; k < ROOM + 2 * GUARD; k++) wrong += !(cabs(found->a[k] - right->a[k]) <= 1e-14);
  return wrong;
}

int main(void) {
  const loops anywhere = {one_anywhere, pair_anywhere, turn_pair_anywhere};
  int wrong = 0, unlike = 0, tried = 0, wide = 0;
#ifdef __x86_64__
  const loops avx2 = {one_avx2, pair_avx2, turn_pair_avx2};
  wide = __builtin_cpu_supports("avx2");
#endif
  for (int n = 1; n < LONGEST; n++)
    for (int kind = 0; kind < KINDS; kind++) {
      buffers start, right, found;
      if (!takes(kind, n)) continue;
      for (int k = 0; k < LONGEST; k++) {
        xx[k] = any_number();
        yy[k] = any_number();
        xy[k] = any_number();
        factor[k] = any_complex();
      }
      /* of real lines the first number is real, and that of half the length */
      factor[0] = creal(factor[0]);
      factor[n / 2] = creal(factor[n / 2]);
      for (int k = 0; k < ROOM + 2 * GUARD; k++) start.a[k] = any_complex();
      right = found = start;
      define(kind, n, &right);
      try_loop(&anywhere, kind, n, &found);
      wrong += differences(&found, &right);
      tried++;
#ifdef __x86_64__
      if (wide) {
        buffers other = start;
        try_loop(&avx2, kind, n, &other);
        unlike += memcmp(&other, &found, sizeof found) != 0;
      }
#endif
    }
  printf("%d lines, %d wrong numbers, %d other with AVX2%s\n", tried, wrong, unlike, wide ? "" : ", which is not here");
  return wrong != 0 || unlike != 0;
}
