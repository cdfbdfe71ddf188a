/* The Manchester benchmark by the library: one wheelset on the left and on the right rail, 21 lateral
 * positions with a vertical force, then stresses below the surface of one of them.
 *
 * Profiles and expected figures: regression outputs of the published library, version 25.2.0 (win64,
 * serial), as printed there. Forces within 0.2 % of the largest component of the case, heights within
 * 0.0005 mm, positions within 0.01 mm, creepages within 0.2 %, pressures and approaches within 0.5 %, moments within
 * 0.5 % of the friction force at an arm of 1 mm, numbers of elements within 2. The program has the same
 * differences from the published outputs of these cases (doc/validation/wheel_rail.md); they come from the
 * search for the contact, not from the library.
 * usage: manchester FOLDER_OF_PROFILES */
#include <caddon_flags.h>
#include <contact_addon.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* y_ws [mm], roll [rad], rate of pitch [rad/s]; Fx, Fy [N] and z_ws [mm], left and right */
static const double steps[][9] = {
    {0.0, 0.00000000, -4.34811810, 0.3, -36.2, 0.1981, 0.3, 36.2, 0.1981},
    {0.5, -0.00002304, -4.34741340, 887.1, -2582.0, 0.1945, -880.0, -2015.0, 0.1938},
    {1.0, -0.00005049, -4.34657520, 829.2, -3069.6, 0.1840, -814.3, -2141.9, 0.1839},
    {1.5, -0.00008103, -4.34624400, 641.1, -3095.1, 0.1695, -619.8, -2130.6, 0.1694},
    {2.0, -0.00011280, -4.34591970, 546.3, -3095.8, 0.1530, -517.3, -2095.1, 0.1529},
    {2.5, -0.00014570, -4.34556270, 492.1, -3090.7, 0.1347, -456.2, -2047.0, 0.1344},
    {3.0, -0.00018030, -4.34515030, 460.5, -3084.4, 0.1145, -417.5, -1988.5, 0.1143},
    {3.5, -0.00021680, -4.34466880, 443.1, -3078.3, 0.0924, -393.1, -1918.4, 0.0921},
    {4.0, -0.00025570, -4.34409300, 436.6, -3072.6, 0.0680, -379.6, -1833.0, 0.0676},
    {4.5, -0.00029770, -4.34337150, 440.6, -3067.1, 0.0410, -376.8, -1723.1, 0.0404},
    {5.0, -0.00035540, -4.33536370, 837.8, -2976.8, 0.0019, -763.3, 131.6, 0.0015},
    {5.5, -0.00047770, -4.33188640, 934.1, -2944.2, -0.0865, -850.2, 572.9, -0.0866},
    {6.0, -0.00062720, -4.32937180, 973.1, -2929.4, -0.1957, -880.0, 1401.4, -0.1961},
    {6.5, -0.00437600, -4.27488340, 2260.0, -2042.5, -3.0459, -1986.7, 12481.4, -3.0468},
    {7.0, -0.00639300, -4.26356290, 2326.6, -1964.1, -4.5803, -2078.9, 10489.7, -4.5809},
    {7.5, -0.00764200, -4.25757470, 2327.4, -1969.1, -5.5293, -2085.9, 9343.5, -5.5298},
    {8.0, -0.00860600, -4.25348570, 2310.1, -1998.4, -6.2606, -2070.3, 8492.8, -6.2615},
    {8.5, -0.00940800, -4.25032450, 2285.5, -2037.0, -6.8677, -2044.4, 7801.4, -6.8687},
    {9.0, -0.01010113, -4.24775610, 2257.1, -2080.0, -7.3913, -2014.0, 7212.9, -7.3919},
    {9.5, -0.01071386, -4.24556650, 2226.9, -2124.5, -7.8528, -1981.1, 6696.9, -7.8534},
    {10.0, -0.01126431, -4.24363750, 2196.0, -2169.3, -8.2662, -1947.1, 6235.1, -8.2668},
};

/* Side, step; y, z [mm] and angle of the reference point in the track system; V [mm/s]; creepages [-], [-],
 * [rad/mm]; Fn, Fs [N], Mn [N mm]; approach [mm]; pmax [N/mm2]; elements: grid, contact, adhesion */
