/* The process that the library lives in: traps of floating point exceptions, and children */
#include <fenv.h>
#ifndef _WIN32
#include <pthread.h>
#endif

void contact_hold_floats(void);
void contact_give_floats_back(void);
int contact_is_child(void);

static _Thread_local fenv_t floats_of_host;

/* No operation of the library may end a host that has exceptions trapped; infinities and what is not a number are
 * looked for where they count. A call stays on its thread, and calls do not nest. */
void contact_hold_floats(void) { feholdexcept(&floats_of_host); }

/* The traps and flags as the host had them */
void contact_give_floats_back(void) { fesetenv(&floats_of_host); }

static int child = 0;

#ifndef _WIN32
static void note_child(void) { child = 1; }

__attribute__((constructor)) static void watch_for_children(void) { pthread_atfork(NULL, NULL, note_child); }
#endif

/* Is this process a fork of one that had the library? The threads of OpenMP's run time did not come along, and
 * waiting for them has no end. */
int contact_is_child(void) { return child; }
