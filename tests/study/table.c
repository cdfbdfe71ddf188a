/* Forces of a table for creepages that are read, and the time of a look-up: study_table_c TABLE FN MU GG AA BNEG BPOS < creepages */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "contact.h"

enum { CALLS = 200000 };

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

int main(int count, char **words) {
  char message[500];
  contact_table_patch patch;
  double creepage[3], force[3], other[3], slopes[3][3], sum = 0.0, unit[3], begun;
  contact_table *table;
  int k;

  if (count != 8) return 2;
  table = contact_table_open(words[1], message, (int)sizeof message);
  if (!table) {
    fprintf(stderr, "%s\n", message);
    return 1;
  }
  patch.fn = atof(words[2]);
  patch.mu = atof(words[3]);
  patch.gg = atof(words[4]);
  patch.aa = atof(words[5]);
  patch.bneg = atof(words[6]);
  patch.bpos = atof(words[7]);
  while (scanf("%lf %lf %lf", &creepage[0], &creepage[1], &creepage[2]) == 3) {
    if (contact_table_force(table, &patch, creepage, force) != CONTACT_TABLE_INSIDE) return 3;
    if (contact_table_force_derivatives(table, &patch, creepage, other, slopes) != CONTACT_TABLE_INSIDE) return 4;
    for (k = 0; k < 3; k++) {
      if (!(fabs(force[k] - other[k]) <= 1e-13 * patch.mu * patch.fn * (k == 2 ? patch.aa : 1.0))) return 5;
    }
    printf("%.17g %.17g %.17g\n", force[0], force[1], force[2]);
  }
  /* creepages of a random walk, as in a vehicle, and random ones of the whole table */
  unit[0] = unit[1] = patch.mu * patch.fn / (patch.gg * patch.aa * patch.bpos);
  unit[2] = unit[0] / patch.aa;
  begun = now();
  for (k = 0; k < CALLS; k++) {
    creepage[0] = unit[0] * (k % 1000) / 1000.0;
    creepage[1] = unit[1] * (k % 777) / 1000.0;
    creepage[2] = unit[2] * (k % 333) / 1000.0;
    sum += contact_table_force(table, &patch, creepage, force) + force[0];
  }
  fprintf(stderr, "force %.1f ns\n", 1e9 * (now() - begun) / CALLS);
  begun = now();
  for (k = 0; k < CALLS; k++) {
    creepage[0] = unit[0] * (rand() / (double)RAND_MAX * 20.0 - 10.0);
    creepage[1] = unit[1] * (rand() / (double)RAND_MAX * 20.0 - 10.0);
    creepage[2] = unit[2] * (rand() / (double)RAND_MAX * 20.0 - 10.0);
    sum += contact_table_force_derivatives(table, &patch, creepage, force, slopes) + slopes[0][0];
  }
  fprintf(stderr, "derivatives at random points %.1f ns%s\n", 1e9 * (now() - begun) / CALLS, sum == 0.0 ? "." : "");
  contact_table_close(table);
  return 0;
}
