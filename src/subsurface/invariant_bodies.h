/* Loops of invariant_loops.c for one kind of processor; see lanes.h */

#define INLINE TARGET static inline __attribute__((always_inline))

/* Larger and smaller of two numbers; the second if either is not a number */
#define LARGER(a, b) CHOOSE((a) > (b), a, b)
#define SMALLER(a, b) CHOOSE((a) < (b), a, b)
/* Is an entry pq too small to change the eigenvalues? It changes them by its square divided by the difference of the diagonal, and
 * at most by its own magnitude */
#define IS_SMALL(pp, qq, pq) ((MAGNITUDES(pq) < CONVERGED) | ((pq) * (pq) < CONVERGED * MAGNITUDES((pp) - (qq))))

/* Rotate away entry pq of symmetric matrices with entries pp, qq, and pr, qr in the third row */
INLINE void OF(rotate)(four *pp, four *qq, four *pq, four *pr, four *qr) {
  const four one = {1.0, 1.0, 1.0, 1.0}, theta = 0.5 * (*qq - *pp), root = ROOTS(theta * theta + *pq * *pq);
  const four divisor = theta + CHOOSE(theta < 0.0, -root, root);
  /* a divisor of zero belongs to a negligible entry; a division by it would be an exception */
  const four t = WHERE(~(MAGNITUDES(*pq) < NEGLIGIBLE), *pq / CHOOSE(divisor == 0.0, one, divisor));
  const four c = one / ROOTS(one + t * t), s = t * c, row = *pr;
  *pp -= t * *pq;
  *qq += t * *pq;
  *pq = (four){0.0, 0.0, 0.0, 0.0};
  *pr = c * row - s * *qr;
  *qr = s * row + c * *qr;
}

/* Principal values of four symmetric matrices xx, xy, xz, yy, yz, zz, in descending order, by Jacobi rotations */
INLINE void OF(principal)(const four *stress, four *values) {
  const four zero = {0.0, 0.0, 0.0, 0.0}, one = {1.0, 1.0, 1.0, 1.0};
  four scale = MAGNITUDES(stress[0]), a[6], low, high;
  for (int k = 1; k < 6; k++) {
    const four other = MAGNITUDES(stress[k]);
    scale = LARGER(scale, other);
  }
  scale = CHOOSE(scale == zero, one, scale);
  for (int k = 0; k < 6; k++) a[k] = stress[k] / scale;
  for (int sweep = 0; sweep < MOST_SWEEPS; sweep++) {
    const four_masks done = IS_SMALL(a[0], a[3], a[1]) & IS_SMALL(a[0], a[5], a[2]) & IS_SMALL(a[3], a[5], a[4]);
    if (ALL_OF(done)) break;
    OF(rotate)(a, a + 3, a + 1, a + 2, a + 4);
    OF(rotate)(a, a + 5, a + 2, a + 1, a + 4);
    OF(rotate)(a + 3, a + 5, a + 4, a + 1, a + 2);
  }
  low = SMALLER(a[0], a[3]);
  high = LARGER(a[0], a[3]);
  values[0] = LARGER(high, a[5]);
  values[1] = SMALLER(high, a[5]);
  values[1] = LARGER(low, values[1]);
  values[2] = SMALLER(low, a[5]);
  /* zeros remain zeros */
  for (int k = 0; k < 3; k++) values[k] *= scale;
}

TARGET static void OF(invariants)(int n, const double *stress, double *mean, double *mises, double *tresca,
                               double *const *principal) {
  for (int point = 0; point < n; point += 4) {
    const int here = n - point < 4 ? n - point : 4;
    four s[6] = {{0.0}}, values[3], average, equivalent, difference;
    for (int l = 0; l < here; l++)
      for (int k = 0; k < 6; k++) s[k][l] = stress[6 * (size_t)(point + l) + k];
    OF(principal)(s, values);
    average = (s[0] + s[3] + s[5]) / 3.0;
    /* from differences, which do not suffer from cancellation as the squares of the stresses do */
    equivalent = ROOTS(0.5 * ((s[0] - s[3]) * (s[0] - s[3]) + (s[3] - s[5]) * (s[3] - s[5]) + (s[5] - s[0]) * (s[5] - s[0])) +
                       3.0 * (s[1] * s[1] + s[2] * s[2] + s[4] * s[4]));
    difference = values[0] - values[2];
    for (int l = 0; l < here; l++) {
      mean[point + l] = average[l];
      mises[point + l] = equivalent[l];
      tresca[point + l] = difference[l];
      for (int k = 0; k < 3; k++) principal[k][point + l] = values[k][l];
    }
  }
}
#undef INLINE
#undef LARGER
#undef SMALLER
#undef IS_SMALL