static const double patches[][17] = {
    {1, 1, -751.8726, 0.1252, 0.0290, 2000.0, -5.665E-05, 0.000, -6.302E-05, 9997.0, 253.6, 4605.0, 1.596E-02, 338.3, 3999, 1291, 943},
    {1, 2, -754.2092, 0.0668, 0.0211, 2000.0, -3.708E-04, 1.200E-03, -4.592E-05, 1.005E+04, -2370.0, 1340.0, 1.859E-02, 395.3, 3015, 989, 342},
    {1, 5, -756.5056, 0.0271, 0.0134, 1999.0, -8.651E-04, 4.798E-03, -2.947E-05, 1.004E+04, -2961.0, 143.4, 2.054E-02, 465.9, 2444, 830, 0},
    {1, 8, -757.4801, 0.0156, 0.0102, 1999.0, -1.241E-03, 8.395E-03, -2.263E-05, 1.003E+04, -2976.0, 65.56, 2.158E-02, 513.4, 2303, 748, 0},
    {1, 11, -757.8958, 0.0116, 0.0088, 1997.0, -3.462E-03, 1.198E-02, -1.990E-05, 1.003E+04, -2889.0, 48.32, 2.232E-02, 552.8, 2107, 692, 0},
    {1, 12, -757.9746, 0.0110, 0.0085, 1996.0, -4.292E-03, 1.317E-02, -1.959E-05, 1.002E+04, -2859.0, 45.16, 2.255E-02, 565.8, 2009, 679, 0},
    {1, 13, -758.0210, 0.0106, 0.0084, 1995.0, -4.901E-03, 1.437E-02, -1.957E-05, 1.002E+04, -2845.0, 41.57, 2.278E-02, 578.5, 1960, 658, 0},
    {1, 14, -758.6243, 0.0061, 0.0064, 1983.0, -1.764E-02, 1.546E-02, -2.319E-05, 1.001E+04, -1979.0, 51.61, 2.369E-02, 637.0, 1836, 601, 0},
    {1, 15, -758.6092, 0.0062, 0.0064, 1980.0, -2.035E-02, 1.663E-02, -2.761E-05, 1.001E+04, -1900.0, 45.23, 2.412E-02, 666.7, 1785, 575, 0},
    {1, 17, -758.2223, 0.0089, 0.0077, 1977.0, -2.281E-02, 1.899E-02, -3.511E-05, 1.002E+04, -1921.0, 40.02, 2.458E-02, 701.1, 1683, 549, 0},
    {1, 19, -757.6922, 0.0135, 0.0095, 1976.0, -2.425E-02, 2.135E-02, -4.210E-05, 1.002E+04, -1985.0, 34.39, 2.489E-02, 725.3, 1632, 532, 0},
    {1, 21, -757.0975, 0.0197, 0.0115, 1975.0, -2.532E-02, 2.371E-02, -4.883E-05, 1.002E+04, -2054.0, 32.16, 2.511E-02, 744.0, 1643, 515, 0},
    {2, 1, 751.8726, 0.1252, -0.0290, 2000.0, -5.665E-05, 0.000, 6.302E-05, 9997.0, -253.6, -4605.0, 1.596E-02, 338.3, 3999, 1291, 943},
    {2, 2, 744.5026, 0.4289, -0.0568, 2000.0, 4.948E-04, 1.202E-03, 1.233E-04, 9870.0, -2579.0, -3202.0, 1.948E-02, 632.5, 3995, 1147, 73},
    {2, 5, 740.9147, 0.6548, -0.0806, 2001.0, 8.752E-04, 4.818E-03, 1.746E-04, 9799.0, -2893.0, -37.57, 2.480E-02, 744.8, 1683, 505, 0},
    {2, 8, 739.4071, 0.7908, -0.0994, 2001.0, 1.154E-03, 8.447E-03, 2.150E-04, 9760.0, -2901.0, -23.33, 2.410E-02, 691.6, 1683, 542, 0},
    {2, 11, 727.0855, 3.0041, -0.2905, 2004.0, 4.174E-03, 1.255E-02, 6.188E-04, 9619.0, -2738.0, -826.6, 2.719E-02, 1556.0, 3960, 389, 0},
    {2, 12, 726.1169, 3.3006, -0.3363, 2004.0, 4.379E-03, 1.401E-02, 7.122E-04, 9629.0, -2759.0, -17.75, 2.926E-02, 1486.0, 969, 258, 0},
    {2, 13, 725.1371, 3.6882, -0.4176, 2005.0, 5.077E-03, 1.580E-02, 8.744E-04, 9709.0, -2775.0, 59.67, 2.728E-02, 1149.0, 1197, 332, 0},
    {2, 14, 718.4931, 10.3654, -1.1591, 2018.0, 1.828E-02, 3.905E-02, 1.937E-03, 1.544E+04, -4170.0, -728.2, 3.623E-02, 2603.0, 1164, 249, 0},
    {2, 15, 719.0445, 9.2525, -1.0634, 2020.0, 1.949E-02, 3.457E-02, 1.838E-03, 1.403E+04, -3644.0, -654.2, 3.563E-02, 2622.0, 957, 224, 0},
    {2, 17, 719.8316, 8.0092, -0.9501, 2021.0, 2.127E-02, 3.300E-02, 1.701E-03, 1.272E+04, -3195.0, -516.1, 3.494E-02, 2634.0, 869, 199, 0},
    {2, 19, 720.4903, 7.1643, -0.8676, 2023.0, 2.266E-02, 3.341E-02, 1.588E-03, 1.197E+04, -2963.0, -411.9, 3.447E-02, 2640.0, 825, 186, 0},
    {2, 21, 721.0880, 6.5066, -0.7992, 2024.0, 2.378E-02, 3.445E-02, 1.486E-03, 1.144E+04, -2820.0, -333.7, 3.411E-02, 2643.0, 781, 177, 0},
};

