/* Loops of slip_loops.c, for one kind of processor; see lanes.h. Each ends with the remaining elements, up to three */

/* Sums over the contact of |p - P(p - r slip)|^2 and of the bound squared; P cuts vectors off at the bound */
TARGET static void OF(residual)(int n, int stride, const int *contact, const double *bound, const double *p, const double *slip, double r, double *sums) {
  four total = {0.0}, scale = {0.0};
  int k = 0;
  for (; k + 3 < n; k += 4) {
    const four_masks counts = TRUE_OF(contact + k);
    const four g = READ_FOUR(bound + k), px = READ_FOUR(p + k), py = READ_FOUR(p + stride + k);
    const four zx = px - r * READ_FOUR(slip + k), zy = py - r * READ_FOUR(slip + stride + k), square = zx * zx + zy * zy;
    const four ones = {1.0, 1.0, 1.0, 1.0};
    const four_masks slides = counts & (square > g * g);
    const four share = CHOOSE(slides, g / ROOTS(CHOOSE(slides, square, ones)), ones);
    const four x = px - share * zx, y = py - share * zy;
    total += WHERE(counts, x * x + y * y);
    scale += WHERE(counts, g * g);
  }
  sums[0] = SUM_OF(total);
  sums[1] = SUM_OF(scale);
  for (; k < n; k++) {
    if (!contact[k]) continue;
    double zx = p[k] - r * slip[k], zy = p[stride + k] - r * slip[stride + k];
    const double square = zx * zx + zy * zy, g = bound[k], share = square > g * g ? g / sqrt(square) : 1.0;
    zx = p[k] - share * zx;
    zy = p[stride + k] - share * zy;
    sums[0] += zx * zx + zy * zy;
    sums[1] += g * g;
  }
}

/* P(p + alpha d) in the contact, 0 elsewhere */
TARGET static void OF(step)(int n, int stride, const int *contact, const double *bound, double alpha, const double *p, const double *d, double *out) {
  int k = 0;
  for (; k + 3 < n; k += 4) {
    const four_masks counts = TRUE_OF(contact + k);
    const four ones = {1.0, 1.0, 1.0, 1.0}, g = READ_FOUR(bound + k);
    const four x = READ_FOUR(p + k) + alpha * READ_FOUR(d + k), y = READ_FOUR(p + stride + k) + alpha * READ_FOUR(d + stride + k);
    const four length = ROOTS(x * x + y * y);
    const four_masks slides = counts & (length > g);
    const four share = CHOOSE(slides, g / CHOOSE(slides, length, ones), ones);
    FOUR(out + k) = WHERE(counts, share * x);
    FOUR(out + stride + k) = WHERE(counts, share * y);
  }
  for (; k < n; k++) {
    const double x = p[k] + alpha * d[k], y = p[stride + k] + alpha * d[stride + k], length = sqrt(x * x + y * y);
    const double share = length > bound[k] ? bound[k] / length : 1.0;
    out[k] = contact[k] ? share * x : 0.0;
    out[stride + k] = contact[k] ? share * y : 0.0;
  }
}

/* Derivative of P at p - r slip, as weight and direction, and p - P(p - r slip); all is 0 outside of the contact */
TARGET static void OF(linearise)(int n, int stride, const int *contact, const double *bound, const double *p, const double *slip, double r,
                                 double *weight, double *direction, double *residual) {
  int k = 0;
  for (; k + 3 < n; k += 4) {
    const four_masks counts = TRUE_OF(contact + k);
    const four ones = {1.0, 1.0, 1.0, 1.0}, g = READ_FOUR(bound + k), px = READ_FOUR(p + k), py = READ_FOUR(p + stride + k);
    const four zx = px - r * READ_FOUR(slip + k), zy = py - r * READ_FOUR(slip + stride + k), square = zx * zx + zy * zy;
    const four_masks bounded = counts & ~(g <= 0.0), adheres = bounded & (square <= g * g), slides = bounded & ~adheres;
    const four inverse = ones / ROOTS(CHOOSE(slides, square, ones));
    const four w = CHOOSE(adheres, ones, WHERE(slides, g * inverse));
    FOUR(weight + k) = w;
    FOUR(direction + k) = WHERE(slides, inverse * zx);
    FOUR(direction + stride + k) = WHERE(slides, inverse * zy);
    FOUR(residual + k) = WHERE(counts, px - w * zx);
    FOUR(residual + stride + k) = WHERE(counts, py - w * zy);
  }
  for (; k < n; k++) {
    const double zx = p[k] - r * slip[k], zy = p[stride + k] - r * slip[stride + k], square = zx * zx + zy * zy, g = bound[k];
    const int bounded = contact[k] && !(g <= 0.0), adheres = bounded && square <= g * g, slides = bounded && !adheres;
    const double inverse = slides ? 1.0 / sqrt(square) : 0.0;
    weight[k] = adheres ? 1.0 : g * inverse;
    direction[k] = slides ? inverse * zx : 0.0;
    direction[stride + k] = slides ? inverse * zy : 0.0;
    if (!slides && !adheres) weight[k] = 0.0;
    residual[k] = contact[k] ? p[k] - weight[k] * zx : 0.0;
    residual[stride + k] = contact[k] ? p[stride + k] - weight[k] * zy : 0.0;
  }
}

