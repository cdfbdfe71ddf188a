/* Both versions of src/fft/four_lines.c, for all processors and for those with FMA, against the definition of a transform and its
 * inverse: all factors, with half and more of a line given and count_out */
#include "four_lines.c"

#include <complex.h>
#include <stdio.h>
#include <stdlib.h>

enum { LONGEST = 120, KINDS = 2 };

static double complex line[4][LONGEST], right[4][LONGEST];
static double x[8 * LONGEST], y[8 * LONGEST], back[8 * LONGEST], factors[4 * LONGEST];
static int positions[LONGEST];

/* Steps as they are prepared in four_lines.f90, for factors in any order */
static line_steps prepare(const int *radices) {
  line_steps steps = {1, 0, {0}, {0}};
  int at = 0, length;
  for (; radices[steps.count] > 0; steps.count++) {
    steps.radices[steps.count] = radices[steps.count];
    steps.n *= radices[steps.count];
  }
  length = steps.n;
  for (int k = 0; k < steps.count; k++) {
    const int r = radices[k];
    steps.starts[k] = at;
    for (int p = 0; p < length / r; p++)
      for (int j = 1; j < r; j++) {
        const double angle = 2.0 * acos(-1.0) * p * j / length;
        factors[at++] = cos(angle);
        factors[at++] = -sin(angle);
      }
    for (int j = 0; j < r && r > LARGEST; j++) {
      factors[at++] = cos(2.0 * acos(-1.0) * j / r);
      factors[at++] = -sin(2.0 * acos(-1.0) * j / r);
    }
    length /= r;
  }
  for (int f = 0; f < steps.n; f++) {
    int rest = f;
    positions[f] = 0;
    length = steps.n;
    for (int k = 0; k < steps.count; k++) {
      length /= radices[k];
      positions[f] += length * (rest % radices[k]);
      rest /= radices[k];
    }
  }
  return steps;
}

static void forward(int kind, const line_plan *plan, int used) {
#ifdef __x86_64__
  if (kind) {
    transform_fma(plan, x, x, y, used);
    return;
  }
#endif
  (void)kind;
  transform_anywhere(plan, x, x, y, used);
}

static void backward(int kind, const line_plan *plan, int count_out) {
#ifdef __x86_64__
  if (kind) {
    transform_back_fma(plan, x, back, y, count_out);
    return;
  }
#endif
  (void)kind;
  transform_back_anywhere(plan, x, back, y, count_out);
}

/* Largest error of transforms forward and back of lines with some numbers given */
static double error_of(int kind, const line_plan *plan, int used) {
  const int n = plan->steps->n;
  double error = 0.0;
  for (int k = 0; k < n; k++)
    for (int l = 0; l < 4; l++) {
      line[l][k] = k < used ? rand() / (double)RAND_MAX + I * rand() / (double)RAND_MAX : 0.0;
      /* data beyond the given ones are not read */
      x[8 * k + l] = k < used ? creal(line[l][k]) : NAN;
      x[8 * k + 4 + l] = k < used ? cimag(line[l][k]) : NAN;
    }
  for (int l = 0; l < 4; l++)
    for (int f = 0; f < n; f++) {
      right[l][f] = 0.0;
      for (int k = 0; k < used; k++) right[l][f] += line[l][k] * cexp(-2.0 * acos(-1.0) * I * (k * f % n) / n);
    }
  forward(kind, plan, used);
  for (int f = 0; f < n; f++)
    for (int l = 0; l < 4; l++) {
      double *at = x + 8 * positions[f] + l, keep = at[0];
      const double here = cabs(at[0] + I * at[4] - right[l][f]);
      if (!(here <= error)) error = here;
      at[0] = at[4];
      at[4] = keep;
    }
  backward(kind, plan, used);
  for (int k = 0; k < used; k++)
    for (int l = 0; l < 4; l++) {
      const double here = cabs((back[8 * k + l] + I * back[8 * k + 4 + l]) / n - line[l][k]);
      if (!(here <= error)) error = here;
    }
  return error;
}

int main(void) {
  const int all[][5] = {{0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}, {7, 0}, {8, 0}, {11, 0}, {4, 3, 5, 2, 0}, {3, 4, 8, 0}, {5, 4, 3, 0},
                        {8, 7, 2, 0}, {7, 4, 0}, {2, 11, 5, 0}, {4, 4, 4, 0}};
  int wrong = 0, tried = 0, kinds = 1;
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) kinds = KINDS;
#endif
  for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
    const line_steps steps = prepare(all[k]);
    const line_plan plan = {&steps, positions, factors};
    for (int used = 1; used <= steps.n; used += 1 + steps.n / 24)
      for (int kind = 0; kind < kinds; kind++) {
        wrong += !(error_of(kind, &plan, used) <= 2e-15 * (steps.n + 10));
        tried++;
      }
  }
  printf("%d transforms, %d wrong, %d versions\n", tried, wrong, kinds);
  return wrong != 0;
}
