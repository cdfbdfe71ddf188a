/* The process that the library lives in: traps of floating point exceptions, threads that call, and children */
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

/* The memory of these variables is there when a thread begins; of other models it would be asked for at their first use */
#ifdef __ELF__
#define OF_THREAD _Thread_local __attribute__((tls_model("initial-exec")))
#else
#define OF_THREAD _Thread_local
#endif

static OF_THREAD fenv_t floats_of_host;
static OF_THREAD int floats_are_held;

/* No operation of the library may end a host that has exceptions trapped; infinities and what is not a number are
 * looked for where they count. A call stays on its thread, and calls do not nest. */
void contact_hold_floats(void) { floats_are_held = feholdexcept(&floats_of_host) == 0; }

/* The traps and flags as the host had them */
void contact_give_floats_back(void) {
  if (floats_are_held) fesetenv(&floats_of_host);
  floats_are_held = 0;
}

/* The problem that the thread is inside, and how far in it is, for the case that the call is left for want of memory */
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
/* Calculations that run, and callers who wait for their turn: numbers are drawn and called in order */
static struct {
  pthread_mutex_t lock;
  pthread_cond_t changed;
  int running;
  unsigned long next, called;
} turns = {PTHREAD_MUTEX_INITIALIZER, PTHREAD_COND_INITIALIZER, 0, 0, 0};

/* Wait until fewer than `most` calculations run and all who came before have begun. Whoever calculates waits for
 * nobody who waits here, so that all get their turn. */
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

/* Those who ran or waited did not come along */
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

/* Is this process a fork of one that had the library? The threads of OpenMP's run time did not come along, and
 * waiting for them has no end. */
int contact_is_child(void) { return child; }
