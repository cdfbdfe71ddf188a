/* Calls of all exported routines: the routine runs under a guard; if it is abandoned for lack of memory, the caller receives
 * an error, everything held by the thread is released, and the library remains usable */
#include <omp.h>
#include "door.h"
#include "../../include/contact.h"

int contact_guard(void (*work)(void *), void *data, int owner);
void contact_run_routine(const char *name, const char *kinds, void **arguments);
void contact_call_failed(int cause, const char *name, const int *ire, const int *icp, int *ierror);

/* Code of any error, as CNTC_err_other; it remains if reporting the failure fails as well */
enum { other_error = -99 };

struct call {
  const struct door *door;
  void **a;
};

typedef void *p;

static void go(void *data) {
  const struct call *call = data;
  const contact_routine f = call->door->routine;
  void **a = call->a;
  if (f == NULL) {
    contact_run_routine(call->door->shown, call->door->kinds, a);
    return;
  }
  switch (call->door->count) {
  case 0: f(); break;
  case 1: ((void (*)(p))f)(a[0]); break;
  case 2: ((void (*)(p, p))f)(a[0], a[1]); break;
  case 3: ((void (*)(p, p, p))f)(a[0], a[1], a[2]); break;
  case 4: ((void (*)(p, p, p, p))f)(a[0], a[1], a[2], a[3]); break;
  case 5: ((void (*)(p, p, p, p, p))f)(a[0], a[1], a[2], a[3], a[4]); break;
  case 6: ((void (*)(p, p, p, p, p, p))f)(a[0], a[1], a[2], a[3], a[4], a[5]); break;
  case 7: ((void (*)(p, p, p, p, p, p, p))f)(a[0], a[1], a[2], a[3], a[4], a[5], a[6]); break;
  case 8: ((void (*)(p, p, p, p, p, p, p, p))f)(a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7]); break;
  case 9: ((void (*)(p, p, p, p, p, p, p, p, p))f)(a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8]); break;
  default: ((void (*)(p, p, p, p, p, p, p, p, p, p))f)(a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], a[9]);
  }
}

struct failure {
  int cause;
  const char *name;
  void *ire, *icp, *ierror;
};

static void report(void *data) {
  const struct failure *failure = data;
  contact_call_failed(failure->cause, failure->name, failure->ire, failure->icp, failure->ierror);
}

void contact_call(const struct door *door, void **arguments) {
  struct call call = {door, arguments};
  const int threads = omp_get_max_threads();
  const int cause = contact_guard(go, &call, 0);
  if (cause == 0) return;
  struct failure failure = {cause, door->name, door->ire < 0 ? NULL : arguments[door->ire],
    door->icp < 0 ? NULL : arguments[door->icp], door->ierror < 0 ? NULL : arguments[door->ierror]};
  omp_set_num_threads(threads);
  if (failure.ierror != NULL) *(int *)failure.ierror = other_error;
  contact_guard(report, &failure, 0);
}

int contact_run_with(const char *experiment, int mode, const char *output_dir, int threads, int outputs, char *message,
                     int message_length) {
  return contact_run_limited(experiment, mode, output_dir, threads, outputs, 0, 0.0, 0.0, 0.0, message, message_length);
}

int contact_run(const char *experiment, int mode, const char *output_dir, int threads, char *message, int message_length) {
  return contact_run_with(experiment, mode, output_dir, threads, 0, message, message_length);
}

/* The two queries that return a value */
int inside_contact_last_error(int ire, int icp, char *message, int length);
int inside_contact_case_status(int ire, int icp, int *iteration, char *message, int length);

struct question {
  int ire, icp, *iteration;
  char *message;
  int length, answer;
};

static void ask_error(void *data) {
  struct question *q = data;
  q->answer = inside_contact_last_error(q->ire, q->icp, q->message, q->length);
}

int contact_last_error(int ire, int icp, char *message, int length) {
  struct question question = {ire, icp, NULL, message, length, other_error};
  if (contact_guard(ask_error, &question, 0) != 0 && message != NULL && length > 0) message[0] = 0;
  return question.answer;
}

static void ask_status(void *data) {
  struct question *q = data;
  q->answer = inside_contact_case_status(q->ire, q->icp, q->iteration, q->message, q->length);
}

int contact_case_status(int ire, int icp, int *iteration, char *message, int length) {
  struct question question = {ire, icp, iteration, message, length, -1};
  if (contact_guard(ask_status, &question, 0) != 0 && message != NULL && length > 0) message[0] = 0;
  return question.answer;
}

/* Derivatives: all arguments of the Fortran routine are addresses, and the returned state is one of them */
void inside_contact_wheel_rail_jacobian(void);

int contact_wheel_rail_jacobian(int ire, double *values, int room, char *message, int length) {
  static const struct door door = {"contact_wheel_rail_jacobian", inside_contact_wheel_rail_jacobian, NULL, NULL, 6, 0, -1, 3};
  int state = other_error;
  void *arguments[] = {&ire, &room, values, &state, message, &length};
  if (message != NULL && length > 0) message[0] = 0;
  contact_call(&door, arguments);
  return state;
}
