/* Cases in memory: texts of the readable format with arbitrary values of numbers, and result arrays of arbitrary size
 *
 * The first line may contain sizes of the arrays, the names of varied numbers and their values:
 *     # rows columns cases reason_length | group.key group.key | value value ...
 * Arrays have exactly these sizes, so that each access beyond their end is found by the address sanitizer. */
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "contact.h"
#include "fuzz.h"

const char fuzz_name[] = "batch";

enum { most_values = 12, most_names = 4, most_room = 200, name_room = 400, longest_side = 60, last_missed = 5, out_of_time = 5 };
/* Contents of the arrays before a call */
static const double unset = -7.77e77;

struct arrays {
  contact_batch_job job;
  double given[most_values];
  char names[name_room];
};

void fuzz_begin(void) {}

/* Is the number of elements so large that it takes too much time and memory, which a batch does not limit? */
static int has_many_elements(const char *text)
{
  static const char *const keys[] = {"mx", "my", "npot_max", "nx", "ny", "nz"};
  size_t k;
  for (k = 0; k < sizeof keys / sizeof *keys; k++) {
    const char *place = text;
    while ((place = strstr(place, keys[k])) != NULL) {
      const char *equals = place + strlen(keys[k]);
      while (*equals == ' ' || *equals == '=' || *equals == '\t') equals++;
      if (strtod(equals, NULL) > longest_side) return 1;
      place++;
    }
  }
  return 0;
}

/* Sizes, names and values of the first line; without them the cases of the text are solved unchanged */
static void read_line(const char *text, struct arrays *all)
{
  contact_batch_job *job = &all->job;
  const char *names = strchr(text, '|'), *end = text + strcspn(text, "\n"), *values;
  char *next;
  size_t used = 0;
  int found = 0;
  memset(all, 0, sizeof *all);
  job->room_rows = 30, job->room_columns = 100, job->room_cases = 20, job->reason_length = 80;
  if (*text != '#') return;
  if (sscanf(text, "# %d %d %d %d", &job->room_rows, &job->room_columns, &job->room_cases, &job->reason_length) < 4) {
    job->room_rows = 1, job->room_columns = 1, job->room_cases = 1, job->reason_length = 1;
  }
  job->room_rows %= most_room, job->room_columns %= most_room, job->room_cases %= most_room, job->reason_length %= most_room;
  if (!names || names > end) return;
  values = strchr(++names, '|');
  if (!values || values > end) return;
  while (names < values && found < most_names) {
    size_t length = strcspn(names, " |\n");
    if (length > 0 && used + length + 2 < name_room) {
      if (found > 0) all->names[used++] = '\n';
      memcpy(all->names + used, names, length);
      used += length;
      found++;
    }
    names += length + (*names != '|');
    if (length == 0 && *names == '|') break;
  }
  job->names = all->names;
  job->numbers = found;
  if (found == 0) return;
  found = 0;
  for (values++; values < end && found < most_values; values = next) {
    all->given[found] = strtod(values, &next);
    if (next == values) break;
    found++;
  }
  job->given = all->given;
  job->sets = found / job->numbers;
}

static void *room(size_t count, size_t size) { return malloc(count * size > 0 ? count * size : 1); }

static int positive(int n) { return n > 0 ? n : 0; }

/* Initialise the arrays */
static void make_arrays(contact_batch_job *job)
{
  const size_t rows = positive(job->room_rows), columns = positive(job->room_columns), cases = positive(job->room_cases);
  const size_t length = positive(job->reason_length);
  size_t k;
  job->values = room(rows * columns, sizeof *job->values);
  job->places = room(rows * 2, sizeof *job->places);
  job->states = room(cases * 2, sizeof *job->states);
  job->reasons = room(cases * length, 1);
  for (k = 0; k < rows * columns; k++) job->values[k] = unset;
  for (k = 0; k < rows * 2; k++) job->places[k] = -1;
  for (k = 0; k < cases * 2; k++) job->states[k] = -1;
  memset(job->reasons, '?', cases * length);
}

static void free_arrays(contact_batch_job *job)
{
  free(job->values), free(job->places), free(job->states), free(job->reasons);
}

