/* Calls of the library in any order, with any values
 *
 * The text has one call on a line: name and arguments as in src/capi/interface.txt, separated by blanks. A scalar is a number,
 * an array a list in brackets, a text is in quotes, ~ is a null pointer. Missing values are 0. Arrays have the length passed
 * in the call, independent of the values given, so that each access beyond their end is a fault of the library; checked by
 * the address sanitizer. */
#define _GNU_SOURCE
#include <ctype.h>
#include <dlfcn.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "caddon_flags.h"
#include "contact.h"
#include "contact_addon.h"
#include "fuzz.h"

const char fuzz_name[] = "calls";

enum { max_arguments = 12, max_routines = 100, longest_array = 20000, max_calls = 60 };

struct argument {
  char name[24];
  /* i or o for in or out, b for both; i, r or t for integer, real number or text */
  char direction, kind;
  int is_array;
};

struct routine {
  char name[40];
  int count;
  struct argument arguments[max_arguments];
  void (*entry)(void *, void *, void *, void *, void *, void *, void *, void *, void *, void *, void *, void *);
};

static struct routine routines[max_routines];
static int routine_count;
/* Contents of outputs before a call */
static const int unset = -777777;

/* Parse "in int lenarr" or "out real values[lenarr]"; returns the rest */
static const char *read_argument(const char *text, struct argument *argument)
{
  char direction[8], kind[8], name[24];
  int n = 0;
  if (sscanf(text, " %7s %7s %23[^],)[]%n", direction, kind, name, &n) != 3) return NULL;
  argument->direction = strcmp(direction, "inout") == 0 ? 'b' : direction[0];
  argument->kind = kind[0];
  snprintf(argument->name, sizeof argument->name, "%s", name);
  text += n;
  argument->is_array = *text == '[';
  if (argument->is_array) {
    text = strchr(text, ']');
    if (text) text++;
  }
  return text;
}

void fuzz_begin(void)
{
  char line[1000], path[PATH_MAX];
  FILE *file;
  snprintf(path, sizeof path, "%s/src/capi/interface.txt", getenv("CONTACT_SOURCE"));
  file = fopen(path, "r");
  while (file && fgets(line, sizeof line, file)) {
    struct routine *this = &routines[routine_count];
    char *bracket = strchr(line, '(');
    const char *rest;
    if ((strncmp(line, "cntc_", 5) != 0 && strncmp(line, "subs_", 5) != 0) || !bracket) continue;
    *bracket = '\0';
    snprintf(this->name, sizeof this->name, "%.39s", line);
    for (rest = bracket + 1; *rest && *rest != ')' && this->count < max_arguments; this->count++) {
      rest = read_argument(rest, &this->arguments[this->count]);
      if (!rest) fuzz_fail("src/capi/interface.txt cannot be read at %s", this->name);
      rest += *rest == ',';
    }
    *(void **)&this->entry = dlsym(RTLD_DEFAULT, this->name);
    if (!this->entry) fuzz_fail("%s is not in the library", this->name);
    if (++routine_count == max_routines) break;
  }
  if (file) fclose(file);
  if (routine_count < 60) fuzz_fail("%d routines are known, not 70", routine_count);
}

/* One argument of a call: scalars in the value itself */
struct value {
  int is_null, given;
  int i;
  double r;
  void *array;
  size_t length;
};

/* Position after the name in the text of one call */
struct reader {
  const char *at, *end;
};

static void skip_blanks(struct reader *text)
{
  while (text->at < text->end && isspace((unsigned char)*text->at)) text->at++;
}

static int as_integer(double value) { return value >= INT_MIN && value <= INT_MAX ? (int)value : unset; }

/* Read a number; false at the end or if there is none */
static int read_number(struct reader *text, double *value)
{
  char *next;
  skip_blanks(text);
  if (text->at >= text->end) return 0;
  *value = strtod(text->at, &next);
  if (next == text->at || next > text->end) return 0;
  text->at = next;
  return 1;
}

/* Argument k of a call by its name */
static struct value *find(struct routine *this, struct value *values, const char *name)
{
  for (int k = 0; k < this->count; k++)
    if (strcmp(this->arguments[k].name, name) == 0) return &values[k];
  return NULL;
}

static size_t length_of(const struct value *value)
{
  return value && !value->is_null && value->i > 0 ? (size_t)value->i : 0;
}

