/* Stresses below a ball sliding on a plane: with increasing friction their maximum moves towards the surface. */
#include <caddon_flags.h>
#include <contact_addon.h>
#include <stdio.h>

#define INT(value) (&(const int){value})
#define INTS(...) ((const int[]){__VA_ARGS__})
#define REAL(value) (&(const double){value})
#define REALS(...) ((const double[]){__VA_ARGS__})

enum { nx = 25, nz = 31, points = nx * nz };
static const int element = 1, problem = 1;

int main(void) {
  static const double frictions[] = {0.0001, 0.15, 0.3, 0.5};
  double x[nx], z[nz], values[3 * points];
  int version, error = 0, k;
  size_t case_number;

  cntc_initialize(&element, INT(3), &version, &error, " ", INT(1));
  if (error != 0) {
    fprintf(stderr, "the library cannot be initialised: error %d\n", error);
    return 1;
  }
  cntc_setflags(&element, &problem, INT(4), INTS(CNTC_if_units, CNTC_ic_tang, CNTC_ic_output, CNTC_ic_flow),
                INTS(CNTC_un_cntc, 3, 0, 0));
  cntc_setmaterialparameters(&element, &problem, INT(0), INT(4), REALS(0.3, 0.3, 80000.0, 80000.0));
  cntc_sethertzcontact(&element, &problem, INT(-3), INT(5), REALS(40.0, 40.0, 1.0, 1.0, 1.1));
  cntc_setnormalforce(&element, &problem, REAL(2000.0));
  /* Creepage that is large enough for full sliding; the force on the ball points to -x */
  cntc_setcreepages(&element, &problem, REAL(1.0), REAL(0.0), REAL(0.0));
  /* Plane below the middle of the contact, in steps of 0.1 and 0.05 mm */
  for (k = 0; k < nx; k++) x[k] = 0.1 * (k - nx / 2);
  for (k = 0; k < nz; k++) z[k] = 0.05 * k;
  subs_addblock(&element, &problem, INT(1), INT(9), INT(nx), INT(1), INT(nz), x, REAL(0.0), z);

  printf("# friction, largest von Mises stress [N/mm2], its position x, z [mm]\n");
  for (case_number = 0; case_number < sizeof frictions / sizeof frictions[0]; case_number++) {
    int largest = 0;
    cntc_setfrictionmethod(&element, &problem, INT(0), INT(2), REALS(frictions[case_number], frictions[case_number]));
    cntc_calculate(&element, &problem, &error);
    if (error >= 0) subs_calculate(&element, &problem, &error);
    if (error < 0) {
      fprintf(stderr, "friction %g: error %d\n", frictions[case_number], error);
      return 1;
    }
    /* Columns: x, z, von Mises stress */
    subs_getresults(&element, &problem, INT(1), INT(points), INT(3), INTS(1, 3, 8), values);
    for (k = 0; k < points; k++) {
      if (values[2 * points + k] > values[2 * points + largest]) largest = k;
    }
    printf("%7.4f %8.1f %6.2f %5.2f\n", frictions[case_number], values[2 * points + largest], values[largest],
           values[points + largest]);
  }
  cntc_finalize(&element);
  return 0;
}
