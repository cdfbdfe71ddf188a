/* Target: files of influence coefficients (C = 9)
 *
 * The first line of the text chooses the case that uses the file: 0 a shift, 1 steady rolling, 2 wheel on rail; the rest is
 * the file. */
#include <stdio.h>
#include <string.h>

#include "contact.h"
#include "experiment.h"
#include "fuzz.h"

const char fuzz_name[] = "coefficients";

/* 3 x 3 elements of 0.1 mm, or a wheel on a rail with elements of 2 mm */
static const char *const cases[] = {
  "3 MODULE\n201100\n029020\n0001201\n999 100 30 1 1e-5\n0.002 0.001 0 0\n0.3 0.3\n'fuzz.txt'\n0.3 0.3 1 1\n1\n"
  "3 3 -0.15 -0.15 0.1 0.1\n1 1\n0.5 0 0.5 0 0 0\n0 MODULE\n",
  "3 MODULE\n203100\n029020\n0001201\n999 100 30 1 1e-5\n0.002 0.001 0 0\n0.3 0.3\n0 0.1 1000\n'fuzz.txt'\n0.3 0.3 1 1\n1\n"
  "3 3 -0.15 -0.15 0.1 0.1\n1 1\n0.5 0 0.5 0 0 0\n0 MODULE\n",
  "1 MODULE\n1203100\n0029033\n0001201\n999 100 30 1 1e-5\n0.3 0.3\n'fuzz.txt'\n0.28 0.28 82000 82000\n2 2 1 90d 8 4\n"
  "14 0 1435 0.025\n'profiles/60E1.prr' 0 1 0\n0 0 0 0 0 0\n1360 -70 460\n'profiles/S1002.prw' 0 1 0\n0 0 60000 0 0 0\n"
  "20000 0 0 0 0 -43.5\n0 MODULE\n"};

void fuzz_begin(void) {}

void fuzz_text(const char *text, size_t length)
{
  const char *file = strchr(text, '\n');
  unsigned choice = (unsigned)(*text - '0');
  if (!file || choice >= sizeof cases / sizeof cases[0]) return;
  file++;
  fuzz_write("fuzz.txt", file, length - (size_t)(file - text));
  fuzz_write("fuzz.inp", cases[choice], strlen(cases[choice]));
  run_experiment(CONTACT_RUN, 0);
}
