/* Files of profiles
 *
 * The first line of the text has the name and the options of reading, the rest is the file:
 *
 *     rail.prr  KIND MIRRORY MIRRORZ ERRORS METHOD  SCALE SMOOTH MAXOMIT ZIGTHRS KINKHIGH KINKLOW KINKWID
 *
 * The name begins with rail or wheel, and its suffix chooses the format. Only the numbers of this line are passed. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "caddon_flags.h"
#include "contact.h"
#include "contact_addon.h"
#include "fuzz.h"

const char fuzz_name[] = "profile";

static int element = 1, whole = -1;

void fuzz_begin(void)
{
  /* slices are named like this in files of slices */
  static const char rail[] = "-30 5\n-20 1\n0 0\n20 1\n30 5\n36 20\n", wheel[] = "60 -2\n30 -1\n0 0\n-20 2\n-30 8\n-40 27\n-55 20\n";
  fuzz_write("a.txt", rail, sizeof rail - 1);
  fuzz_write("b.txt", rail, sizeof rail - 1);
  fuzz_write("c.txt", wheel, sizeof wheel - 1);
  fuzz_write("d.txt", wheel, sizeof wheel - 1);
}

/* All getters of the profile return finite numbers */
static void ask(void)
{
  for (int kind = 0; kind <= 1; kind++)
    for (int task = -1; task <= 8; task++) {
      int ints[] = {kind, 0}, nints = 2, nreals = 3, length = 200;
      double reals[] = {0.5, 0.0, 0.0}, values[200] = {0};
      cntc_getprofilevalues(&element, &task, &nints, ints, &nreals, reals, &length, values);
      for (int k = 0; k < length; k++)
        if (!isfinite(values[k])) fuzz_fail("task %d of cntc_getprofilevalues: value %d is %g", task, k, values[k]);
    }
}

void fuzz_text(const char *text, size_t length)
{
  static char message[4000];
  const char *file = strchr(text, '\n'), *number;
  char name[40];
  int ints[6] = {0}, given[5], nints = 6, nreals = 0, module = 1, version, code, name_length, folder_length = 0;
  double reals[7];
  size_t n;
  if (!file) return;
  n = strcspn(text, " \t\n");
  if (n == 0 || n >= sizeof name || memchr(text, '/', n) || memchr(text, '\\', n)) return;
  memcpy(name, text, n);
  name[n] = '\0';
  if (strncmp(name, "rail", 4) != 0 && strncmp(name, "wheel", 5) != 0) return;
  name_length = (int)n;
  number = text + n;
  for (int k = 0; k < 5; k++) {
    char *next;
    given[k] = number < file ? (int)strtol(number, &next, 10) : 0;
    if (number < file) number = next;
  }
  while (nreals < 7 && number < file) {
    char *next;
    reals[nreals] = strtod(number, &next);
    if (next == number || next > file) break;
    number = next;
    nreals++;
  }
  ints[0] = given[0];
  memcpy(ints + 2, given + 1, 4 * sizeof *ints);
  file++;
  fuzz_write(name, file, length - (size_t)(file - text));

  cntc_initialize(&element, &module, &version, &code, "", &folder_length);
  if (code < 0) fuzz_fail("cntc_initialize ends with %d", code);
  cntc_setprofileinputfname(&element, name, &name_length, &nints, ints, &nreals, reals);
  code = contact_last_error(element, whole, message, sizeof message);
  fuzz_tell("%s: code %d: %s", name, code, message);
  if (code != 0) fuzz_check_message(message, "a profile is refused");
  ask();
  cntc_finalizelast();
}