/* Number of elements of array k that the library may use: as passed in the call, 20000 at most */
static size_t honest_length(struct routine *this, struct value *values, int k)
{
  const char *name = this->arguments[k].name;
  char length_name[32];
  if (strcmp(this->name, "cntc_getsensitivities") == 0)
    return length_of(find(this, values, "lenout")) * length_of(find(this, values, "lenin"));
  if (strcmp(this->name, "cntc_setprofileinputvalues") == 0 && strcmp(name, "values") == 0)
    return 2 * length_of(find(this, values, "npoint"));
  if (strcmp(this->name, "subs_getresults") == 0 && strcmp(name, "values") == 0)
    return length_of(find(this, values, "lenarr")) * length_of(find(this, values, "ncol"));
  if (strcmp(this->name, "subs_getresults") == 0) return length_of(find(this, values, "ncol"));
  if (strcmp(this->name, "subs_addblock") == 0) {
    snprintf(length_name, sizeof length_name, "np%c", *name);
    return length_of(find(this, values, length_name));
  }
  if (this->arguments[k].kind == 't') {
    snprintf(length_name, sizeof length_name, "len_%s", name + 2);
    return length_of(find(this, values, length_name));
  }
  while (k > 0)
    if (!this->arguments[--k].is_array && strchr("nl", this->arguments[k].name[0])) return length_of(&values[k]);
  return 0;
}

/* Read letters in quotes; only names in the folder of the target are possible */
static void read_text(struct reader *text, char *letters, size_t room)
{
  char quote;
  skip_blanks(text);
  if (text->at >= text->end || (*text->at != '\'' && *text->at != '"')) return;
  for (quote = *text->at++; text->at < text->end && *text->at != quote; text->at++) {
    char letter = *text->at;
    if (letter == '\\' || (letter == '/' && strncmp(text->at - 8, "profiles", 8) != 0)) letter = '_';
    if (room) *letters++ = letter, room--;
  }
  text->at += text->at < text->end;
}

/* Read scalars first: lengths may follow their arrays */
static void read_values(struct routine *this, struct reader text, struct value *values, int arrays)
{
  for (int k = 0; k < this->count; k++) {
    struct argument *argument = &this->arguments[k];
    struct value *value = &values[k];
    double number;
    size_t n = 0, size = argument->kind == 't' ? 1 : argument->kind == 'i' ? sizeof(int) : sizeof(double);
    if (arrays && argument->is_array) {
      value->length = honest_length(this, values, k);
      value->array = calloc(value->length ? value->length : 1, size);
      for (size_t i = 0; i < value->length && argument->direction != 'i' && argument->kind == 'i'; i++)
        ((int *)value->array)[i] = unset;
    }
    if (!argument->is_array && argument->direction == 'o') {
      value->i = unset;
      value->r = unset;
      skip_blanks(&text);
      if (text.at < text.end && *text.at == '~') value->is_null = 1, text.at++;
      continue;
    }
    skip_blanks(&text);
    if (text.at < text.end && *text.at == '~') {
      value->is_null = 1;
      text.at++;
    } else if (argument->kind == 't') {
      read_text(&text, value->array, arrays ? value->length : 0);
    } else if (argument->is_array) {
      if (text.at >= text.end || *text.at != '[') continue;
      for (text.at++; read_number(&text, &number); n++) {
        if (!arrays || n >= value->length) continue;
        if (argument->kind == 'i') ((int *)value->array)[n] = as_integer(number);
        else ((double *)value->array)[n] = number;
      }
      while (text.at < text.end && *text.at != ']') text.at++;
      text.at += text.at < text.end;
    } else if (read_number(&text, &number)) {
      value->i = as_integer(number);
      value->r = number;
    }
  }
}

/* Would the call only cause a long calculation? */
static int is_large(struct routine *this, struct value *values)
{
  for (int k = 0; k < this->count; k++) {
    const char *name = this->arguments[k].name;
    if (!this->arguments[k].is_array && (strncmp(name, "len", 3) == 0 || (name[0] == 'n' && strcmp(name, "nx") > 0))
      && !values[k].is_null && values[k].i > longest_array) return 1;
    if (strncmp(name, "np", 2) == 0 && !this->arguments[k].is_array && values[k].i > (strcmp(this->name, "subs_addblock") ? 3000 : 9))
      return 1;
  }
  for (int k = 0; k < this->count; k++)
    if (this->arguments[k].is_array && honest_length(this, values, k) > longest_array) return 1;
  return 0;
}

/* The same for values of arrays: grids, step sizes, depths */
static int makes_large(struct routine *this, struct value *values)
{
  struct value *p = find(this, values, "params");
  if (p && p->length >= 2 && (strcmp(this->name, "cntc_setpotcontact") == 0 || strcmp(this->name, "cntc_sethertzcontact") == 0)) {
    const double *v = p->array;
    struct value *choice = find(this, values, "ipotcn");
    if (choice && choice->i <= 0 && strcmp(this->name, "cntc_setpotcontact") == 0)
      return (v[0] > 0 && v[0] < 0.5) || (v[1] > 0 && v[1] < 0.5);
    return v[0] * v[1] > 625;
  }
  if (strcmp(this->name, "subs_addblock") == 0)
    for (int k = 0; k < this->count; k++)
      for (size_t i = 0; this->arguments[k].is_array && i < values[k].length; i++)
        if (((double *)values[k].array)[i] > 40) return 1;
  return 0;
}

