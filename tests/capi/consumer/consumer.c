/* A third-party program: runs an experiment by the library, and provokes errors.
 * usage: consumer EXPERIMENT OUTPUT_FOLDER */
#include <contact.h>
#include <stdio.h>
#include <string.h>

static int failures = 0;

static void check(int condition, const char *what) {
  if (condition) return;
  failures++;
  printf("FAILED %s\n", what);
}

int main(int argc, char **argv) {
  char message[400] = "untouched";
  char small[8];
  int status;

  if (argc != 3) return 2;

  status = contact_run(argv[1], CONTACT_CHECK, argv[2], 0, message, sizeof message);
  check(status == 0, "checking a good input succeeds");
  check(message[0] == '\0', "success leaves an empty message");

  status = contact_run(argv[1], CONTACT_RUN, argv[2], 1, message, sizeof message);
  check(status == 0, "running a good input succeeds");
  if (status != 0) printf("       %s\n", message);
  check(contact_run(argv[1], CONTACT_RUN, argv[2], 2, NULL, 0) == 0, "without a buffer for the message");

  status = contact_run("no/such/experiment", CONTACT_RUN, argv[2], 0, message, sizeof message);
  check(status != 0, "a missing file is an error");
  check(strstr(message, "no/such/experiment") != NULL, "the message names the missing file");

  memset(small, 'x', sizeof small);
  status = contact_run("no/such/experiment", CONTACT_RUN, argv[2], 0, small, 5);
  check(status != 0 && strlen(small) <= 4, "a long message is cut to fit");
  check(small[5] == 'x' && small[7] == 'x', "nothing is written beyond the message");

  status = contact_run_with(argv[1], CONTACT_RUN, argv[2], 1,
                            CONTACT_WRITE_JSON | CONTACT_WRITE_HDF5 | CONTACT_WRITE_VTK, message, sizeof message);
  check(status == 0 && message[0] == '\0', "more files");
  check(contact_run_with(argv[1], CONTACT_RUN, argv[2], 1, 1 << 30, message, sizeof message) == 1 && message[0] != '\0',
        "outputs that do not exist");

  check(contact_run(NULL, CONTACT_RUN, argv[2], 0, message, sizeof message) != 0, "NULL is not a name");
  check(message[0] != '\0', "NULL as a name is explained");
  check(contact_run("", CONTACT_RUN, NULL, 0, message, sizeof message) != 0, "empty name");
  check(contact_run(argv[1], 17, argv[2], 0, message, sizeof message) != 0, "unknown mode");
  check(contact_run(argv[1], CONTACT_RUN, argv[2], -1, message, sizeof message) != 0,
        "negative number of threads");

  status = contact_run(argv[1], CONTACT_RUN, argv[2], 0, message, sizeof message);
  check(status == 0 && message[0] == '\0', "after failures the library still works");
  printf("consumer: %s\n", failures == 0 ? "passed" : "failed");
  return failures != 0;
}
