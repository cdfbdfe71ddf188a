/* Loops of gradient_loops.c, for one kind of processor; see lanes.h. Each ends with the remaining elements, up to three */

/* Sum of h + u where p is positive, and the number of these elements */
TARGET static void OF(gap_sums)(int n, const double *h, const double *u, const double *p, double *total) {
  four sums = {0.0}, counts = {0.0};
  const four ones = {1.0, 1.0, 1.0, 1.0};
  int k = 0;
  for (; k + 3 < n; k += 4) {
    const four_masks loaded = READ_FOUR(p + k) > 0.0;
    sums += WHERE(loaded, READ_FOUR(h + k) + READ_FOUR(u + k));
    counts += WHERE(loaded, ones);
  }
  double sum = SUM_OF(sums), count = SUM_OF(counts);
  for (; k < n; k++) {
    if (!(p[k] > 0.0)) continue;
    sum += h[k] + u[k];
    count += 1.0;
  }
  total[0] = sum;
  total[1] = count;
}

/* r = pen - h - u, set to 0 where negative and p is not positive; the largest magnitude, NaN if one is NaN */
TARGET static double OF(residuals)(int n, double pen, const double *h, const double *u, const double *p, double *r) {
  four largest = {0.0};
  int k = 0;
  for (; k + 3 < n; k += 4) {
    const four all = pen - READ_FOUR(h + k) - READ_FOUR(u + k);
    const four one = WHERE((READ_FOUR(p + k) > 0.0) | ~(all < 0.0), all), size = MAGNITUDES(one);
    FOUR(r + k) = one;
    largest = CHOOSE((size <= largest) | (largest != largest), largest, size);
  }
  double worst = 0.0;
  for (int i = 0; i < 4; i++) worst = largest[i] <= worst || worst != worst ? worst : largest[i];
  for (; k < n; k++) {
    r[k] = pen - h[k] - u[k];
    if (!(p[k] > 0.0) && r[k] < 0.0) r[k] = 0.0;
    worst = fabs(r[k]) <= worst || worst != worst ? worst : fabs(r[k]);
  }
  return worst;
}

/* free = 1 where p or r is positive and h is not too large, else 0; r is set to 0 there too */
TARGET static void OF(choose_free)(int n, const double *p, const double *h, double highest, double *free, double *r) {
  const four ones = {1.0, 1.0, 1.0, 1.0};
  int k = 0;
  for (; k + 3 < n; k += 4) {
    const four_masks is_free = ((READ_FOUR(p + k) > 0.0) | (READ_FOUR(r + k) > 0.0)) & (READ_FOUR(h + k) < highest);
    FOUR(free + k) = WHERE(is_free, ones);
    FOUR(r + k) = WHERE(is_free, READ_FOUR(r + k));
  }
  for (; k < n; k++) {
    free[k] = (p[k] > 0.0 || r[k] > 0.0) && h[k] < highest ? 1.0 : 0.0;
    if (!(free[k] > 0.0)) r[k] = 0.0;
  }
}

/* Sum of v over the free elements, and their number */
TARGET static void OF(free_sums)(int n, const double *free, const double *v, double *total) {
  four sums = {0.0}, counts = {0.0};
  int k = 0;
  for (; k + 3 < n; k += 4) {
    sums += WHERE(READ_FOUR(free + k) > 0.0, READ_FOUR(v + k));
    counts += READ_FOUR(free + k);
  }
  double sum = SUM_OF(sums), count = SUM_OF(counts);
  for (; k < n; k++) {
    if (free[k] > 0.0) sum += v[k];
    count += free[k];
  }
  total[0] = sum;
  total[1] = count;
}

/* v := v - mean in free elements, 0 in the others; its products with r and s */
TARGET static void OF(project)(int n, const double *free, double mean, double *v, const double *r, const double *s, double *products) {
  four first = {0.0}, second = {0.0};
  int k = 0;
  for (; k + 3 < n; k += 4) {
    const four one = WHERE(READ_FOUR(free + k) > 0.0, READ_FOUR(v + k) - mean);
    FOUR(v + k) = one;
    first += one * READ_FOUR(r + k);
    second += one * READ_FOUR(s + k);
  }
  products[0] = SUM_OF(first);
  products[1] = SUM_OF(second);
  for (; k < n; k++) {
    v[k] = free[k] > 0.0 ? v[k] - mean : 0.0;
    products[0] += v[k] * r[k];
    products[1] += v[k] * s[k];
  }
}

/* d := z + beta d, previous := r */
TARGET static void OF(turn)(int n, double beta, const double *z, const double *r, double *d, double *previous) {
  int k = 0;
  for (; k + 3 < n; k += 4) {
    FOUR(d + k) = READ_FOUR(z + k) + beta * READ_FOUR(d + k);
    FOUR(previous + k) = READ_FOUR(r + k);
  }
  for (; k < n; k++) {
    d[k] = z[k] + beta * d[k];
    previous[k] = r[k];
  }
}

/* p := p + alpha d, but at least 0; the smallest value before the limit, or 0 */
TARGET static double OF(go_along)(int n, double alpha, const double *d, double *p) {
  four lowest = {0.0};
  int k = 0;
  for (; k + 3 < n; k += 4) {
    const four one = READ_FOUR(p + k) + alpha * READ_FOUR(d + k);
    lowest = CHOOSE(one < lowest, one, lowest);
    FOUR(p + k) = WHERE(~(one < 0.0), one);
  }
  double least = 0.0;
  for (int i = 0; i < 4; i++) least = lowest[i] < least ? lowest[i] : least;
  for (; k < n; k++) {
    p[k] += alpha * d[k];
    if (p[k] < least) least = p[k];
    if (p[k] < 0.0) p[k] = 0.0;
  }
  return least;
}
