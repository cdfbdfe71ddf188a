/* Loops of slip_loops.c, for one kind of processor; see lanes.h. Each ends with the remaining elements, up to three */

/* Sums over the contact of |p - P(p - r slip)|^2 and of the bound squared; P limits vectors to the bound */
TARGET static void OF(residual)(int n, const int *contact, const double *bound, const double *p, const double *slip, double r, double *sums) {
  four total = {0.0}, scale = {0.0};
  int k = 0;
  for (; k + 3 < n; k += 4) {
    const four_masks counts = TRUE_OF(contact + k);
    const four g = READ_FOUR(bound + k), px = READ_FOUR(p + k), py = READ_FOUR(p + n + k);
    const four zx = px - r * READ_FOUR(slip + k), zy = py - r * READ_FOUR(slip + n + k), square = zx * zx + zy * zy;
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
    double zx = p[k] - r * slip[k], zy = p[n + k] - r * slip[n + k];
    const double square = zx * zx + zy * zy, g = bound[k], share = square > g * g ? g / sqrt(square) : 1.0;
    zx = p[k] - share * zx;
    zy = p[n + k] - share * zy;
    sums[0] += zx * zx + zy * zy;
    sums[1] += g * g;
  }
}

/* P(p + alpha d) in the contact, 0 elsewhere */
TARGET static void OF(step)(int n, const int *contact, const double *bound, double alpha, const double *p, const double *d, double *out) {
  int k = 0;
  for (; k + 3 < n; k += 4) {
    const four_masks counts = TRUE_OF(contact + k);
    const four ones = {1.0, 1.0, 1.0, 1.0}, g = READ_FOUR(bound + k);
    const four x = READ_FOUR(p + k) + alpha * READ_FOUR(d + k), y = READ_FOUR(p + n + k) + alpha * READ_FOUR(d + n + k);
    const four length = ROOTS(x * x + y * y);
    const four_masks slides = counts & (length > g);
    const four share = CHOOSE(slides, g / CHOOSE(slides, length, ones), ones);
    FOUR(out + k) = WHERE(counts, share * x);
    FOUR(out + n + k) = WHERE(counts, share * y);
  }
  for (; k < n; k++) {
    const double x = p[k] + alpha * d[k], y = p[n + k] + alpha * d[n + k], length = sqrt(x * x + y * y);
    const double share = length > bound[k] ? bound[k] / length : 1.0;
    out[k] = contact[k] ? share * x : 0.0;
    out[n + k] = contact[k] ? share * y : 0.0;
  }
}

/* Derivative of P at p - r slip, as weight and direction, and p - P(p - r slip); all are 0 outside the contact */
TARGET static void OF(linearise)(int n, const int *contact, const double *bound, const double *p, const double *slip, double r,
                                 double *weight, double *direction, double *residual) {
  int k = 0;
  for (; k + 3 < n; k += 4) {
    const four_masks counts = TRUE_OF(contact + k);
    const four ones = {1.0, 1.0, 1.0, 1.0}, g = READ_FOUR(bound + k), px = READ_FOUR(p + k), py = READ_FOUR(p + n + k);
    const four zx = px - r * READ_FOUR(slip + k), zy = py - r * READ_FOUR(slip + n + k), square = zx * zx + zy * zy;
    const four_masks bounded = counts & ~(g <= 0.0), adheres = bounded & (square <= g * g), slides = bounded & ~adheres;
    const four inverse = ones / ROOTS(CHOOSE(slides, square, ones));
    const four w = CHOOSE(adheres, ones, WHERE(slides, g * inverse));
    FOUR(weight + k) = w;
    FOUR(direction + k) = WHERE(slides, inverse * zx);
    FOUR(direction + n + k) = WHERE(slides, inverse * zy);
    FOUR(residual + k) = WHERE(counts, px - w * zx);
    FOUR(residual + n + k) = WHERE(counts, py - w * zy);
  }
  for (; k < n; k++) {
    const double zx = p[k] - r * slip[k], zy = p[n + k] - r * slip[n + k], square = zx * zx + zy * zy, g = bound[k];
    const int bounded = contact[k] && !(g <= 0.0), adheres = bounded && square <= g * g, slides = bounded && !adheres;
    const double inverse = slides ? 1.0 / sqrt(square) : 0.0;
    weight[k] = adheres ? 1.0 : g * inverse;
    direction[k] = slides ? inverse * zx : 0.0;
    direction[n + k] = slides ? inverse * zy : 0.0;
    if (!slides && !adheres) weight[k] = 0.0;
    residual[k] = contact[k] ? p[k] - weight[k] * zx : 0.0;
    residual[n + k] = contact[k] ? p[n + k] - weight[k] * zy : 0.0;
  }
}

