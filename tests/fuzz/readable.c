/* Input files in the readable format: run, explained, and converted to the other format, which must give the same results */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "contact.h"
#include "experiment.h"
#include "fuzz.h"

const char fuzz_name[] = "readable";

/* Maximum length of the file of totals that is compared */
enum { longest_line = 20000 };

void fuzz_begin(void) {}

/* Remove the number after a name, which may differ */
static void forget(char *line, const char *name)
{
  char *place = strstr(line, name);
  if (!place) return;
  place += strlen(name);
  memmove(place, place + strcspn(place, ",}"), strlen(place + strcspn(place, ",}")) + 1);
}

/* The totals of both runs must be identical, except for time and line numbers */
static void compare_totals(const char *first_name, const char *second_name)
{
  static char first[longest_line], second[longest_line];
  FILE *files[2] = {fopen(first_name, "r"), fopen(second_name, "r")};
  int more = files[0] && files[1];
  if (!more) fuzz_fail("there are no totals of both formats");
  while (more) {
    const char *a = fgets(first, sizeof first, files[0]), *b = fgets(second, sizeof second, files[1]);
    more = a && b;
    if (!a != !b) fuzz_fail("one format has more cases than the other");
    if (!more) break;
    forget(first, "\"line\":"), forget(first, "\"seconds\":");
    forget(second, "\"line\":"), forget(second, "\"seconds\":");
    /* this case ran out of time in one of both */
    if (strstr(first, "limit") || strstr(second, "limit")) break;
    if (strcmp(first, second) != 0) fuzz_fail("the other format has other results:\n%s%s", first, second);
  }
  fclose(files[0]);
  fclose(files[1]);
}

void fuzz_text(const char *text, size_t length)
{
  static char message[4000], words[4000];
  int status, needed = 0;
  fuzz_write("fuzz.toml", text, length);
  status = contact_explain_experiment("fuzz.toml", words, sizeof words, &needed);
  if (status != 0 && !words[0]) fuzz_fail("no message about the missing explanation");
  /* the other format has no word for the order, which is therefore the same in both */
  status = run_experiment(CONTACT_RUN, CONTACT_SECOND_ORDER);
  if (status != 0) return;
  message[0] = '\0';
  status = contact_convert_experiment("fuzz.toml", NULL, 0, message, sizeof message);
  fuzz_tell("converted %d: %s", status, message);
  if (status != 0) {
    fuzz_check_message(message, "the conversion fails");
    return;
  }
  if (rename("fuzz.jsonl", "first.jsonl") != 0 || remove("fuzz.toml") != 0) fuzz_fail("the run left no totals");
  status = run_experiment(CONTACT_RUN, CONTACT_SECOND_ORDER);
  /* one of two equal runs may run out of time */
  if (status == status_time) return;
  if (status != 0) fuzz_fail("a case runs in one format and fails in the other");
  compare_totals("first.jsonl", "fuzz.jsonl");
}
