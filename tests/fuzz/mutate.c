/* Changes of a text that respect its structure: numbers, words, lines, groups of lines */
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fuzz.h"

/* Replacements of a number */
static const char *const values[] = {"0", "1", "-1", "2", "3", "4", "5", "6", "7", "8", "9", "10", "0.5", "-0.5", "1e-3", "-1e-3",
  "1e-9", "1e-300", "1e9", "-1e9", "1e20", "1e300", "-1e300", "nan", "inf", "-inf", "180d", "90d", "0.1r", "2147483647",
  "-2147483648", "99999999999", "1d", ".", "1.d0", "1e", "''", "%", "word", "100", "0.28", "82000", "1d-05", "-0", "1e-320"};

size_t fuzz_random(uint64_t *state, size_t limit)
{
  /* splitmix64 */
  uint64_t z = (*state += 0x9e3779b97f4a7c15u);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return limit ? (size_t)((z ^ (z >> 31)) % limit) : 0;
}

/* Replace some bytes by a piece of n bytes; returns the new length, or the old one if it does not fit */
static size_t splice(char *text, size_t length, size_t room, size_t at, size_t removed, const char *piece, size_t n)
{
  if (at > length) return length;
  if (removed > length - at) removed = length - at;
  if (length - removed + n > room) return length;
  memmove(text + at + n, text + at + removed, length - at - removed);
  memcpy(text + at, piece, n);
  return length - removed + n;
}

/* A random word: first byte and length, 0 when there is none */
static size_t pick_word(const char *text, size_t length, uint64_t *state, size_t *first)
{
  size_t k = fuzz_random(state, length), last;
  while (k < length && isspace((unsigned char)text[k])) k++;
  while (k > 0 && !isspace((unsigned char)text[k - 1])) k--;
  for (last = k; last < length && !isspace((unsigned char)text[last]);) last++;
  *first = k;
  return last - k;
}

/* The same for a number */
static size_t pick_number(const char *text, size_t length, uint64_t *state, size_t *first)
{
  for (int k = 0; k < 8; k++) {
    size_t n = pick_word(text, length, state, first);
    if (n && memchr("+-.0123456789", text[*first], 13)) return n;
  }
  return 0;
}

/* Begin of the line that a byte is in, and of the next one */
static size_t line_begin(const char *text, size_t k)
{
  while (k > 0 && text[k - 1] != '\n') k--;
  return k;
}

static size_t line_end(const char *text, size_t length, size_t k)
{
  while (k < length && text[k] != '\n') k++;
  return k < length ? k + 1 : length;
}

/* One to four random lines: first byte and length */
static size_t pick_lines(const char *text, size_t length, uint64_t *state, size_t *first)
{
  size_t last;
  *first = line_begin(text, fuzz_random(state, length));
  last = *first;
  for (size_t n = 1 + fuzz_random(state, 4); n; n--) last = line_end(text, length, last);
  return last - *first;
}

/* A number near the present one */
static size_t near_number(const char *word, size_t n, char *piece, size_t size, uint64_t *state)
{
  static const double factors[] = {-1, 0.1, 0.5, 0.999, 1.001, 2, 10, 1000};
  char copy[64];
  double value;
  if (n >= sizeof copy) return 0;
  memcpy(copy, word, n);
  copy[n] = '\0';
  value = strtod(copy, NULL);
  if (fuzz_random(state, 2)) value += fuzz_random(state, 2) ? 1 : -1;
  else value *= factors[fuzz_random(state, 8)];
  return (size_t)snprintf(piece, size, "%.9g", value);
}

static size_t change_once(char *text, size_t length, size_t room, const char *other, size_t other_length, uint64_t *state)
{
  static char piece[fuzz_longest];
  size_t first, n, at, m;
  if (length == 0) return splice(text, 0, room, 0, 0, "3\n", 2);
  switch (fuzz_random(state, other_length ? 13 : 10)) {
  case 0: /* a byte */
    text[fuzz_random(state, length)] = (char)fuzz_random(state, 256);
    return length;
  case 1: /* a digit */
    for (int k = 0; k < 20; k++) {
      first = fuzz_random(state, length);
      if (!isdigit((unsigned char)text[first])) continue;
      text[first] = (char)('0' + fuzz_random(state, 10));
      break;
    }
    return length;
  case 2:
  case 3: /* another number */
    if (!(n = pick_number(text, length, state, &first))) return length;
    m = fuzz_random(state, sizeof values / sizeof values[0]);
    return splice(text, length, room, first, n, values[m], strlen(values[m]));
  case 4: /* a number near it */
    if (!(n = pick_number(text, length, state, &first))) return length;
    if (!(m = near_number(text + first, n, piece, sizeof piece, state))) return length;
    return splice(text, length, room, first, n, piece, m);
  case 5: /* a word removed or doubled */
    n = pick_word(text, length, state, &first);
    if (fuzz_random(state, 2)) return splice(text, length, room, first, n, "", 0);
    memcpy(piece, text + first, n);
    piece[n] = ' ';
    return splice(text, length, room, first, 0, piece, n + 1);
  case 6: /* lines removed */
    n = pick_lines(text, length, state, &first);
    return splice(text, length, room, first, n, "", 0);
  case 7: /* lines doubled elsewhere */
  case 8: /* lines moved */
    m = fuzz_random(state, 2);
    n = pick_lines(text, length, state, &first);
    memcpy(piece, text + first, n);
    if (m) length = splice(text, length, room, first, n, "", 0);
    at = length ? line_begin(text, fuzz_random(state, length)) : 0;
    return splice(text, length, room, at, 0, piece, n);
  case 9: /* the end cut off */
    return fuzz_random(state, 4) ? length : 1 + fuzz_random(state, length);
  case 10: /* lines of another text for lines of this one */
  case 11: /* lines of another text put in */
    m = pick_lines(other, other_length, state, &at);
    n = pick_lines(text, length, state, &first);
    return splice(text, length, room, first, fuzz_random(state, 2) ? n : 0, other + at, m);
  default: /* the beginning of this text, the end of another one */
    first = line_begin(text, fuzz_random(state, length));
    at = line_begin(other, fuzz_random(state, other_length));
    return splice(text, length, room, first, length - first, other + at, other_length - at);
  }
}

size_t fuzz_mutate(char *text, size_t length, size_t room, const char *other, size_t other_length, uint64_t *state)
{
  for (size_t n = 1 + fuzz_random(state, 4); n; n--) length = change_once(text, length, room, other, other_length, state);
  return length;
}