enum { number_of_steps = sizeof steps / sizeof steps[0], number_of_patches = sizeof patches / sizeof patches[0] };

static int failures = 0, checks = 0;
static const int whole = -1, first = 1;

static void check(int condition, const char *what) {
  checks++;
  if (condition) return;
  failures++;
  printf("FAILED %s\n", what);
}

static void close_to(double got, double expected, double tolerance, const char *what, int side, int step) {
  checks++;
  if (fabs(got - expected) <= tolerance) return;
  failures++;
  printf("FAILED side %d step %d %s: %.7g, expected %.7g within %.2g\n", side, step, what, got, expected, tolerance);
}

static void set_flag(int ire, int code, int value) {
  const int one = 1;
  cntc_setflags(&ire, &whole, &one, &code, &value);
}

static void set_up(int ire, int side, const char *folder) {
  static const char *const names[] = {"MBench_UIC60_v3.prr", "MBench_S1002_v3.prw"};
  const int module = 1, zero = 0, one = 1, blank_length = 1;
  int version = 0, code = -1, k;

  cntc_initialize(&ire, &module, &version, &code, " ", &blank_length);
  check(code == 0, "initialize");
  {
    const int flags[] = {CNTC_if_units,  CNTC_ic_config, CNTC_ic_tang,   CNTC_ic_pvtime,  CNTC_ic_discns,
                         CNTC_ic_output, CNTC_ic_flow,   CNTC_ic_matfil, CNTC_ic_npomax, CNTC_if_idebug};
    const int values[] = {CNTC_un_cntc, side, 3, 2, 2, 2, 2, 0, 20000, 1};
    const int count = sizeof flags / sizeof flags[0];
    cntc_setflags(&ire, &whole, &count, flags, values);
  }
  {
    const int limits[] = {999, 100, 30, 1}, four = 4;
    const double eps = 1e-5;
    cntc_setsolverflags(&ire, &whole, &zero, &four, limits, &one, &eps);
  }
  {
    const double material[] = {0.28, 0.28, 82000.0, 82000.0}, friction[] = {0.3, 0.3};
    const int four = 4, two = 2;
    cntc_setmaterialparameters(&ire, &whole, &zero, &four, material);
    cntc_setfrictionmethod(&ire, &whole, &zero, &two, friction);
  }
  {
    const double grid[] = {0.2, 0.2, acos(0.0), 8.0, 4.0}, chi = 0.0, step = 1.0;
    const int minus_one = -1, five = 5;
    cntc_setpotcontact(&ire, &whole, &minus_one, &five, grid);
    cntc_setrollingstepsize(&ire, &whole, &chi, &step);
  }
  {
    const double track[11] = {14.0, 0.0, 1435.0};
    const int three = 3, eleven = 11;
    cntc_settrackdimensions(&ire, &three, &eleven, track);
  }
  for (k = 0; k < 2; k++) {
    char name[500];
    const double reals[] = {1.0, 0.0};
    const int two = 2;
    int length;
    snprintf(name, sizeof name, "%s/%s", folder, names[k]);
    length = (int)strlen(name);
    cntc_setprofileinputfname(&ire, name, &length, &one, &k, &two, reals);
  }
  {
    const double wheelset[] = {1360.0, -70.0, 460.0};
    const int three = 3;
    cntc_setwheelsetdimensions(&ire, &three, &three, wheelset);
  }
  {
    const double depth[] = {11.0, 1e-9, 0.5}, none = 0.0;
    const int three = 3;
    subs_addblock(&ire, &whole, &one, &one, &one, &one, &three, &none, &none, depth);
  }
}

