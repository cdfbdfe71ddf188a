/* The process of the program: signals, and closed standard streams. None of this is part of the library, whose host handles
 * these itself. */
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <string.h>
#include <unistd.h>

void contact_fill_streams(void);
void contact_catch_signals(void);
void contact_restore_signals(void);
int contact_caught_signal(void);

/* Signal that ends the run after the current case, 0: none */
static volatile sig_atomic_t caught = 0;

/* The first signal from a user or a batch system ends the run after the current case, a second one at once */
static void end_soon(int number) {
  static const char message[] = "\ncontact: the run ends after the current case; a second signal ends it at once\n";
  const int before = errno;
  if (caught && caught != SIGPIPE && caught != SIGXCPU) _exit(128 + number);
  caught = number;
  if (write(STDERR_FILENO, message, sizeof message - 1) < 0) errno = before;
  errno = before;
}

/* Handler for signals that are sent repeatedly */
static void end_soon_and_go_on(int number) {
  if (!caught) caught = number;
}

static void handle(int number, void (*handler)(int)) {
  struct sigaction action, before;
  memset(&action, 0, sizeof action);
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  /* signals ignored by the parent process remain ignored: nohup, background jobs */
  if (sigaction(number, NULL, &before) == 0 && before.sa_handler != SIG_IGN) sigaction(number, &action, NULL);
}

void contact_catch_signals(void) {
  handle(SIGTERM, end_soon);
  handle(SIGINT, end_soon);
  handle(SIGHUP, end_soon);
  handle(SIGPIPE, end_soon_and_go_on);
  handle(SIGXCPU, end_soon_and_go_on);
  /* a file that reached its size limit: the write fails and is reported */
  handle(SIGXFSZ, SIG_IGN);
}

/* Restore the default action of signals after the run */
void contact_restore_signals(void) {
  static const int all[] = {SIGTERM, SIGINT, SIGHUP, SIGPIPE, SIGXCPU, SIGXFSZ};
  for (unsigned k = 0; k < sizeof all / sizeof *all; k++) {
    struct sigaction now;
    if (sigaction(all[k], NULL, &now) == 0 && (now.sa_handler == end_soon || now.sa_handler == end_soon_and_go_on))
      signal(all[k], SIG_DFL);
  }
}

int contact_caught_signal(void) { return caught; }

/* Open standard streams that the parent process has closed: otherwise result files would get their descriptors, and messages
 * would be written into them. Reading and writing them fails. */
void contact_fill_streams(void) {
  for (int k = 0; k <= 2; k++)
    if (fcntl(k, F_GETFD) < 0 && open("/dev/null", k == 0 ? O_WRONLY : O_RDONLY) != k) return;
}
