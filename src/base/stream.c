/* Files of results: opened, or the reason why not, as the Fortran run-time library says it */
#define _GNU_SOURCE
#include <errno.h>
#include <stdio.h>
#include <string.h>

void *contact_open_stream(const char *name, const char *mode, char *reason, int length);

/* Null when the file cannot be opened; then the reason is filled, null-terminated */
void *contact_open_stream(const char *name, const char *mode, char *reason, int length) {
  FILE *stream = fopen(name, mode);
  if (stream != NULL) return stream;
#ifdef __GLIBC__
  char text[128];
  const char *why = strerror_r(errno, text, sizeof text);
#else
  const char *why = strerror(errno);
#endif
  snprintf(reason, (size_t)length, "Cannot open file '%s': %s", name, why);
  return NULL;
}
