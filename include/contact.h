/* CONTACT: rolling and sliding contact with friction - the C interface of the library.
 *
 * Link with -lcontact (CMake: contact::contact, pkg-config: contact). The library never ends the
 * process of its caller and never prints. Texts are null-terminated and copied during the call.
 */
#ifndef CONTACT_H
#define CONTACT_H

#ifdef __cplusplus
extern "C" {
#endif

/* Modes of contact_run */
enum {
  CONTACT_RUN = 2,  /* read <experiment>.inp, compute all cases, write the result files */
  CONTACT_CHECK = 3 /* read <experiment>.inp and check all cases, compute nothing */
};

/* Run one experiment, as the program `contact <mode> <experiment>` does.
 *
 * experiment      path of the input file without ".inp"
 * mode            CONTACT_RUN or CONTACT_CHECK
 * output_dir      folder for the result files; NULL or "" for the folder of the input file
 * threads         number of threads; 0 for the default of the machine (OMP_NUM_THREADS)
 * message         receives "" or the reason of the failure, truncated to fit; may be NULL
 * message_length  size of message in bytes, the final null included
 *
 * Returns 0 on success, another number on failure. Locale, signal handlers and standard streams
 * of the caller are not changed. Must not be called from two threads at the same time.
 */
int contact_run(const char *experiment, int mode, const char *output_dir, int threads,
                char *message, int message_length);

/* Additional files of contact_run_with; values can be added */
enum {
  CONTACT_WRITE_JSON = 1, /* <experiment>.jsonl: totals of every case as JSON lines */
  CONTACT_WRITE_HDF5 = 2, /* <experiment>.h5: inputs, totals, fields and stresses of all cases */
  CONTACT_WRITE_VTK = 4   /* <experiment>.pvd and others: surfaces and stresses for ParaView */
};

/* Methods that differ from those of the established program; values can be added to the outputs */
enum {
  CONTACT_MOVING_HEAT = 8,      /* surface temperatures by moving sources, as --heat moving-source */
  CONTACT_ANGLE_AT_CONTACT = 16, /* contact angles on rails that vary along the track, as --contact-angle contact */
  CONTACT_CLASSICAL = 64,       /* the solvers selected by G, as --classical */
  CONTACT_SECOND_ORDER = 128    /* steady rolling of second order in the size of elements, as --order 2 */
};

/* For untrusted input: only regular files below the folder of the experiment are read and written, and the limits of
 * `contact --confine` apply unless others are given; can be added to the outputs */
enum { CONTACT_CONFINE = 32 };

/* As contact_run, with additional outputs: 0 or a sum of CONTACT_WRITE_..., CONTACT_MOVING_HEAT,
 * CONTACT_ANGLE_AT_CONTACT, CONTACT_CLASSICAL, CONTACT_SECOND_ORDER and CONTACT_CONFINE */
int contact_run_with(const char *experiment, int mode, const char *output_dir, int threads,
                     int outputs, char *message, int message_length);

/* As contact_run_with, with limits.
 *
 * strict     not 0: the call fails if a case does not converge
 * seconds    time limit of each case [s]; megabytes: limit of its estimated memory [MB]; elements: limit for each
 *            potential contact area; 0: no limit. A case that exceeds a limit has no results; the run continues.
 */
int contact_run_limited(const char *experiment, int mode, const char *output_dir, int threads,
                        int outputs, int strict, double seconds, double megabytes, double elements,
                        char *message, int message_length);

/* Write an experiment in the other format of input: <experiment>.toml for .inp, .inp for .toml.
 *
 * experiment      path of the input file, with its suffix if both formats exist
 * output_dir      folder of the new file; NULL or "" for that of the input file
 * overwrite       not 0: an existing file is replaced
 * message         receives warnings, or the reason of a failure, truncated to fit; may be NULL
 * message_length  size of message in bytes, the final null included
 *
 * Returns 0 on success, another number on failure; then no file is written. */
int contact_convert_experiment(const char *experiment, const char *output_dir, int overwrite, char *message,
                    int message_length);

/* Describe in words what the cases of an experiment simulate, what they leave out, and the expected cost.
 *
 * experiment      path of the input file, with or without suffix
 * text            receives the description, or that of the cases before a failure and its reason, truncated to fit; may be NULL
 * text_length     size of text in bytes, the final null included
 * needed          receives the size required by the whole text; may be NULL
 *
 * Returns 0 on success, another number on failure. */
int contact_explain_experiment(const char *experiment, char *text, int text_length, int *needed);

/* Write the cases of an experiment in the readable format, each with all input that it keeps from earlier cases.
 *
 * Arguments and result are those of contact_explain_experiment; on failure text receives only the reason. */
int contact_complete_cases(const char *experiment, char *text, int text_length, int *needed);

/* Last error, for callers of contact_addon.h.
 *
 * ire, icp        result element and contact patch (-1 for wheel and rail); ire 0: the library as a whole
 * message         receives "" or the reason, truncated to fit; may be NULL
 * message_length  size of message in bytes, the final null included
 *
 * Returns its code, 0 without an error; 0 with a text is a warning, for example of a flag that was
 * replaced by the nearest value. The error is cleared by this call, and by the next calculation of the problem.
 */
int contact_last_error(int ire, int icp, char *message, int message_length);

/* How a case ended */
enum {
  CONTACT_NOT_CALCULATED = -1, /* no such problem, no calculation yet, or only a check of the input (R = 2, 3) */
  CONTACT_SOLVED = 0,          /* every iteration and every prescribed force reached its tolerance */
  CONTACT_NOT_CONVERGED = 1,   /* there are results; an iteration or a prescribed force did not reach its tolerance */
  CONTACT_REFUSED = 2          /* there is no result */
};

/* What did not converge */
enum {
  CONTACT_MISSED_NONE = 0,
  CONTACT_MISSED_NORMAL = 1,
  CONTACT_MISSED_TANGENTIAL = 2,
  CONTACT_MISSED_OUTER = 3, /* pressures against tractions, friction against slip or temperature */
  CONTACT_MISSED_FORCE = 4  /* a prescribed force */
};

/* State of the last calculation of a problem, regardless of its error code.
 *
 * ire, icp        result element and contact patch (-1 for wheel and rail)
 * iteration       receives CONTACT_MISSED_...; may be NULL
 * message         receives "" or the reason in one sentence, truncated to fit; may be NULL
 * message_length  size of message in bytes, the final null included
 *
 * Returns CONTACT_SOLVED, CONTACT_NOT_CONVERGED, CONTACT_REFUSED or CONTACT_NOT_CALCULATED. */
int contact_case_status(int ire, int icp, int *iteration, char *message, int message_length);

/* Derivatives of wheel and rail: of which results (rows), with respect to which inputs (columns) */
enum {
  CONTACT_FX_TRACK, CONTACT_FY_TRACK, CONTACT_FZ_TRACK, /* force in the directions of the track [F] */
  CONTACT_MX_RAIL, CONTACT_MY_RAIL, CONTACT_MZ_RAIL,    /* moment about the rail marker in these directions [F L] */
  CONTACT_FX_SET, CONTACT_FY_SET, CONTACT_FZ_SET,       /* force in the directions of the wheelset [F] */
  CONTACT_MX_WHEEL, CONTACT_MY_WHEEL, CONTACT_MZ_WHEEL, /* moment about the wheel marker in these directions [F L] */
  CONTACT_Z_SET,                                        /* height of the wheelset [L] */
  CONTACT_JACOBIAN_ROWS
};
enum {
  CONTACT_BY_Y, CONTACT_BY_Z, CONTACT_BY_ROLL, CONTACT_BY_YAW,                                /* position [L], [A] */
  CONTACT_BY_VS, CONTACT_BY_VY, CONTACT_BY_VROLL, CONTACT_BY_VYAW, CONTACT_BY_VPITCH,         /* velocity [V], [A/T] */
  CONTACT_BY_FZ,                                                                              /* vertical force [F] */
  CONTACT_JACOBIAN_COLUMNS
};

/* Kinds of derivatives */
enum {
  CONTACT_DERIVATIVE_EXACT = 0,     /* of the discrete equations, with fixed contact area and element division */
  CONTACT_DERIVATIVE_ONE_SIDED = 1, /* a patch or a part of one appears or vanishes here: valid towards the other side */
  CONTACT_DERIVATIVE_NONE = 2       /* not available; the message has the reason */
};

/* Derivatives of the forces and moments of cntc_getglobalforces, and of the height, at the last calculation of a wheel on a rail.
 *
 * With a prescribed vertical force (N = 1) the height follows from the other inputs: the column of z is 0. With a prescribed height
 * (N = 0) the column of FZ is 0. Derivatives are calculated by this call only; results do not change.
 *
 * ire             result element
 * values          receives the rows one after the other, [CONTACT_JACOBIAN_ROWS][CONTACT_JACOBIAN_COLUMNS], in the units and with
 *                 the signs of the element; unchanged without derivatives
 * room            size of values
 * message         receives "" or the reason of a state other than 0, truncated to fit; may be NULL
 * message_length  size of message in bytes, the final null included
 *
 * Returns CONTACT_DERIVATIVE_..., or a negative number before a calculation. */
int contact_wheel_rail_jacobian(int ire, double *values, int room, char *message, int message_length);

/* Many cases in one call, without files; used by studies, see doc/user/studies.md.
 *
 * A batch keeps profiles, influence coefficients and plans from call to call. It may be used by one thread at a time;
 * different threads may use different batches at the same time. */
typedef struct contact_batch contact_batch;

/* Open a batch. threads: number of threads of each calculation; seconds: time limit of each case [s], 0: none.
 * Returns NULL if there is not enough memory */
contact_batch *contact_batch_open(int threads, double seconds);
void contact_batch_close(contact_batch *batch);

/* Cases to be solved, and arrays for their results */
typedef struct {
  const char *text;     /* cases in the readable format (doc/user/readable.md) */
  const char *folder;   /* file names are relative to it; NULL for the current folder */
  const char *names;    /* numbers that vary, "group.key", separated by line ends; the second case of the text gives them all */
  int numbers, sets;    /* how many numbers vary, and how many sets of values are given. numbers = 0: the cases of the text
                           are solved in order. Otherwise only the second one is, once for each set; it keeps the input of
                           the first */
  const double *given;  /* their values, [sets][numbers], in the units of the keys */
  int room_rows, room_columns, room_cases; /* sizes of the arrays below */
  double *values;       /* totals, [room_rows][room_columns]; values that a row does not have are unchanged */
  int *places;          /* case from 1 and patch of each row, [room_rows][2]. A contact problem has one row, patch 1; wheel and
                           rail one for both together, patch 0, and one for each patch */
  int *states;          /* CONTACT_SOLVED, ..., and CONTACT_MISSED_... of each case, [room_cases][2]; 5: time limit */
  char *reasons;        /* why a case was not solved, [room_cases][reason_length], null-terminated; others are unchanged */
  int reason_length;
  int rows, cases, columns; /* receive the numbers of rows, cases and columns, the latter of all calls with this batch */
} contact_batch_job;

/* Solve cases. Errors of a case are reported in states and reasons, and the next one is solved.
 *
 * message         receives "" or the reason of a failure, truncated to fit; may be NULL
 * message_length  size of message in bytes, the final null included
 *
 * Returns 0, or another number if the text cannot be read or an array is too small; rows, cases and columns are set then. */
int contact_batch_solve(contact_batch *batch, contact_batch_job *job, char *message, int message_length);

/* Name, unit and meaning of a column of values, counted from 1, each written to a buffer of this length.
 * Returns 0 for a real, 1 for an integer of patches, 2 and 3 for those of wheel and rail together, -1 without such a column */
int contact_batch_column(contact_batch *batch, int number, char *name, char *unit, char *meaning, int length);

/* An element field, such as "pn", of a patch of the case that was solved last: numbers of elements along x and y, centre of the
 * first element and sides of an element [mm], unit; and its values, [my][mx]. Return 0, or 1 if there is no such field */
int contact_batch_field(contact_batch *batch, int patch, const char *name, int *mx, int *my, double frame[4], char *unit,
                        int length);
int contact_batch_field_values(contact_batch *batch, int patch, const char *name, int room, double *values);

/* Creep forces from a table: steady rolling of an elliptic contact, or of two half ellipses, in less than a microsecond.
 *
 * `contact table FILE` makes a table (doc/user/tables.md). Forces are once continuously differentiable and never exceed mu * fn.
 * Any number of threads may use the same table at the same time. A look-up allocates no memory and opens no file. */
typedef struct contact_table contact_table;

/* A contact. Units are free but consistent: N, mm, N/mm2 and 1/mm, or N, m, N/m2 and 1/m */
typedef struct {
  double fn, mu, gg;     /* normal force, coefficient of friction, modulus of rigidity */
  double aa, bneg, bpos; /* semi-axis along x, the rolling direction; extents towards negative and positive y from the widest row,
                            equal in an ellipse. y of the creepages and of the moment is 0 in the middle of both ends */
} contact_table_patch;

/* Results of contact_table_force */
enum {
  CONTACT_TABLE_INSIDE = 0,  /* forces of the table */
  CONTACT_TABLE_OUTSIDE = 1, /* the table has no such shape or spin: forces for those at its border */
  CONTACT_TABLE_WRONG = 2    /* no forces: no table, an input is not a number or above 1e40, modulus or a length below 1e-40 */
};

/* Properties of a table */
typedef struct {
  int has_offset;        /* 1: of two half ellipses, 0: of ellipses */
  int elements, order;   /* elements per side of the results it was made from, and the order of their discretisation */
  double poisson;        /* Poisson ratio of the bodies */
  double ratio[2];       /* smallest and largest a/b, b = (bneg + bpos)/2 */
  double offset;         /* largest |bpos - bneg|/(bpos + bneg) */
  double spin;           /* largest gg*a*b*c*KP*|phi|/(mu*fn), c = sqrt(a*b), KP of doc/theory/tables.md; infinite: all */
  double asked;          /* required error, relative to mu * fn */
  double error[2];       /* largest error found: of the forces relative to mu * fn, of the moment to mu * fn * sqrt(a * b) */
  double points;         /* number of random points, not used for the table, at which it was found */
  double grid_error[2];  /* largest difference between these results and those with three times as many elements per side */
  double bytes;          /* memory of the table */
} contact_table_facts;

/* Read a table. Returns NULL if it cannot be used; message (may be NULL) receives "" or the reason,
 * truncated to message_length */
contact_table *contact_table_open(const char *file, char *message, int message_length);
void contact_table_close(contact_table *table);
/* Returns 0, or 1 without a table */
int contact_table_about(const contact_table *table, contact_table_facts *facts);

/* Forces on body 1 for creepages xi, eta and spin phi, with the signs of basic contact: Fx, Fy and the moment Mz; derivatives[i][j]
 * of force i by creepage j. contact_table_forces does many contacts: creepages and forces [count][3], derivatives [count][3][3] and
 * results [count], the last two may be NULL; it returns the worst result. */
int contact_table_force(const contact_table *table, const contact_table_patch *patch, const double creepage[3], double force[3]);
int contact_table_force_derivatives(const contact_table *table, const contact_table_patch *patch, const double creepage[3],
                                    double force[3], double derivatives[3][3]);
int contact_table_forces(const contact_table *table, int count, const contact_table_patch *patches, const double *creepages,
                         double *forces, double *derivatives, int *answers);

#ifdef __cplusplus
}
#endif
#endif
