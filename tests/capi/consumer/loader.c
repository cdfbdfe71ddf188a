/* A host that loads the library at run time by its file name, unloads it while threads of it are waiting for work, and
 * loads it again.
 * usage: loader LIBRARY */
#include <dlfcn.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

/* ISO C has no conversion from objects to functions */
#define LOAD(name) \
  symbol = dlsym(library, #name); \
  if (symbol == NULL) return 6; \
  memcpy(&name, &symbol, sizeof symbol)

int main(int argc, char **argv) {
  int round;
  if (argc != 2) return 2;
  for (round = 0; round < 3; round++) {
    int ire = 1, icp = 1, module = 3, version = 0, error = 0, length = 1;
    int threads_flag = 2003, all = -1, hertz = -3, five = 5;
    double approach = 0.01, grid[] = {150.0, 150.0, 5.0, 5.0, 1.2};
    char blank[] = " ";
    struct timespec moment = {0, 20000000};
    void (*cntc_initialize)(int *, int *, int *, int *, char *, int *);
    void (*cntc_setglobalflags)(int *, int *, int *);
    void (*cntc_sethertzcontact)(int *, int *, int *, int *, double *);
    void (*cntc_setpenetration)(int *, int *, double *);
    void (*cntc_calculate)(int *, int *, int *);
    void (*cntc_finalizelast)(void);
    void *symbol, *library = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL);
    if (library == NULL) {
      printf("%s\n", dlerror());
      return 1;
    }
    LOAD(cntc_initialize);
    LOAD(cntc_setglobalflags);
    LOAD(cntc_sethertzcontact);
    LOAD(cntc_setpenetration);
    LOAD(cntc_calculate);
    LOAD(cntc_finalizelast);
    cntc_initialize(&ire, &module, &version, &error, blank, &length);
    if (error != 0 || version < 2500) return 3;
    cntc_setglobalflags(&length, &threads_flag, &all);
    cntc_sethertzcontact(&ire, &icp, &hertz, &five, grid);
    cntc_setpenetration(&ire, &icp, &approach);
    cntc_calculate(&ire, &icp, &error);
    if (error != 0) return 4;
    /* the second time it is not unloaded */
    if (round != 1) cntc_finalizelast();
    if (dlclose(library) != 0) return 5;
    nanosleep(&moment, NULL);
  }
  return 0;
}
