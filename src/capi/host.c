/* The host process: floating point traps, calling threads, and forked child processes */
#include <fenv.h>
#ifndef _WIN32
#include <pthread.h>
#endif

void contact_hold_floats(void);
void contact_give_floats_back(void);
int contact_is_child(void);
void contact_begin_turn(int most);
void contact_end_turn(void);
void contact_note_call(void *problem, int stage);
void contact_find_call(void **problem, int *stage);

/* Memory of these variables is allocated with the thread; in other models it is allocated at the first use */
#ifdef __ELF__
#define OF_THREAD _Thread_local __attribute__((tls_model("initial-exec")))
#else
#define OF_THREAD _Thread_local
#endif

static OF_THREAD fenv_t floats_of_host;
static OF_THREAD int floats_are_held;

/* Disable traps: no operation of the library may terminate a host that traps floating point exceptions; the library checks
 * for infinities and NaN where they matter. A call stays on its thread, and calls do not nest. */
void contact_hold_floats(void) { floats_are_held = feholdexcept(&floats_of_host) == 0; }

/* Restore the traps and flags of the host */
void contact_give_floats_back(void) {
  if (floats_are_held) fesetenv(&floats_of_host);
  floats_are_held = 0;
}

/* The problem of the thread and its stage in it (call_stage in host.f90), for calls abandoned for lack of memory */
static OF_THREAD void *problem_of_call;
static OF_THREAD int stage_of_call;

void contact_note_call(void *problem, int stage) {
  problem_of_call = problem;
  stage_of_call = stage;
}

void contact_find_call(void **problem, int *stage) {
  *problem = problem_of_call;
  *stage = stage_of_call;
}

static int child = 0;

#ifndef _WIN32
/* Running calculations, and callers waiting for their turn: each draws the next number, and numbers are called in order */
static struct {
  pthread_mutex_t lock;
  pthread_cond_t changed;
  int running;
  unsigned long next, called;
} turns = {PTHREAD_MUTEX_INITIALIZER, PTHREAD_COND_INITIALIZER, 0, 0, 0};

/* Wait until fewer than `most` calculations run and all earlier callers have begun. A running calculation never waits for a
 * caller that waits here, so there is no deadlock. */
void contact_begin_turn(int most) {
  pthread_mutex_lock(&turns.lock);
  const unsigned long number = turns.next++;
  while (number != turns.called || turns.running >= most) pthread_cond_wait(&turns.changed, &turns.lock);
  turns.called++;
  turns.running++;
  pthread_cond_broadcast(&turns.changed);
  pthread_mutex_unlock(&turns.lock);
}

void contact_end_turn(void) {
  pthread_mutex_lock(&turns.lock);
  turns.running--;
  pthread_cond_broadcast(&turns.changed);
  pthread_mutex_unlock(&turns.lock);
}

/* In a forked child: other threads, running or waiting, do not exist there */
static void note_child(void) {
  child = 1;
  pthread_mutex_init(&turns.lock, NULL);
  pthread_cond_init(&turns.changed, NULL);
  turns.running = 0;
  turns.next = turns.called = 0;
}

__attribute__((constructor)) static void watch_for_children(void) { pthread_atfork(NULL, NULL, note_child); }
#else
void contact_begin_turn(int most) { (void)most; }
void contact_end_turn(void) {}
#endif

/* Is this process a fork of one that used the library? The threads of the OpenMP run time do not exist in it, and waiting for
 * them would never end. */
int contact_is_child(void) { return child; }
