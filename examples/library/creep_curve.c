/* A traction curve: tangential force over creepage, of clean rollers and with a soft layer between them.
 *
 * Two contact problems of one result element, which differ in the material only.
 * cc creep_curve.c $(pkg-config --cflags --libs contact) -o creep_curve */
#include <caddon_flags.h>
#include <contact_addon.h>
#include <stdio.h>

/* All arguments are passed by address; these macros provide one for a number */
#define INT(value) (&(const int){value})
#define REAL(value) (&(const double){value})
#define INTS(...) ((const int[]){__VA_ARGS__})
#define REALS(...) ((const double[]){__VA_ARGS__})

static const int element = 1;

/* Common to both problems: mm, N; steady rolling of second order in the size of elements */
static void set_up(const int *icp) {
  cntc_setflags(&element, icp, INT(5), INTS(CNTC_if_units, CNTC_ic_tang, CNTC_own_order, CNTC_ic_output, CNTC_ic_flow),
                INTS(CNTC_un_cntc, 3, 2, 0, 0));
  cntc_setfrictionmethod(&element, icp, INT(0), INT(2), REALS(0.35, 0.35));
  cntc_setreferencevelocity(&element, icp, REAL(25000.0));
  cntc_sethertzcontact(&element, icp, INT(-3), INT(5), REALS(25.0, 25.0, 6.5, 5.0, 1.2));
  cntc_setnormalforce(&element, icp, REAL(70000.0));
  cntc_setsolverflags(&element, icp, INT(0), INT(4), INTS(999, 100, 30, 1), INT(1), REAL(1e-6));
}

int main(void) {
  static const double creepages[] = {0.0, 0.0005, 0.001, 0.002, 0.003, 0.005, 0.008, 0.012, 0.02, 0.04, 0.1};
  int version, error = 0, icp;
  size_t k;

  cntc_initialize(&element, INT(3), &version, &error, " ", INT(1));
  if (error != 0) {
    fprintf(stderr, "the library cannot be initialised: error %d\n", error);
    return 1;
  }
  for (icp = 1; icp <= 2; icp++) set_up(&icp);
  cntc_setmaterialparameters(&element, INT(1), INT(0), INT(4), REALS(0.28, 0.28, 82000.0, 82000.0));
  /* Layer: shear modulus [N/mm2] and thickness [mm]; it does not yield */
  cntc_setmaterialparameters(&element, INT(2), INT(4), INT(8),
                             REALS(0.28, 0.28, 82000.0, 82000.0, 100.0, 0.02, 0.0, 0.0));

  printf("# creepage, Fx / Fn clean, Fx / Fn with layer\n");
  for (k = 0; k < sizeof creepages / sizeof creepages[0]; k++) {
    printf("%8.4f", creepages[k]);
    for (icp = 1; icp <= 2; icp++) {
      double fn, fx, fy, mz;
      cntc_setcreepages(&element, &icp, &creepages[k], REAL(0.0), REAL(0.0));
      cntc_calculate(&element, &icp, &error);
      if (error < 0) {
        fprintf(stderr, "creepage %g: error %d\n", creepages[k], error);
        return 1;
      }
      cntc_getcontactforces(&element, &icp, &fn, &fx, &fy, &mz);
      printf(" %9.5f", fx / fn);
    }
    printf("\n");
  }
  cntc_finalize(&element);
  return 0;
}
