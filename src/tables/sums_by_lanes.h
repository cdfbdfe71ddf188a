/* A function of sums.c for registers of LANES numbers; SUM is its name, WIDENED converts this number of values to double
 * precision */
static void SUM(const stretches *s, double *sums) {
  typedef double part __attribute__((vector_size(LANES * sizeof(double))));
  enum { PARTS = STRETCH / LANES };
  /* the row of nodes summed over all other axes, and its slopes along x and y */
  part whole[PARTS] = {{0.0}}, by_x[PARTS] = {{0.0}}, by_y[PARTS] = {{0.0}};
  for (int i = 0; i < ORDER; i++) {
    part along[PARTS] = {{0.0}}, slope[PARTS] = {{0.0}};
    for (int j = 0; j < ORDER; j++) {
      /* over blocks: stays in registers until all of them are in it */
      part near[PARTS] = {{0.0}};
      const float *from = s->coefficients + i * s->plane + j * s->row;
      for (int l = 0; l < s->blocks; l++) {
        const float *values = from + s->start[l];
        for (int k = 0; k < PARTS; k++) near[k] += s->weight[l] * (part)WIDENED(values + k * LANES);
      }
      for (int k = 0; k < PARTS; k++) along[k] += s->y[j] * near[k];
      if (s->slope_y) {
        for (int k = 0; k < PARTS; k++) slope[k] += s->slope_y[j] * near[k];
      }
    }
    for (int k = 0; k < PARTS; k++) whole[k] += s->x[i] * along[k];
    if (s->slope_x && s->slope_y) {
      for (int k = 0; k < PARTS; k++) {
        by_x[k] += s->slope_x[i] * along[k];
        by_y[k] += s->x[i] * slope[k];
      }
    }
  }
  memcpy(sums, whole, sizeof whole);
  if (s->slope_x && s->slope_y) {
    memcpy(sums + STRETCH, by_x, sizeof by_x);
    memcpy(sums + 2 * STRETCH, by_y, sizeof by_y);
  }
}
#undef SUM
#undef LANES
#undef WIDENED
