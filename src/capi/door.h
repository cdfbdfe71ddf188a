/* The doors of the library: each routine that it exports, from the table interface.txt, once under its name and once with
 * an underscore behind it, the name that Fortran callers get who declare no interface. All arguments are addresses; more
 * of them, such as the hidden lengths of texts, do no harm. Behind a door stands the Fortran routine, under a guard. */
#ifndef CONTACT_CAPI_DOOR_H
#define CONTACT_CAPI_DOOR_H

typedef void (*contact_routine)(void);

/* A call: the routine, its arguments, and which of them are result element, patch and error code (-1: none) */
void contact_call(const char *name, contact_routine routine, int count, void **arguments, int ire, int icp, int ierror);

#define CALL(name, count, ire, icp, ierror, ...) \
  void *arguments[] = {__VA_ARGS__}; \
  contact_call(#name, (contact_routine)inside_##name, count, arguments, ire, icp, ierror);
#define DOOR(name, count, parameters, ire, icp, ierror, ...) \
  void inside_##name parameters; \
  void name parameters; \
  void name##_ parameters; \
  void name parameters { CALL(name, count, ire, icp, ierror, __VA_ARGS__) } \
  void name##_ parameters { CALL(name, count, ire, icp, ierror, __VA_ARGS__) }

#define DOOR0(name, r, p, e) DOOR(name, 0, (void), r, p, e, (void *)0)
#define DOOR1(name, r, p, e) DOOR(name, 1, (void *a), r, p, e, a)
#define DOOR2(name, r, p, e) DOOR(name, 2, (void *a, void *b), r, p, e, a, b)
#define DOOR3(name, r, p, e) DOOR(name, 3, (void *a, void *b, void *c), r, p, e, a, b, c)
#define DOOR4(name, r, p, e) DOOR(name, 4, (void *a, void *b, void *c, void *d), r, p, e, a, b, c, d)
#define DOOR5(name, r, p, e) DOOR(name, 5, (void *a, void *b, void *c, void *d, void *f), r, p, e, a, b, c, d, f)
#define DOOR6(name, r, p, e) \
  DOOR(name, 6, (void *a, void *b, void *c, void *d, void *f, void *g), r, p, e, a, b, c, d, f, g)
#define DOOR7(name, r, p, e) \
  DOOR(name, 7, (void *a, void *b, void *c, void *d, void *f, void *g, void *h), r, p, e, a, b, c, d, f, g, h)
#define DOOR8(name, r, p, e) \
  DOOR(name, 8, (void *a, void *b, void *c, void *d, void *f, void *g, void *h, void *i), r, p, e, a, b, c, d, f, g, h, i)
#define DOOR9(name, r, p, e) \
  DOOR(name, 9, (void *a, void *b, void *c, void *d, void *f, void *g, void *h, void *i, void *j), r, p, e, \
    a, b, c, d, f, g, h, i, j)
#define DOOR10(name, r, p, e) \
  DOOR(name, 10, (void *a, void *b, void *c, void *d, void *f, void *g, void *h, void *i, void *j, void *k), r, p, e, \
    a, b, c, d, f, g, h, i, j, k)

#endif
