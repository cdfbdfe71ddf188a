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

/* Inner products of four vectors, `stride` numbers apart, with one; the same digits as if they were computed separately */
TARGET static void OF(inner_four)(int n, int stride, const double *a, const double *b, double *sums) {
  const double *a0 = a, *a1 = a + stride, *a2 = a1 + stride, *a3 = a2 + stride;
  four even0 = {0.0}, even1 = {0.0}, even2 = {0.0}, even3 = {0.0}, odd0 = {0.0}, odd1 = {0.0}, odd2 = {0.0}, odd3 = {0.0};
  int k = 0;
  for (; k + 7 < n; k += 8) {
    const four even = READ_FOUR(b + k), odd = READ_FOUR(b + k + 4);
    even0 += READ_FOUR(a0 + k) * even;
    even1 += READ_FOUR(a1 + k) * even;
    even2 += READ_FOUR(a2 + k) * even;
    even3 += READ_FOUR(a3 + k) * even;
    odd0 += READ_FOUR(a0 + k + 4) * odd;
    odd1 += READ_FOUR(a1 + k + 4) * odd;
    odd2 += READ_FOUR(a2 + k + 4) * odd;
    odd3 += READ_FOUR(a3 + k + 4) * odd;
  }
  even0 += odd0;
  even1 += odd1;
  even2 += odd2;
  even3 += odd3;
  sums[0] = SUM_OF(even0);
  sums[1] = SUM_OF(even1);
  sums[2] = SUM_OF(even2);
  sums[3] = SUM_OF(even3);
  for (; k < n; k++) {
    sums[0] += a0[k] * b[k];
    sums[1] += a1[k] * b[k];
    sums[2] += a2[k] * b[k];
    sums[3] += a3[k] * b[k];
  }
}

/* b := b + the sum of factors times four vectors, added one after the other */
TARGET static void OF(add_four)(int n, int stride, const double *factor, const double *a, double *b) {
  const double *a0 = a, *a1 = a + stride, *a2 = a1 + stride, *a3 = a2 + stride;
  const double f0 = factor[0], f1 = factor[1], f2 = factor[2], f3 = factor[3];
  int k = 0;
  for (; k + 3 < n; k += 4)
    FOUR(b + k) =
        READ_FOUR(b + k) + f0 * READ_FOUR(a0 + k) + f1 * READ_FOUR(a1 + k) + f2 * READ_FOUR(a2 + k) + f3 * READ_FOUR(a3 + k);
  for (; k < n; k++) b[k] = b[k] + f0 * a0[k] + f1 * a1[k] + f2 * a2[k] + f3 * a3[k];
}

/* Smallest number; numbers that are not comparable are ignored */
TARGET static double OF(smallest)(int n, const double *a) {
  const four none = {INFINITY, INFINITY, INFINITY, INFINITY};
  four even = none, odd = none;
  int k = 0;
  for (; k + 7 < n; k += 8) {
    const four here = READ_FOUR(a + k), there = READ_FOUR(a + k + 4);
    even = CHOOSE(here < even, here, even);
    odd = CHOOSE(there < odd, there, odd);
  }
  even = CHOOSE(odd < even, odd, even);
  double least = even[0];
  for (int lane = 1; lane < 4; lane++)
    if (even[lane] < least) least = even[lane];
  for (; k < n; k++)
    if (a[k] < least) least = a[k];
  return least;
}

/* Largest number; numbers that are not comparable are ignored */
TARGET static double OF(largest)(int n, const double *a) {
  const four none = {-INFINITY, -INFINITY, -INFINITY, -INFINITY};
  four even = none, odd = none;
  int k = 0;
  for (; k + 7 < n; k += 8) {
    const four here = READ_FOUR(a + k), there = READ_FOUR(a + k + 4);
    even = CHOOSE(here > even, here, even);
    odd = CHOOSE(there > odd, there, odd);
  }
  even = CHOOSE(odd > even, odd, even);
  double most = even[0];
  for (int lane = 1; lane < 4; lane++)
    if (even[lane] > most) most = even[lane];
  for (; k < n; k++)
    if (a[k] > most) most = a[k];
  return most;
}

/* Largest magnitude of a difference of two vectors; differences that are not numbers are ignored */
TARGET static double OF(farthest)(int n, const double *a, const double *b) {
  four most_of_four = {0.0, 0.0, 0.0, 0.0};
  double most = 0.0;
  int k = 0;
  for (; k + 3 < n; k += 4) {
    const four distance = MAGNITUDES(READ_FOUR(a + k) - READ_FOUR(b + k));
    most_of_four = CHOOSE(distance > most_of_four, distance, most_of_four);
  }
  for (int lane = 0; lane < 4; lane++)
    if (most_of_four[lane] > most) most = most_of_four[lane];
  for (; k < n; k++)
    if (fabs(a[k] - b[k]) > most) most = fabs(a[k] - b[k]);
  return most;
}