/* v := weight (v - direction direction.v) */
TARGET static void OF(project_change)(int n, const double *weight, const double *direction, double *v) {
  int k = 0;
  for (; k + 3 < n; k += 4) {
    const four w = READ_FOUR(weight + k), nx = READ_FOUR(direction + k), ny = READ_FOUR(direction + n + k);
    const four x = READ_FOUR(v + k), y = READ_FOUR(v + n + k), c = nx * x + ny * y;
    FOUR(v + k) = w * (x - nx * c);
    FOUR(v + n + k) = w * (y - ny * c);
  }
  for (; k < n; k++) {
    const double c = direction[k] * v[k] + direction[n + k] * v[n + k];
    v[k] = weight[k] * (v[k] - direction[k] * c);
    v[n + k] = weight[k] * (v[n + k] - direction[n + k] * c);
  }
}

/* dp - D(dp - r (change + creep)), where D v = weight (v - direction direction.v) */
TARGET static void OF(jacobian)(int n, const double *weight, const double *direction, const double *dp, const double *change, double r,
                                const double *creep, double *out) {
  int k = 0;
  for (; k + 3 < n; k += 4) {
    const four w = READ_FOUR(weight + k), nx = READ_FOUR(direction + k), ny = READ_FOUR(direction + n + k);
    const four x = READ_FOUR(dp + k), vx = x - r * (READ_FOUR(change + k) + creep[0]);
    const four y = READ_FOUR(dp + n + k), vy = y - r * (READ_FOUR(change + n + k) + creep[1]), c = nx * vx + ny * vy;
    FOUR(out + k) = x - w * (vx - nx * c);
    FOUR(out + n + k) = y - w * (vy - ny * c);
  }
  for (; k < n; k++) {
    const double vx = dp[k] - r * (change[k] + creep[0]), vy = dp[n + k] - r * (change[n + k] + creep[1]);
    const double c = direction[k] * vx + direction[n + k] * vy;
    out[k] = dp[k] - weight[k] * (vx - direction[k] * c);
    out[n + k] = dp[n + k] - weight[k] * (vy - direction[n + k] * c);
  }
}

/* u := D u / r + v - projected */
TARGET static void OF(join)(int n, const double *weight, const double *direction, const double *v, const double *projected, double r,
                            double *u) {
  int k = 0;
  for (; k + 3 < n; k += 4) {
    const four w = READ_FOUR(weight + k), nx = READ_FOUR(direction + k), ny = READ_FOUR(direction + n + k);
    const four x = READ_FOUR(u + k) / r, y = READ_FOUR(u + n + k) / r, c = nx * x + ny * y;
    FOUR(u + k) = w * (x - nx * c) + (READ_FOUR(v + k) - READ_FOUR(projected + k));
    FOUR(u + n + k) = w * (y - ny * c) + (READ_FOUR(v + n + k) - READ_FOUR(projected + n + k));
  }
  for (; k < n; k++) {
    const double x = u[k] / r, y = u[n + k] / r, c = direction[k] * x + direction[n + k] * y;
    u[k] = weight[k] * (x - direction[k] * c) + (v[k] - projected[k]);
    u[n + k] = weight[k] * (y - direction[n + k] * c) + (v[n + k] - projected[n + k]);
  }
}
