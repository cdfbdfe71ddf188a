/* The Manchester benchmark with a wheel S1002 on a rail 60E1: a wheelset is moved sideways; forces and
 * contact points of its right wheel are printed.
 *
 * usage: manchester FOLDER_OF_PROFILES */
#include <caddon_flags.h>
#include <contact_addon.h>
#include <stdio.h>
#include <string.h>

#define INT(value) (&(const int){value})
#define INTS(...) ((const int[]){__VA_ARGS__})
#define REAL(value) (&(const double){value})
#define REALS(...) ((const double[]){__VA_ARGS__})

static const int element = 1, whole = -1;
static const double speed = 2000.0, radius = 460.0; /* [mm/s], [mm] */

/* Kind 0 is a rail, 1 a wheel; the files are in mm */
static void set_profile(const char *folder, const char *file, int kind) {
  char name[1000];
  int length = snprintf(name, sizeof name, "%s/%s", folder, file);
  cntc_setprofileinputfname(&element, name, &length, INT(1), &kind, INT(2), REALS(1.0, 0.0));
}

int main(int argc, char **argv) {
  int version, error = 0, count, step;

  if (argc != 2) {
    fprintf(stderr, "usage: manchester FOLDER_OF_PROFILES\n");
    return 2;
  }
  cntc_initialize(&element, INT(1), &version, &error, " ", INT(1));
  if (error != 0) {
    fprintf(stderr, "the library cannot be initialised: error %d\n", error);
    return 1;
  }
  /* mm, N; right rail; steady rolling */
  cntc_setflags(&element, &whole, INT(6),
                INTS(CNTC_if_units, CNTC_ic_config, CNTC_ic_tang, CNTC_own_order, CNTC_ic_output, CNTC_ic_flow),
                INTS(CNTC_un_cntc, 1, 3, 2, 0, 0));
  cntc_setmaterialparameters(&element, &whole, INT(0), INT(4), REALS(0.28, 0.28, 82000.0, 82000.0));
  cntc_setfrictionmethod(&element, &whole, INT(0), INT(2), REALS(0.3, 0.3));
  cntc_setsolverflags(&element, &whole, INT(0), INT(4), INTS(999, 100, 30, 1), INT(1), REAL(1e-5));
  /* Elements of 0.2 mm; patches are separate from 90 degrees or 8 mm, and joined below 4 mm */
  cntc_setpotcontact(&element, &whole, INT(-1), INT(5), REALS(0.2, 0.2, 1.5707963, 8.0, 4.0));
  cntc_setrollingstepsize(&element, &whole, REAL(0.0), REAL(1.0));
  /* Gauge 1435 mm at 14 mm below the top of the rail, cant 1:40 */
  cntc_settrackdimensions(&element, INT(3), INT(11), REALS(14.0, 0.0, 1435.0, 0.025, 0, 0, 0, 0, 0, 0, 0));
  cntc_setwheelsetdimensions(&element, INT(3), INT(3), REALS(1360.0, -70.0, radius));
  set_profile(argv[1], "60E1.prr", 0);
  set_profile(argv[1], "S1002.prw", 1);
  cntc_setverticalforce(&element, REAL(10000.0));

  printf("# y wheelset [mm], patches, Fx, Fy on the rail [N], y and angle of the first contact [mm], [rad]\n");
  for (step = 0; step <= 6; step++) {
    const double y = step;
    double forces[24], place[14];
    cntc_setwheelsetposition(&element, INT(1), INT(6), REALS(0.0, y, 0.0, 0.0, 0.0024 * y, 0.0));
    cntc_setwheelsetvelocity(&element, INT(2), INT(6), REALS(speed, 0.0, 0.0, 0.0, 0.0, -speed / radius));
    cntc_calculate(&element, &whole, &error);
    if (error < 0) {
      fprintf(stderr, "y = %g mm: error %d\n", y, error);
      return 1;
    }
    cntc_getnumcontactpatches(&element, &count);
    cntc_getglobalforces(&element, &whole, INT(24), forces);
    cntc_getcontactlocation(&element, INT(1), INT(14), place);
    printf("%5.1f %3d %9.1f %9.1f %10.3f %8.4f\n", y, count, forces[0], forces[1], place[1], place[3]);
  }
  cntc_finalize(&element);
  return 0;
}
