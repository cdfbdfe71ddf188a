#include "experiment.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "contact.h"
#include "fuzz.h"

/* Failures by a wrong text, as src/capi/run.f90 counts them */
enum { status_input = 11 };

/* "name.suffix:12:3: ", or "name.suffix: " for the file as a whole, at the beginning */
static int names_a_place(const char *message)
{
  const char *colon = strchr(message, ':');
  return colon && memchr(message, '.', (size_t)(colon - message)) && (isdigit((unsigned char)colon[1]) || colon[1] == ' ');
}

int run_experiment(int mode, int extra)
{
  static char message[4000];
  int status;
  message[0] = '\0';
  /* half a second, 200 MB and 2500 elements a case */
  status = contact_run_limited("fuzz", mode, NULL, 1, (mode == CONTACT_RUN ? CONTACT_WRITE_JSON : 0) + extra, 0, 0.5, 200.0,
    2500.0, message, sizeof message);
  fuzz_tell("status %d: %s", status, message);
  if (status == 1) fuzz_fail("the call is refused: %s", message);
  if (status != 0) fuzz_check_message(message, "the run fails");
  if (status == status_input && !names_a_place(message)) fuzz_fail("an error of the text without its position: %s", message);
  if (status == 0 && message[0]) fuzz_fail("success with a message: %s", message);
  if (mode == CONTACT_RUN) fuzz_check_report("fuzz.out");
  return status;
}