/* v := weight (v - direction direction.v) */
TARGET static void OF(project_change)(int n, int stride, const double *weight, const double *direction, double *v) {
  int k = 0;
  for (; k + 3 < n; k += 4) {
    const four w = READ_FOUR(weight + k), nx = READ_FOUR(direction + k), ny = READ_FOUR(direction + stride + k);
    const four x = READ_FOUR(v + k), y = READ_FOUR(v + stride + k), c = nx * x + ny * y;
    FOUR(v + k) = w * (x - nx * c);
    FOUR(v + stride + k) = w * (y - ny * c);
  }
  for (; k < n; k++) {
    const double c = direction[k] * v[k] + direction[stride + k] * v[stride + k];
    v[k] = weight[k] * (v[k] - direction[k] * c);
    v[stride + k] = weight[k] * (v[stride + k] - direction[stride + k] * c);
  }
}

/* dp - D(dp - r (change + creep)), where D v = weight (v - direction direction.v) */
TARGET static void OF(jacobian)(int n, int stride, const double *weight, const double *direction, const double *dp, const double *change, double r,
                                const double *creep, double *out) {
  int k = 0;
  for (; k + 3 < n; k += 4) {
    const four w = READ_FOUR(weight + k), nx = READ_FOUR(direction + k), ny = READ_FOUR(direction + stride + k);
    const four x = READ_FOUR(dp + k), vx = x - r * (READ_FOUR(change + k) + creep[0]);
    const four y = READ_FOUR(dp + stride + k), vy = y - r * (READ_FOUR(change + stride + k) + creep[1]), c = nx * vx + ny * vy;
    FOUR(out + k) = x - w * (vx - nx * c);
    FOUR(out + stride + k) = y - w * (vy - ny * c);
  }
  for (; k < n; k++) {
    const double vx = dp[k] - r * (change[k] + creep[0]), vy = dp[stride + k] - r * (change[stride + k] + creep[1]);
    const double c = direction[k] * vx + direction[stride + k] * vy;
    out[k] = dp[k] - weight[k] * (vx - direction[k] * c);
    out[stride + k] = dp[stride + k] - weight[k] * (vy - direction[stride + k] * c);
  }
}

/* u := D u / r + v - projected */
TARGET static void OF(join)(int n, int stride, const double *weight, const double *direction, const double *v, const double *projected, double r,
                            double *u) {
  int k = 0;
  for (; k + 3 < n; k += 4) {
    const four w = READ_FOUR(weight + k), nx = READ_FOUR(direction + k), ny = READ_FOUR(direction + stride + k);
    const four x = READ_FOUR(u + k) / r, y = READ_FOUR(u + stride + k) / r, c = nx * x + ny * y;
    FOUR(u + k) = w * (x - nx * c) + (READ_FOUR(v + k) - READ_FOUR(projected + k));
    FOUR(u + stride + k) = w * (y - ny * c) + (READ_FOUR(v + stride + k) - READ_FOUR(projected + stride + k));
  }
  for (; k < n; k++) {
    const double x = u[k] / r, y = u[stride + k] / r, c = direction[k] * x + direction[stride + k] * y;
    u[k] = weight[k] * (x - direction[k] * c) + (v[k] - projected[k]);
    u[stride + k] = weight[k] * (y - direction[stride + k] * c) + (v[stride + k] - projected[stride + k]);
  }
}
