/* Loops of wheel_loops.c, for one kind of processor; see lanes.h */

/* Newton's method for eight points of a row at once; 1 if all are found on the piece, otherwise nothing is changed */
TARGET static int OF(meet)(const double *piece, const double *y, const double *z, double radius, const double *base, const double *axis,
                           const double *along, double near, double tolerance, int most_steps, const double *x, double *place,
                           double *n) {
  const double first = piece[0], last = piece[1], k1 = along[0], k2 = along[1], k3 = along[2];
  four p[2], h[2], r[2], q1[2], q2[2], q3[2], t[2];
  for (int g = 0; g < 2; g++) {
    p[g] = READ_FOUR(place + 4 * g);
    h[g] = READ_FOUR(n + 4 * g);
  }
  for (int step = 0; step < most_steps; step++) {
    four_masks fits = {-1, -1, -1, -1};
    for (int g = 0; g < 2; g++) {
      const four xg = READ_FOUR(x + 4 * g);
      t[g] = p[g] - first;
      q1[g] = base[0] + axis[0] * xg + k1 * h[g];
      q2[g] = base[1] + axis[1] * xg + k2 * h[g];
      q3[g] = base[2] + axis[2] * xg + k3 * h[g];
      r[g] = radius + z[0] + t[g] * (z[1] + t[g] * (z[2] + t[g] * z[3]));
      fits &= (p[g] >= first) & (p[g] <= last) & (MAGNITUDES(q1[g]) <= near * r[g]);
    }
    if (!ALL_OF(fits)) return 0;
    four_masks solved = {-1, -1, -1, -1};
    for (int g = 0; g < 2; g++) {
      const four y_s = y[1] + t[g] * (2.0 * y[2] + t[g] * 3.0 * y[3]), z_s = z[1] + t[g] * (2.0 * z[2] + t[g] * 3.0 * z[3]);
      const four depth = ROOTS(r[g] * r[g] - q1[g] * q1[g]);
      const four f1 = q2[g] - (y[0] + t[g] * (y[1] + t[g] * (y[2] + t[g] * y[3]))), f2 = q3[g] + radius - depth;
      const four j21 = -r[g] * z_s / depth, j22 = k3 + q1[g] * k1 / depth, det = -y_s * j22 - k2 * j21;
      if (!ALL_OF(MAGNITUDES(det) > 0.0)) return 0;
      /* steps of position and height */
      const four dp = (f1 * j22 - k2 * f2) / det, dh = (-y_s * f2 - f1 * j21) / det;
      p[g] -= dp;
      h[g] -= dh;
      solved &= MAGNITUDES(dp) + MAGNITUDES(dh) <= tolerance * radius;
    }
    if (!ALL_OF(solved)) continue;
    if (!ALL_OF((p[0] >= first) & (p[0] <= last) & (p[1] >= first) & (p[1] <= last))) return 0;
    for (int g = 0; g < 2; g++) {
      FOUR(place + 4 * g) = p[g];
      FOUR(n + 4 * g) = h[g];
    }
    return 1;
  }
  return 0;
}

/* A polynomial of degree 7 at points from -1 to 1 at even distances */
TARGET static void OF(spread)(const double *p, int n, double *values) {
  const double step = 2.0 / (n - 1);
  int i = 0;
  for (; i + 3 < n; i += 4) {
    const four t = (four){i, i + 1, i + 2, i + 3} * step - 1.0;
    FOUR(values + i) = p[0] + t * (p[1] + t * (p[2] + t * (p[3] + t * (p[4] + t * (p[5] + t * (p[6] + t * p[7]))))));
  }
  for (; i < n; i++) {
    const double t = i * step - 1.0;
    values[i] = p[0] + t * (p[1] + t * (p[2] + t * (p[3] + t * (p[4] + t * (p[5] + t * (p[6] + t * p[7]))))));
  }
}
