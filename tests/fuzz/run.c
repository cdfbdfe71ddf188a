/* Input files, run with limits of time, memory and elements */
#include "contact.h"
#include "experiment.h"
#include "fuzz.h"

const char fuzz_name[] = "run";

void fuzz_begin(void) {}

void fuzz_text(const char *text, size_t length)
{
  fuzz_write("fuzz.inp", text, length);
  run_experiment(CONTACT_RUN, 0);
}
