/* Sums of src/tables/sums.c, of all kinds of processors that this one can be, against plain loops */
#include "sums.c"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { ROW = 5 * VALUES, PLANE = 6 * ROW, BLOCK = 7 * PLANE, BLOCKS = ORDER * ORDER, SUMS = 3 * STRETCH };

static double any_number(void) { return 2.0 * rand() / RAND_MAX - 1.0; }

/* As they are defined: the stretch, and its derivatives by x and y */
static void plain(const stretches *s, double *sums) {
  memset(sums, 0, SUMS * sizeof *sums);
  for (int l = 0; l < s->blocks; l++)
    for (int i = 0; i < ORDER; i++)
      for (int j = 0; j < ORDER; j++)
        for (int k = 0; k < STRETCH; k++) {
          const double value = s->weight[l] * s->coefficients[s->start[l] + i * s->plane + j * s->row + k];
          sums[k] += s->x[i] * s->y[j] * value;
          sums[STRETCH + k] += s->slope_x[i] * s->y[j] * value;
          sums[2 * STRETCH + k] += s->x[i] * s->slope_y[j] * value;
        }
}

/* Numbers that differ by more than round-off, the first `count` of which are compared */
static int differences(const double *found, const double *right, int count) {
  int wrong = 0;
  for (int k = 0; k < count; k++) wrong += !(fabs(found[k] - right[k]) <= 1e-13);
  return wrong;
}

static int wrong_ones(void (*sum)(const stretches *, double *), const stretches *s) {
  double right[SUMS], found[SUMS];
  stretches without = *s;
  int wrong;
  plain(s, right);
  sum(s, found);
  wrong = differences(found, right, SUMS);
  /* without slopes nothing is written to their array */
  without.slope_x = without.slope_y = NULL;
  for (int k = 0; k < SUMS; k++) found[k] = 77.0;
  sum(&without, found);
  wrong += differences(found, right, STRETCH);
  for (int k = STRETCH; k < SUMS; k++) wrong += found[k] != 77.0;
  return wrong;
}

int main(void) {
  static float coefficients[BLOCK * BLOCKS];
  int start[BLOCKS], wrong = 0;
  double weight[BLOCKS], along[4][ORDER];
  for (int k = 0; k < BLOCK * BLOCKS; k++) coefficients[k] = (float)any_number();
  for (int turn = 0; turn < 200; turn++) {
    const int blocks[] = {1, ORDER, BLOCKS};
    for (int l = 0; l < BLOCKS; l++) {
      /* any alignment, so that addresses are not multiples of a register */
      start[l] = l * BLOCK + rand() % (BLOCK - (ORDER - 1) * (PLANE + ROW) - STRETCH + 1);
      weight[l] = any_number();
    }
    for (int k = 0; k < 4 * ORDER; k++) along[k / ORDER][k % ORDER] = any_number();
    stretches s = {coefficients, blocks[turn % 3], start, weight, ROW, PLANE, along[0], along[1], along[2], along[3]};
    wrong += wrong_ones(sum_by_twos, &s);
    if (has_fours()) wrong += wrong_ones(sum_by_fours, &s);
  }
  printf("%d wrong sums, %s\n", wrong, has_fours() ? "by twos and by fours" : "by twos only");
  return wrong != 0;
}