static void compare_patch(int ire, int step, const double *expected) {
  const int length = 14;
  double place[14], velocity, creepage[3], force[4], approach, pressure, area[3], dx, dy;
  int mx, my;

  cntc_getcontactlocation(&ire, &first, &length, place);
  close_to(place[1], expected[2], 1e-2, "y of the contact point", ire, step);
  close_to(place[2], expected[3], 1e-2, "z of the contact point", ire, step);
  close_to(place[3], expected[4], 5e-4, "contact angle", ire, step);
  cntc_getreferencevelocity(&ire, &first, &velocity);
  close_to(velocity, expected[5], 0.6, "velocity", ire, step);
  cntc_getcreepages(&ire, &first, &creepage[0], &creepage[1], &creepage[2]);
  close_to(creepage[0], expected[6], 0.002 * fabs(expected[6]) + 1e-7, "longitudinal creepage", ire, step);
  close_to(creepage[1], expected[7], 0.002 * fabs(expected[7]) + 1e-7, "lateral creepage", ire, step);
  close_to(creepage[2], expected[8], 0.002 * fabs(expected[8]) + 1e-8, "spin", ire, step);
  cntc_getcontactforces(&ire, &first, &force[0], &force[1], &force[2], &force[3]);
  close_to(force[0], expected[9], 0.002 * expected[9], "normal force", ire, step);
  close_to(force[2], expected[10], 0.002 * expected[9], "lateral force", ire, step);
  close_to(force[3], expected[11], 0.005 * 0.3 * expected[9], "spin moment", ire, step);
  cntc_getpenetration(&ire, &first, &approach);
  close_to(approach, expected[12], 0.005 * expected[12], "approach", ire, step);
  cntc_getmaximumpressure(&ire, &first, &pressure);
  close_to(pressure, expected[13], 0.005 * expected[13], "largest pressure", ire, step);
  cntc_getnumelements(&ire, &first, &mx, &my);
  cntc_getgriddiscretization(&ire, &first, &dx, &dy);
  cntc_getcontactpatchareas(&ire, &first, &area[0], &area[1], &area[2]);
  close_to(area[0] / (dx * dy), expected[15], 2.5, "elements in contact", ire, step);
  close_to(area[1] / (dx * dy), expected[16], 2.5, "elements in adhesion", ire, step);
}

