/* Common part of all fuzzing targets: a text is passed to the library, and the results are checked.
 *
 * A target is one C file with fuzz_name, fuzz_begin and fuzz_text. It is linked with replay.c, which repeats a corpus and
 * mutates it with a fixed seed, or with guided.c, by which libFuzzer mutates texts based on coverage. */
#ifndef FUZZ_H
#define FUZZ_H

#include <stddef.h>
#include <stdint.h>

/* Longest text that a target is given [bytes] */
enum { fuzz_longest = 16384 };

/* Name of the target, and of its folder of the corpus */
extern const char fuzz_name[];
/* Called once, in the folder of the target */
void fuzz_begin(void);
/* Pass one null-terminated text to the library; calls fuzz_fail if the results are wrong */
void fuzz_text(const char *text, size_t length);

/* Make an empty folder in memory, go there, copy the profiles of the examples to profiles/ with an eighth of their points */
void fuzz_enter(void);
/* Remove all files of that folder except those marked by fuzz_keep */
void fuzz_tidy(void);
/* Mark all present files to be kept */
void fuzz_keep(void);
/* One text to the library, and the files that it wrote removed. A text that takes more processor time than fuzz_slow is kept as
 * slow-NAME-HASH in the folder that CONTACT_FUZZ_FOUND names, or else in the working directory, and reported as a finding */
void fuzz_execute(const char *text, size_t length);
/* Processor time from which a text is slow [s], and how many of them there were */
extern double fuzz_slow;
extern int fuzz_slow_count;

/* Report a finding and end the process by SIGABRT */
_Noreturn void fuzz_fail(const char *format, ...) __attribute__((format(printf, 1, 2)));
/* Print a message of the library on standard error if CONTACT_FUZZ_PRINT is set, which shows how far texts get */
void fuzz_tell(const char *format, ...) __attribute__((format(printf, 1, 2)));
/* Write a file; a failure ends the process */
void fuzz_write(const char *name, const char *text, size_t length);
/* A message to a user must be present, and must be a text of one line */
void fuzz_check_message(const char *message, const char *what);
/* All results of a report must be finite numbers */
void fuzz_check_report(const char *name);

/* Change a text in place: bytes, numbers, words, lines, pieces of another text.
 *
 * room   size of the buffer
 * other  a text to take pieces from, NULL for none
 * state  of the generator of random numbers, changed
 * Returns the new length. */
size_t fuzz_mutate(char *text, size_t length, size_t room, const char *other, size_t other_length, uint64_t *state);
/* A random number from 0 to below limit */
size_t fuzz_random(uint64_t *state, size_t limit);

#endif
