/* Loops of vectors.c for one kind of processor: OF(name) is the name of a function in that version, TARGET its attribute */

/* Inner product */
TARGET static double OF(inner)(int n, const double *a, const double *b) {
  four even = {0.0}, odd = {0.0};
  int k = 0;
  for (; k + 7 < n; k += 8) {
    even += READ_FOUR(a + k) * READ_FOUR(b + k);
    odd += READ_FOUR(a + k + 4) * READ_FOUR(b + k + 4);
  }
  even += odd;
  double sum = SUM_OF(even);
  for (; k < n; k++) sum += a[k] * b[k];
  return sum;
}

/* b := b + factor a */
TARGET static void OF(add)(int n, double factor, const double *a, double *b) {
  int k = 0;
  for (; k + 7 < n; k += 8) {
    FOUR(b + k) += factor * READ_FOUR(a + k);
    FOUR(b + k + 4) += factor * READ_FOUR(a + k + 4);
  }
  for (; k < n; k++) b[k] += factor * a[k];
}
