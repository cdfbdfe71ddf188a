/* Target: the data that --resume reads of an interrupted run: journal, end of the results, HDF5 file, input
 *
 * A run of four cases is ended before the last one. The text changes its files, and the run is resumed. The text has
 * sections; the line before each names the file that is changed:
 *
 *   @words         words of the journal: number of line, number of word, new word; the line gets its hash
 *   @unfinished    the whole journal, each line gets its hash
 *   @journal       the same, with the given hashes
 *   @out @jsonl @pvd @inp     the whole of this file
 *   @cut           name of one of these and h5, and its new length, -n for n bytes less
 *   @h5            bytes of the HDF5 file: position, value; negative positions count from the end
 *
 * A run that is marked as complete must have the report of an uninterrupted run, unless journal or report were changed
 * intentionally. */
#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "fuzz.h"

const char fuzz_name[] = "resume";

int fuzz_run(int resume, char *message, int length);
long fuzz_hash(const char *line, int length);

/* Shifts of a ball on a few elements */
static const char first_case[] = "3 MODULE\n201120\n0022020\n00001201\n100 100 30 1 1e-5\n9.1954 -0.2 0 0\n0.4 0.4\n"
  "0.42 0.42 200 200\n1\n5 5 -0.5 -0.5 0.2 0.2\n1 1\n0.01 0 0.01 0 0 0\n";
static const char next_case[] = "3 MODULE\n001120\n0101001\n00111201\n9.1954 -0.%d 0 0\n";

enum { file_count = 6 };
static const char *const suffixes[file_count] = {"inp", "unfinished", "out", "jsonl", "pvd", "h5"};
/* Files of the interrupted run, in the order of the suffixes */
static struct { char *bytes; size_t length; } left[file_count], now[file_count];
/* The report of an uninterrupted run without its times */
static char *whole_report;

/* A file of the run; NULL if it does not exist */
static char *read_file(const char *suffix, size_t *length)
{
  char name[40], *bytes;
  FILE *file;
  long size;
  snprintf(name, sizeof name, "fuzz.%s", suffix);
  file = fopen(name, "r");
  *length = 0;
  if (!file) return NULL;
  fseek(file, 0, SEEK_END);
  size = ftell(file);
  rewind(file);
  bytes = malloc((size_t)size + 1);
  if (bytes) *length = fread(bytes, 1, (size_t)size, file), bytes[*length] = '\0';
  fclose(file);
  return bytes;
}

static void write_file(int k)
{
  char name[40];
  snprintf(name, sizeof name, "fuzz.%s", suffixes[k]);
  if (now[k].bytes) fuzz_write(name, now[k].bytes, now[k].length);
}

/* The report without lines of times */
static char *report(void)
{
  size_t length;
  char *text = read_file("out", &length), *to = text;
  if (!text) return NULL;
  for (const char *line = text; *line;) {
    size_t n = strcspn(line, "\n");
    n += line[n] == '\n';
    if (*line != '|') memmove(to, line, n), to += n;
    line += n;
  }
  *to = '\0';
  return text;
}

void fuzz_begin(void)
{
  static char input[2000], message[4000];
  int n = snprintf(input, sizeof input, "%s", first_case);
  for (int k = 0; k < 3; k++) {
    if (k == 2) {
      char broken[2100];
      snprintf(broken, sizeof broken, "%snonsense\n", input);
      fuzz_write("fuzz.inp", broken, strlen(broken));
      if (fuzz_run(0, message, sizeof message) == 0) fuzz_fail("the run should end before its last case");
      for (int i = 1; i < file_count; i++)
        if (!(left[i].bytes = read_file(suffixes[i], &left[i].length))) fuzz_fail("an interrupted run has no .%s", suffixes[i]);
      fuzz_tidy();
    }
    n += snprintf(input + n, sizeof input - (size_t)n, next_case, k + 2);
  }
  snprintf(input + n, sizeof input - (size_t)n, "0 MODULE\n");
  left[0].bytes = strdup(input);
  left[0].length = strlen(input);
  fuzz_write("fuzz.inp", input, strlen(input));
  if (fuzz_run(0, message, sizeof message) != 0) fuzz_fail("no good run: %s", message);
  whole_report = report();
  fuzz_tidy();
}

/* A line of a text: its begin and its length without the end; 0 at the end of the text */
static int next_line(const char **text, const char *end, const char **line, size_t *length)
{
  const char *last;
  if (*text >= end) return 0;
  *line = *text;
  last = memchr(*line, '\n', (size_t)(end - *line));
  *length = (size_t)((last ? last : end) - *line);
  *text = last ? last + 1 : end;
  return 1;
}

static void replace(int k, char *bytes, size_t length)
{
  if (now[k].bytes != left[k].bytes) free(now[k].bytes);
  now[k].bytes = bytes;
  now[k].length = length;
}

/* Begin of a word of a line, and its length; 0 if the line has fewer words */
static size_t find_word(const char *line, size_t length, int number, const char **word)
{
  size_t k = 0;
  for (;;) {
    size_t first;
    while (k < length && line[k] == ' ') k++;
    if (k == length) return 0;
    first = k;
    while (k < length && line[k] != ' ') k++;
    if (--number == 0) {
      *word = line + first;
      return k - first;
    }
  }
}