/* The arrays contain the reported numbers of results and nothing else; results are finite */
static void judge(const contact_batch_job *job)
{
  int k, column;
  if (job->rows < 0 || job->rows > positive(job->room_rows) || job->cases < 0 || job->cases > positive(job->room_cases))
    fuzz_fail("%d rows and %d cases, more than the size of the arrays", job->rows, job->cases);
  for (k = 0; k < job->rows; k++) {
    if (job->places[2 * k] < 1 || job->places[2 * k] > job->cases || job->places[2 * k + 1] < 0)
      fuzz_fail("row %d belongs to case %d, patch %d", k + 1, job->places[2 * k], job->places[2 * k + 1]);
    if (job->states[2 * (job->places[2 * k] - 1)] != CONTACT_SOLVED) continue;
    for (column = 0; column < job->room_columns; column++)
      if (!isfinite(job->values[k * job->room_columns + column])) fuzz_fail("a solved case has no number in column %d", column + 1);
  }
  for (k = job->rows * job->room_columns; k < job->room_rows * job->room_columns; k++)
    if (job->values[k] != unset) fuzz_fail("a value beyond the last row was changed");
  for (k = 0; k < job->cases; k++) {
    const char *reason = job->reasons + (size_t)k * positive(job->reason_length);
    if (job->states[2 * k] < CONTACT_SOLVED || job->states[2 * k] > CONTACT_REFUSED || job->states[2 * k + 1] < 0
        || job->states[2 * k + 1] > last_missed)
      fuzz_fail("case %d has state %d, missed %d", k + 1, job->states[2 * k], job->states[2 * k + 1]);
    if (job->states[2 * k] == CONTACT_SOLVED || job->reason_length < 1) continue;
    if (!memchr(reason, '\0', (size_t)job->reason_length)) continue;
    if (job->reason_length > 1 && !*reason) fuzz_fail("no reason for state %d of case %d", job->states[2 * k], k + 1);
  }
}

/* Columns, and fields of the last case */
static void look(contact_batch *batch, const contact_batch_job *job)
{
  static char name[40], unit[40], meaning[40];
  double frame[4];
  int k, mx, my, patch;
  for (k = 0; k <= job->columns + 1; k++) {
    const int kind = contact_batch_column(batch, k, name, unit, meaning, sizeof name);
    if (kind != -1 && (kind < 0 || kind > 3 || !name[0])) fuzz_fail("column %d is of kind %d", k, kind);
    if ((kind == -1) != (k < 1 || k > job->columns)) fuzz_fail("column %d of %d has kind %d", k, job->columns, kind);
  }
  for (patch = 0; patch < 3; patch++) {
    double *values;
    int found;
    if (contact_batch_field(batch, patch, "pn", &mx, &my, frame, unit, sizeof unit) != 0) continue;
    if (mx < 1 || my < 1) fuzz_fail("a field of %d x %d elements", mx, my);
    values = room((size_t)mx * my, sizeof *values);
    if (contact_batch_field_values(batch, patch, "pn", mx * my - 1, values) != 1) fuzz_fail("a field larger than its array was returned");
    found = contact_batch_field_values(batch, patch, "pn", mx * my, values);
    if (found != 0) fuzz_fail("an existing field was not returned");
    for (k = 0; k < mx * my; k++)
      if (!isfinite(values[k])) fuzz_fail("a pressure is not a number");
    free(values);
  }
}

/* Two calls without a case that ran out of time must give the same results */
static void compare(const contact_batch_job *first, const contact_batch_job *second, const char *what)
{
  int k;
  for (k = 0; k < first->cases && k < second->cases; k++)
    if (first->states[2 * k + 1] == out_of_time || second->states[2 * k + 1] == out_of_time) return;
  if (first->rows != second->rows || first->cases != second->cases) fuzz_fail("%s has other rows or cases", what);
  if (memcmp(first->states, second->states, sizeof(int) * 2 * (size_t)first->cases) != 0) fuzz_fail("%s has other states", what);
  if (memcmp(first->values, second->values, sizeof(double) * (size_t)first->rows * positive(first->room_columns)) != 0)
    fuzz_fail("%s has other results", what);
}

void fuzz_text(const char *text, size_t length)
{
  static struct arrays first, again, fresh;
  struct arrays *const all[3] = {&first, &again, &fresh};
  static char message[3][400];
  contact_batch *batches[2];
  int k, status[3];
  (void)length;
  if (has_many_elements(text)) return;
  for (k = 0; k < 2; k++) {
    batches[k] = contact_batch_open(1, 0.5);
    if (!batches[k]) fuzz_fail("no batch");
  }
  for (k = 0; k < 3; k++) {
    read_line(text, all[k]);
    all[k]->job.text = text;
    make_arrays(&all[k]->job);
    status[k] = contact_batch_solve(batches[k == 2], &all[k]->job, message[k], sizeof message[k]);
    if (k == 0) fuzz_tell("status %d, %d cases, %d rows: %s", status[0], first.job.cases, first.job.rows, message[0]);
    if (status[k] != 0) fuzz_check_message(message[k], "the batch fails");
    if (status[k] == 0 && message[k][0]) fuzz_fail("success with a message: %s", message[k]);
    judge(&all[k]->job);
    look(batches[k == 2], &all[k]->job);
  }
  if (status[0] != status[2] || strcmp(message[0], message[2]) != 0) fuzz_fail("a new batch reports: %s\nnot: %s", message[2], message[0]);
  compare(&first.job, &fresh.job, "a new batch");
  if (status[0] == status[1]) compare(&first.job, &again.job, "the same text again");
  for (k = 0; k < 3; k++) free_arrays(&all[k]->job);
  for (k = 0; k < 2; k++) contact_batch_close(batches[k]);
}
