/* Loops of pack_products.c, for one kind of processor; see lanes.h */

/* One entry of the product: factor times a complex number, optionally times i */
TARGET static void OF(one)(double factor, int turned, int added, const double *traction, double *product) {
  const double re = turned ? -factor * traction[1] : factor * traction[0], im = turned ? factor * traction[0] : factor * traction[1];
  product[0] = added ? product[0] + re : re;
  product[1] = added ? product[1] + im : im;
}

/* A column of n numbers: the first half has the stored factors, the rest has them in reverse order, times another number */
TARGET static void OF(column)(int n, int half, const double *factor, double other_half, int turned, int added, const double *traction,
                              double *product) {
  const four turn = {-1.0, 1.0, -1.0, 1.0};
  int l = 0;
  for (; l + 1 < half; l += 2) {
    const four f = EACH_TWICE(factor + l), z = READ_FOUR(traction + 2 * l);
    four change = turned ? turn * f * PARTS_SWAPPED(z) : f * z;
    if (added) change += READ_FOUR(product + 2 * l);
    FOUR(product + 2 * l) = change;
  }
  if (l < half) OF(one)(factor[l], turned, added, traction + 2 * l, product + 2 * l);
  for (l = half; l + 1 < n; l += 2) {
    const four f = other_half * EACH_TWICE_BACK(factor + n - l - 1), z = READ_FOUR(traction + 2 * l);
    four change = turned ? turn * f * PARTS_SWAPPED(z) : f * z;
    if (added) change += READ_FOUR(product + 2 * l);
    FOUR(product + 2 * l) = change;
  }
  if (l < n) OF(one)(other_half * factor[n - l], turned, added, traction + 2 * l, product + 2 * l);
}