/* The journal with a hash for each line after the first, and with one word of one line replaced; line 0 for none */
static void seal(const char *journal, size_t size, int drop_old, int line_number, int word_number, const char *new_word)
{
  char *made = malloc(2*size + 100000);
  size_t n = 0, length;
  const char *line, *text = journal, *end = journal + size;
  for (int k = 1; made && n < size + 50000 && next_line(&text, end, &line, &length); k++) {
    size_t begin = n, old = 0;
    const char *word = line;
    if (drop_old && k > 1) while (length && line[length - 1] != ' ') length--;
    while (k > 1 && length && line[length - 1] == ' ') length--;
    if (k == line_number) old = find_word(line, length, word_number, &word);
    memcpy(made + n, line, (size_t)(word - line));
    n += (size_t)(word - line);
    if (old) n += (size_t)sprintf(made + n, "%s", new_word);
    memcpy(made + n, word + old, length - old - (size_t)(word - line));
    n += length - old - (size_t)(word - line);
    if (k > 1) n += (size_t)sprintf(made + n, " %ld", fuzz_hash(made + begin, (int)(n - begin)));
    made[n++] = '\n';
  }
  replace(1, made, n);
}

static int find_file(const char *name, size_t length)
{
  for (int k = 0; k < file_count; k++)
    if (strlen(suffixes[k]) == length && strncmp(suffixes[k], name, length) == 0) return k;
  return -1;
}

/* Position in a file, from its begin or its end */
static size_t place_of(long place, size_t length)
{
  if (place < 0) place += (long)length;
  return place < 0 ? 0 : (size_t)place < length ? (size_t)place : length;
}

/* Apply one section; returns whether the report can no longer be checked */
static int change(const char *name, size_t name_length, const char *body, const char *end)
{
  const char *line;
  size_t length;
  char word[100], suffix[20];
  int k, at, number;
  long place, value;
  if (name_length == 5 && strncmp(name, "words", 5) == 0) {
    while (next_line(&body, end, &line, &length))
      if (sscanf(line, "%d %d %99s", &at, &number, word) == 3) seal(now[1].bytes, now[1].length, 1, at, number, word);
    return 1;
  }
  if (name_length == 3 && strncmp(name, "cut", 3) == 0) {
    while (next_line(&body, end, &line, &length)) {
      if (sscanf(line, "%19s %ld", suffix, &place) != 2 || (k = find_file(suffix, strlen(suffix))) < 0) continue;
      now[k].length = place_of(place, now[k].length);
    }
    return 0;
  }
  if (name_length == 2 && strncmp(name, "h5", 2) == 0) {
    char *copy = malloc(left[5].length + 1);
    if (!copy) return 0;
    memcpy(copy, left[5].bytes, left[5].length);
    replace(5, copy, left[5].length);
    while (next_line(&body, end, &line, &length))
      if (sscanf(line, "%ld %ld", &place, &value) == 2 && place_of(place, now[5].length) < now[5].length)
        now[5].bytes[place_of(place, now[5].length)] = (char)value;
    return 0;
  }
  if (name_length == 7 && strncmp(name, "journal", 7) == 0) name = suffixes[1], name_length = strlen(name), number = 0;
  else number = 1;
  k = find_file(name, name_length);
  if (k < 0 || k == 5) return 0;
  if (k == 1 && number) {
    seal(body, (size_t)(end - body), 0, 0, 0, "");
  } else {
    char *copy = malloc((size_t)(end - body) + 1);
    if (copy) memcpy(copy, body, (size_t)(end - body));
    replace(k, copy, (size_t)(end - body));
  }
  return 1;
}

void fuzz_text(const char *text, size_t length)
{
  static char message[4000];
  const char *end = text + length, *line, *body = NULL, *name = NULL;
  size_t n, name_length = 0;
  int status, on_purpose = 0;
  char *found;
  memcpy(now, left, sizeof now);
  while (text <= end) {
    const char *here = text;
    int more = next_line(&text, end, &line, &n);
    if (!more || *line == '@') {
      if (name) on_purpose |= change(name, name_length, body, here);
      if (!more) break;
      name = line + 1;
      name_length = n - 1;
      body = text;
    }
  }
  for (int k = 0; k < file_count; k++) {
    write_file(k);
    if (now[k].bytes != left[k].bytes) free(now[k].bytes);
  }
  message[0] = '\0';
  status = fuzz_run(1, message, sizeof message);
  fuzz_tell("status %d: %s", status, message);
  if (status != 0) fuzz_check_message(message, "the run fails");
  if (on_purpose) return;
  found = report();
  if (status == 0 && (!found || strcmp(found, whole_report) != 0)) {
    size_t k = found ? strspn(found, "") : 0;
    while (found && found[k] && found[k] == whole_report[k]) k++;
    fuzz_fail("the report differs after byte %zu: %.300s", k, found ? found + k : "there is none");
  }
  free(found);
}
