/* A host that loads the library at run time by its file name, unloads it while threads of it are waiting for work, and
 * loads it again.
 * usage: loader LIBRARY */
#include <dlfcn.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

typedef void (*initialize_t)(int *, int *, int *, int *, char *, int *);
typedef void (*flags_t)(int *, int *, int *);
typedef void (*grid_t)(int *, int *, int *, int *, double *);
typedef void (*approach_t)(int *, int *, double *);
typedef void (*calculate_t)(int *, int *, int *);
typedef void (*finalize_t)(void);

int main(int argc, char **argv) {
  int round;
  if (argc != 2) return 2;
  for (round = 0; round < 3; round++) {
    int ire = 1, icp = 1, module = 3, version = 0, error = 0, length = 1;
    int threads_flag = 2003, all = -1, hertz = -3, five = 5;
    double approach = 0.01, grid[] = {150.0, 150.0, 5.0, 5.0, 1.2};
    char blank[] = " ";
    struct timespec moment = {0, 20000000};
    initialize_t initialize;
    flags_t setglobalflags;
    grid_t sethertzcontact;
    approach_t setpenetration;
    calculate_t calculate;
    finalize_t finalize;
    void *symbol, *library = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL);
    if (library == NULL) {
      printf("%s\n", dlerror());
      return 1;
    }
    /* ISO C has no conversion from objects to functions */
    symbol = dlsym(library, "cntc_initialize");
    memcpy(&initialize, &symbol, sizeof symbol);
    symbol = dlsym(library, "cntc_setglobalflags");
    memcpy(&setglobalflags, &symbol, sizeof symbol);
    symbol = dlsym(library, "cntc_sethertzcontact");
    memcpy(&sethertzcontact, &symbol, sizeof symbol);
    symbol = dlsym(library, "cntc_setpenetration");
    memcpy(&setpenetration, &symbol, sizeof symbol);
    symbol = dlsym(library, "cntc_calculate");
    memcpy(&calculate, &symbol, sizeof symbol);
    symbol = dlsym(library, "cntc_finalizelast");
    memcpy(&finalize, &symbol, sizeof symbol);
    initialize(&ire, &module, &version, &error, blank, &length);
    if (error != 0 || version < 2500) return 3;
    setglobalflags(&length, &threads_flag, &all);
    sethertzcontact(&ire, &icp, &hertz, &five, grid);
    setpenetration(&ire, &icp, &approach);
    calculate(&ire, &icp, &error);
    if (error != 0) return 4;
    /* the second time it is left to itself */
    if (round != 1) finalize();
    if (dlclose(library) != 0) return 5;
    nanosleep(&moment, NULL);
  }
  return 0;
}
