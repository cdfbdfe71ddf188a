/* Locks and critical sections of OpenMP in a form that the thread sanitizer follows
 *
 * The run time library of OpenMP is not instrumented: accesses ordered by its locks look like races. A program of an
 * instrumented build that links this file uses these instead, in its library too. */
#include <sched.h>

/* 0 free, 1 taken */
static void take(int *lock) {
  while (__atomic_exchange_n(lock, 1, __ATOMIC_ACQUIRE)) sched_yield();
}

static void let_go(int *lock) { __atomic_store_n(lock, 0, __ATOMIC_RELEASE); }

/* Named critical sections of compiled code */
void GOMP_critical_name_start(int *name) { take(name); }
void GOMP_critical_name_end(int *name) { let_go(name); }

/* Locks as Fortran calls them */
void omp_init_lock_(int *lock) { let_go(lock); }
void omp_destroy_lock_(int *lock) { (void)lock; }
void omp_set_lock_(int *lock) { take(lock); }
void omp_unset_lock_(int *lock) { let_go(lock); }
int omp_test_lock_(int *lock) { return !__atomic_exchange_n(lock, 1, __ATOMIC_ACQUIRE); }