static void one_step(int ire, int step) {
  const double *row = steps[step - 1];
  const double position[6] = {0.0, row[0], 0.0, row[1], 0.0024 * row[0], 0.0};
  const double velocity[6] = {2000.0, 0.0, 0.0, 0.0, 0.0, row[2]};
  const double fz = 10000.0;
  const double *expected = row + 3 + 3 * (ire - 1);
  const int one = 1, two = 2, six = 6, length = 24;
  double forces[24], largest, wheelset[6];
  int code = -1, count = -1, k;

  cntc_setwheelsetposition(&ire, &one, &six, position);
  cntc_setwheelsetvelocity(&ire, &two, &six, velocity);
  cntc_setverticalforce(&ire, &fz);
  cntc_calculate(&ire, &whole, &code);
  close_to(code, 0, 0, "error code", ire, step);
  cntc_getnumcontactpatches(&ire, &count);
  close_to(count, 1, 0, "contact patches", ire, step);
  cntc_getglobalforces(&ire, &whole, &length, forces);
  largest = fmax(10000.0, fabs(expected[1]));
  close_to(forces[0], expected[0], 0.002 * largest, "Fx", ire, step);
  close_to(forces[1], expected[1], 0.002 * largest, "Fy", ire, step);
  close_to(forces[2], 10000.0, 0.1, "Fz", ire, step);
  cntc_getwheelsetposition(&ire, &six, wheelset);
  close_to(wheelset[2], expected[2], 5e-4, "z_ws", ire, step);
  for (k = 0; k < number_of_patches; k++) {
    if (patches[k][0] == ire && patches[k][1] == step) compare_patch(ire, step, patches[k]);
  }
  {
    /* Digits that keep the present data; they must not change a result */
    const int no_count = 0;
    const double nothing = 0.0;
    const int keep = 0, law = 1;
    set_flag(ire, CNTC_ic_discns, 1);
    set_flag(ire, CNTC_ic_inflcf, 1);
    cntc_setsolverflags(&ire, &whole, &one, &no_count, &keep, &no_count, &nothing);
    cntc_settrackdimensions(&ire, &keep, &no_count, &nothing);
    cntc_setwheelsetdimensions(&ire, &keep, &no_count, &nothing);
    cntc_setfrictionmethod(&ire, &whole, &law, &no_count, &nothing);
  }
}

/* Stresses below the right contact of step 11, where the grid is that of the published run */
static void stresses(void) {
  static double values[4 * 60 * 80 * 11];
  const int ire = 2, columns[] = {1, 2, 3, 8}, four = 4;
  int code = -1, nx, ny, nz, mx, my, points, k, largest = 0;

  subs_calculate(&ire, &whole, &code);
  close_to(code, 0, 0, "error code of subs_calculate", ire, 11);
  subs_getblocksize(&ire, &first, &first, &nx, &ny, &nz);
  cntc_getnumelements(&ire, &first, &mx, &my);
  check(nx == mx && ny == my && nz == 11, "a block of all elements and eleven depths");
  points = nx * ny * nz;
  check(points > 0 && 4 * points <= (int)(sizeof values / sizeof values[0]), "the block fits");
  if (points <= 0 || 4 * points > (int)(sizeof values / sizeof values[0])) return;
  subs_getresults(&ire, &first, &first, &points, &four, columns, values);
  for (k = 0; k < points; k++) {
    if (fabs(values[3 * points + k]) > fabs(values[3 * points + largest])) largest = k;
  }
  close_to(values[3 * points + largest], 1007.534, 0.005 * 1007.534, "largest von Mises stress", ire, 11);
  close_to(values[largest], 0.2, 0.21, "its x", ire, 11);
  close_to(values[points + largest], -0.6, 0.21, "its y", ire, 11);
  close_to(values[2 * points + largest], 0.0, 1e-8, "its z", ire, 11);
}

int main(int argc, char **argv) {
  char name[500];
  FILE *file;
  int ire, step;

  if (argc != 2) return 2;
  snprintf(name, sizeof name, "%s/MBench_UIC60_v3.prr", argv[1]);
  file = fopen(name, "r");
  if (file == NULL) {
    printf("skipped: the profiles of the benchmark are not in %s\n", argv[1]);
    return 77;
  }
  fclose(file);
  for (ire = 1; ire <= 2; ire++) set_up(ire, ire - 1, argv[1]);
  for (step = 1; step <= number_of_steps; step++) {
    for (ire = 1; ire <= 2; ire++) one_step(ire, step);
    if (step == 11) stresses();
  }
  cntc_finalizelast();
  printf("manchester: %d checks, %d failed\n", checks, failures);
  return failures != 0;
}
