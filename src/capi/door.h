/* Exported routines of the library, from the table interface.txt: each under its name, and under its name with a trailing
 * underscore for Fortran callers without an interface. All arguments are addresses; additional ones, such as the hidden
 * lengths of texts, are ignored. Each calls a Fortran routine under a guard: contact_run_routine for settings and results,
 * inside_... for the others. */
#ifndef CONTACT_CAPI_DOOR_H
#define CONTACT_CAPI_DOOR_H

#include <stddef.h>

typedef void (*contact_routine)(void);

/* A routine: its name; its Fortran routine, or its name in messages and the kinds of its arguments; the number of arguments;
 * and the positions of result element, patch and error code among them (-1: none) */
struct door {
  const char *name;
  contact_routine routine;
  const char *shown, *kinds;
  int count, ire, icp, ierror;
};
void contact_call(const struct door *door, void **arguments);

#define PARAMETERS0 (void)
#define PARAMETERS1 (void *a)
#define PARAMETERS2 (void *a, void *b)
#define PARAMETERS3 (void *a, void *b, void *c)
#define PARAMETERS4 (void *a, void *b, void *c, void *d)
#define PARAMETERS5 (void *a, void *b, void *c, void *d, void *e)
#define PARAMETERS6 (void *a, void *b, void *c, void *d, void *e, void *f)
#define PARAMETERS7 (void *a, void *b, void *c, void *d, void *e, void *f, void *g)
#define PARAMETERS8 (void *a, void *b, void *c, void *d, void *e, void *f, void *g, void *h)
#define PARAMETERS9 (void *a, void *b, void *c, void *d, void *e, void *f, void *g, void *h, void *i)
#define PARAMETERS10 (void *a, void *b, void *c, void *d, void *e, void *f, void *g, void *h, void *i, void *j)
#define ARGUMENTS0 NULL
#define ARGUMENTS1 a
#define ARGUMENTS2 a, b
#define ARGUMENTS3 a, b, c
#define ARGUMENTS4 a, b, c, d
#define ARGUMENTS5 a, b, c, d, e
#define ARGUMENTS6 a, b, c, d, e, f
#define ARGUMENTS7 a, b, c, d, e, f, g
#define ARGUMENTS8 a, b, c, d, e, f, g, h
#define ARGUMENTS9 a, b, c, d, e, f, g, h, i
#define ARGUMENTS10 a, b, c, d, e, f, g, h, i, j

#define BODY(count, ...) { \
    static const struct door door = {__VA_ARGS__}; \
    void *arguments[] = {ARGUMENTS##count}; \
    contact_call(&door, arguments); \
  }
#define BOTH(name, count, ...) \
  void name PARAMETERS##count; \
  void name##_ PARAMETERS##count; \
  void name PARAMETERS##count BODY(count, #name, __VA_ARGS__) \
  void name##_ PARAMETERS##count BODY(count, #name, __VA_ARGS__)
#define DOOR(name, count, ire, icp, ierror) \
  void inside_##name PARAMETERS##count; \
  BOTH(name, count, (contact_routine)inside_##name, NULL, NULL, count, ire, icp, ierror)
#define ROUTINE(name, count, ire, icp, ierror, shown, kinds) BOTH(name, count, NULL, shown, kinds, count, ire, icp, ierror)

#endif
