/* Wheel and rail for tests of hosts: S1002 on 60E1, nearly free rolling under 10 kN; all settings except the position */
#ifndef PAIR_H
#define PAIR_H

#include <caddon_flags.h>
#include <contact_addon.h>
#include <stdio.h>

/* The profile of the rail (0) or the wheel (1), from a file */
static inline void set_profile(int ire, const char *folder, const char *file, int which) {
  char name[1000];
  const double reals[] = {1.0, 0.0};
  const int length = snprintf(name, sizeof name, "%s/%s", folder, file), one = 1, two = 2;
  cntc_setprofileinputfname(&ire, name, &length, &one, &which, &two, reals);
}

/* ire      a result element of module 1
 * folder   with the profiles of the examples
 * element  size of the elements [mm] */
static inline void set_up_pair(int ire, const char *folder, double element) {
  const int whole = -1, zero = 0, two = 2, three = 3, four = 4, five = 5, six = 6, eleven = 11;
  const int flags[] = {CNTC_ic_config, CNTC_ic_tang, CNTC_ic_output, CNTC_ic_flow}, digits[] = {0, 3, 0, 0};
  const double material[] = {0.28, 0.28, 82000.0, 82000.0}, friction[] = {0.3, 0.3};
  const double grid[] = {element, element, 1.5708, 8.0, 4.0}, track[11] = {14.0, 0.0, 1435.0, 0.025}, wheelset[] = {1360.0, -70.0, 460.0};
  const double velocity[6] = {2000.0, 0.0, 0.0, 0.0, 0.0, -4.34657}, fz = 10000.0, chi = 0.0, step = 1.0;
  cntc_setflags(&ire, &whole, &four, flags, digits);
  cntc_setmaterialparameters(&ire, &whole, &zero, &four, material);
  cntc_setfrictionmethod(&ire, &whole, &zero, &two, friction);
  cntc_setpotcontact(&ire, &whole, &whole, &five, grid);
  cntc_setrollingstepsize(&ire, &whole, &chi, &step);
  cntc_settrackdimensions(&ire, &three, &eleven, track);
  cntc_setwheelsetdimensions(&ire, &three, &three, wheelset);
  set_profile(ire, folder, "60E1.prr", 0);
  set_profile(ire, folder, "S1002.prw", 1);
  cntc_setwheelsetvelocity(&ire, &two, &six, velocity);
  cntc_setverticalforce(&ire, &fz);
}

#endif
