/* A library to preload under helgrind and drd: locks and critical sections of OpenMP made of mutexes, which these tools follow
 *
 * Those of the OpenMP run time library are made of system calls, so that accesses ordered by them look like races. */
#include <pthread.h>
#include <stddef.h>

enum { most = 4096 };

/* A mutex for each address */
static pthread_mutex_t mutexes[most], list = PTHREAD_MUTEX_INITIALIZER;
static const void *addresses[most];

static pthread_mutex_t *mutex_of(const void *address) {
  pthread_mutex_lock(&list);
  size_t k = ((size_t)address >> 2)%most;
  while (addresses[k] != NULL && addresses[k] != address) k = (k + 1)%most;
  if (addresses[k] == NULL) {
    addresses[k] = address;
    pthread_mutex_init(&mutexes[k], NULL);
  }
  pthread_mutex_unlock(&list);
  return &mutexes[k];
}

void GOMP_critical_name_start(void **name) { pthread_mutex_lock(mutex_of(name)); }
void GOMP_critical_name_end(void **name) { pthread_mutex_unlock(mutex_of(name)); }
void omp_init_lock_(int *lock) { (void)lock; }
void omp_destroy_lock_(int *lock) { (void)lock; }
void omp_set_lock_(int *lock) { pthread_mutex_lock(mutex_of(lock)); }
void omp_unset_lock_(int *lock) { pthread_mutex_unlock(mutex_of(lock)); }
int omp_test_lock_(int *lock) { return pthread_mutex_trylock(mutex_of(lock)) == 0; }
