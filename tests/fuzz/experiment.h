/* An experiment in the folder of the target, run or checked in this process */
#ifndef EXPERIMENT_H
#define EXPERIMENT_H

/* Status of a run in which a case ran out of time, as src/capi/run.f90 counts failures */
enum { status_time = 18 };
/* Read fuzz.inp or fuzz.toml with a mode of contact.h, under limits that keep a case within milliseconds, and judge message and
 * report. extra is 0, or choices of contact_run_with. Returns the status of the call. */
int run_experiment(int mode, int extra);

#endif