/* Check the results of a call */
static void judge(struct routine *this, struct value *values)
{
  static char message[4000];
  for (int k = 0; k < this->count; k++) {
    struct argument *argument = &this->arguments[k];
    struct value *value = &values[k];
    if (argument->direction == 'i' || argument->kind != 'r' || value->is_null) continue;
    if (!argument->is_array && !isfinite(value->r)) fuzz_fail("%s: %s is %g", this->name, argument->name, value->r);
    for (size_t i = 0; argument->is_array && i < value->length; i++)
      if (!isfinite(((double *)value->array)[i]))
        fuzz_fail("%s: element %zu of %s is %g", this->name, i, argument->name, ((double *)value->array)[i]);
  }
  if (getenv("CONTACT_FUZZ_PRINT")) {
    struct value *code = find(this, values, "ierror");
    int ire = values[0].i, icp = this->count > 1 && strcmp(this->arguments[1].name, "icp") == 0 ? values[1].i : -1;
    message[0] = '\0';
    fuzz_tell("%s: code %d, %s", this->name, code ? code->i : 0, contact_last_error(ire, icp, message, sizeof message) || *message ? message : "");
  }
  if (strcmp(this->name, "cntc_calculate") == 0 || strcmp(this->name, "subs_calculate") == 0) {
    struct value *code = find(this, values, "ierror"), *ire = find(this, values, "ire"), *icp = find(this, values, "icp");
    if (code->is_null) return;
    if (code->i == unset) fuzz_fail("%s does not set a code", this->name);
    if (code->i >= 0 || ire->is_null || icp->is_null) return;
    if (contact_last_error(ire->i, icp->i, message, sizeof message) != 0) fuzz_check_message(message, "a calculation fails");
  }
}

/* Result elements that have a limit, or for which the text has set one */
enum { most_limited = 16 };
static char is_limited[most_limited];

/* A wheel that is placed deep in its rail has at most 400 elements, unless the text sets another limit. By default a
 * patch may have 200000, which takes seconds */
static void limit_elements(int ire)
{
  if (ire >= 0 && ire < most_limited) is_limited[ire] = 1;
  int whole = -1, one = 1, flag = CNTC_ic_npomax, most = 400;
  cntc_setflags(&ire, &whole, &one, &flag, &most);
}

/* Do these flags set the number of elements? */
static int sets_limit(struct routine *this, struct value *values)
{
  struct value *flags = find(this, values, "params");
  for (size_t i = 0; flags && flags->array && i < flags->length; i++)
    if (((int *)flags->array)[i] == CNTC_ic_npomax) return 1;
  return 0;
}

/* One call */
static void call(const char *line, const char *end)
{
  struct value values[max_arguments] = {0};
  void *pointers[max_arguments] = {0};
  struct reader text = {line, end};
  struct routine *this = NULL;
  size_t n;
  skip_blanks(&text);
  n = strcspn(text.at, " \t\r\n");
  for (int k = 0; k < routine_count && !this; k++)
    if (strlen(routines[k].name) == n && strncmp(routines[k].name, text.at, n) == 0) this = &routines[k];
  if (!this) return;
  text.at += n;
  read_values(this, text, values, 0);
  if (is_large(this, values)) return;
  read_values(this, text, values, 1);
  for (int k = 0; k < this->count; k++) {
    if (values[k].is_null) continue;
    pointers[k] = this->arguments[k].is_array ? values[k].array : this->arguments[k].kind == 'i' ? (void *)&values[k].i : &values[k].r;
  }
  if (!makes_large(this, values)) {
    int ire = values[0].is_null ? -1 : values[0].i;
    /* elements that were created by another call than cntc_initialize */
    if (strcmp(this->name, "cntc_calculate") == 0 && ire >= 0 && ire < most_limited && !is_limited[ire]) limit_elements(ire);
    if (strcmp(this->name, "cntc_setflags") == 0 && ire >= 0 && ire < most_limited && sets_limit(this, values)) is_limited[ire] = 1;
    if (strcmp(this->name, "cntc_finalize") == 0 && ire >= 0 && ire < most_limited) is_limited[ire] = 0;
    this->entry(pointers[0], pointers[1], pointers[2], pointers[3], pointers[4], pointers[5], pointers[6], pointers[7], pointers[8],
      pointers[9], pointers[10], pointers[11]);
    judge(this, values);
    if (strcmp(this->name, "cntc_initialize") == 0 && !values[0].is_null) limit_elements(ire);
  }
  for (int k = 0; k < this->count; k++) free(values[k].array);
}

void fuzz_text(const char *text, size_t length)
{
  const char *end = text + length;
  memset(is_limited, 0, sizeof is_limited);
  for (int n = 0; text < end && n < max_calls; n++) {
    const char *last = memchr(text, '\n', (size_t)(end - text));
    if (!last) last = end;
    call(text, last);
    text = last + 1;
  }
  cntc_finalizelast();
}
