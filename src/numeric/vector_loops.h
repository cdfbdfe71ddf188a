/* Loops of vectors.c, for one kind of processor: OF(name) is what a function is called there, TARGET its attribute */

/* Inner product */
TARGET static double OF(inner)(int n, const double *a, const double *b) {
  four sums = {0.0, 0.0, 0.0, 0.0};
  int k = 0;
  for (; k + 3 < n; k += 4) sums += READ_FOUR(a + k) * READ_FOUR(b + k);
  double sum = SUM_OF(sums);
  for (; k < n; k++) sum += a[k] * b[k];
  return sum;
}

/* b := b + factor a */
TARGET static void OF(add)(int n, double factor, const double *a, double *b) {
  int k = 0;
  for (; k + 3 < n; k += 4) FOUR(b + k) += factor * READ_FOUR(a + k);
  for (; k < n; k++) b[k] += factor * a[k];
}

/* b := b + factor a, and then its inner product with c */
TARGET static double OF(add_and_multiply)(int n, double factor, const double *a, double *b, const double *c) {
  four sums = {0.0, 0.0, 0.0, 0.0};
  int k = 0;
  for (; k + 3 < n; k += 4) {
    const four changed = READ_FOUR(b + k) + factor * READ_FOUR(a + k);
    FOUR(b + k) = changed;
    sums += READ_FOUR(c + k) * changed;
  }
  double sum = SUM_OF(sums);
  for (; k < n; k++) {
    b[k] += factor * a[k];
    sum += c[k] * b[k];
  }
  return sum;
}
#undef OF
#undef TARGET
