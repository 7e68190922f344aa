/* beamwork.h: scenes, solutions and verdicts from your own program.
 *
 * Handles are opaque and documents are text: the interface has no structs. Units are SI, texts are
 * UTF-8. A function that can fail returns a bw_status. After a failure, *why is one line that names
 * the cause and, where there is one, the remedy; `why` may be NULL if the text is not needed. For a
 * scene with errors, *why is a JSON list of all errors, with file, line and column. *why is NULL
 * after BW_OK. The caller frees texts returned as char ** with bw_free_text; texts returned as
 * const char * belong to the handle. After a failure, the result is NULL (exception: bw_solve). A
 * required handle or name that is NULL is rejected.
 *
 * The library prints nothing and does not end the program. It does not change signal handlers, the
 * locale, the rounding mode or the handlers of GSL and HDF5, and the host's settings of these do
 * not affect results. A loaded formulation runs in the host's process. If it crashes, the host
 * crashes as well. bw_converge and bw_verify run it in separate processes.
 *
 * Threads: different handles may be used at the same time. A handle may be used by one thread at a
 * time, but several threads may solve the same scene while it does not change. Call bw_truths and
 * bw_formulation_load before the threads start. A thread needs a stack of 1 MB. */
#ifndef BEAMWORK_LIBRARY_H
#define BEAMWORK_LIBRARY_H

#include <stddef.h>

#if defined(__GNUC__)
#define BW_API __attribute__((visibility("default")))
#else
#define BW_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Outcome of a call. */
typedef enum bw_status {
    BW_OK,
    BW_NOT_CONVERGED, /* an iteration did not converge */
    BW_SINGULAR,      /* a matrix that must be invertible is singular */
    BW_REFUSED,       /* invalid or unsupported input */
    BW_FAULT,         /* error of a file, the disk or memory */
    BW_TIME_LIMIT,    /* stopped by a time limit or by the caller */
    BW_NO_VALUE       /* the requested value does not exist */
} bw_status;

/* A case or a scene file at given parameter values, with its reference values. */
typedef struct bw_scene bw_scene;
/* A run: a scene solved with a formulation and a number of elements. */
typedef struct bw_result bw_result;

BW_API const char *bw_version(void);                 /* as "0.1.0" */
BW_API void bw_free_text(char *text);                /* NULL: nothing */
BW_API const char *bw_status_name(bw_status status); /* "ok", "not_converged", ... */

/* Sets the location of the packed reference values of the built-in cases for all later calls. path
 * NULL: BEAMWORK_TRUTHS, a file next to the library, or share/beamwork of the installation. FAULT:
 * the file is missing or damaged. Without reference values, cases can be solved, but results have
 * no errors. */
BW_API bw_status bw_truths(const char *path, char **why);

/* Lists cases and formulations in the same way as `beamwork list --format json`. what: "cases",
 * "formulations", or the name of a case or formulation; NULL: everything. */
BW_API bw_status bw_list(const char *what, char **json, char **why);
/* Loads an external formulation, in the form of the option --element: "./mine.so" or "exec:python3
 * my_beam.py". It remains loaded until the program ends. A formulation in another process serves
 * one thread at a time. *name (may be NULL): name of the formulation. */
BW_API bw_status bw_formulation_load(const char *path, char **name, char **why);

/* Makes a scene from a built-in case at its defaults. */
BW_API bw_status bw_scene_case(const char *name, bw_scene **out, char **why);
/* Reads a scene from memory. name: used in messages (NULL: "scene"). */
BW_API bw_status bw_scene_read(const char *text, size_t size, const char *name, bw_scene **out,
                               char **why);
/* Reads a scene from a file. */
BW_API bw_status bw_scene_open(const char *path, bw_scene **out, char **why);
/* Sets a parameter with "NAME=VALUE", in the form of the option --set, such as "thickness=0.5e-3".
 * Existing results do not change. */
BW_API bw_status bw_scene_set(bw_scene *scene, const char *assignment, char **why);
/* Returns the parameters, the quantities, and the formulations that run the scene, in the same form
 * as `beamwork list CASE --format json`. */
BW_API bw_status bw_scene_json(const bw_scene *scene, char **json, char **why);
/* Writes a scene file, in the same form as `beamwork scene`. Reading the file gives the same scene,
 * bit for bit. */
BW_API bw_status bw_scene_write(const bw_scene *scene, char **yaml, char **why);
BW_API void bw_scene_free(bw_scene *scene); /* does nothing for NULL; results remain valid */

/* Performs a run. formulation: in the form of the option -f, such as "beamw:mass=lumped"; NULL:
 * chosen in the same way as by `beamwork solve`. elements: number per member; 0: the coarsest mesh
 * on which all values differ from those of the previous mesh by at most "error". NOT_CONVERGED: the
 * values still change on the finest mesh. options (NULL: none): a JSON object with any of
 * "all_dofs" (true: no degree of freedom is eliminated), "steps" (initial number between stations;
 * the step size adapts), "shapes" (largest number of path states with stored shapes; for a motion,
 * number of times, at least 60 if 5 or fewer are requested), "threads", "error" (default 0.001),
 * "stability" (false: flutter is not sought along static paths, as in bw_converge), "stop" (a file
 * descriptor: when it becomes readable, the iteration ends and the call returns TIME_LIMIT). After
 * NOT_CONVERGED, SINGULAR and NO_VALUE *out is a result with the values that were found. */
BW_API bw_status bw_solve(const bw_scene *scene, const char *formulation, int elements,
                          const char *options, bw_result **out, char **why);
BW_API void bw_result_free(bw_result *result); /* NULL: nothing */
/* Returns the result in the same form as `beamwork solve --format json`. */
BW_API bw_status bw_result_json(const bw_result *result, char **json, char **why);
BW_API const char *bw_result_formulation(const bw_result *result); /* name with its options */
BW_API int bw_result_elements(const bw_result *result);            /* number per member */

/* Returns the number of quantities; indices start at 0. */
BW_API int bw_result_quantities(const bw_result *result);
/* Returns the name of a quantity; NULL: there is no quantity with this index. */
BW_API const char *bw_result_name(const bw_result *result, int quantity);
/* Returns the SI unit of a quantity; NULL: there is no quantity with this index. */
BW_API const char *bw_result_unit(const bw_result *result, int quantity);
/* Returns the value in the unit of the quantity; NaN: there is no value, or no such quantity. */
BW_API double bw_result_value(const bw_result *result, const char *quantity);
/* Returns (value - reference)/s, which `beamwork solve` also prints; s is |reference| or, if it is
 * larger, the key near_zero of the quantity. NaN: there is no value, or no reference value. */
BW_API double bw_result_error(const bw_result *result, const char *quantity);
/* Returns the position of the value on the path. For a motion: the time [s] of an extremum, or of a
 * value at an instant; for other paths: the path parameter; NaN: none, or no value. */
BW_API double bw_result_at(const bw_result *result, const char *quantity);
/* Returns the number of points of a curve; 0: the quantity is not a curve. The result owns the
 * arrays [points]. */
BW_API size_t bw_result_curve(const bw_result *result, const char *quantity, const double **x,
                              const double **y);
/* Returns a numeric column of the load steps, and the number of steps; 0: there are no steps, or no
 * such column. The names of columns are those of `beamwork schema` ("path", "iterations",
 * "correction", ...). The result owns the array. */
BW_API size_t bw_result_steps(bw_result *result, const char *column, const double **values);
/* Returns a numeric column of the motions, and the number of rows; 0: there is no motion, or no
 * such column. There is a row for the initial state and a row for the end of each step. The names
 * of columns are those of `beamwork schema` ("time", "step", "kinetic", "strain", "work", "drift",
 * "px", "lz", ...). The result owns the array. */
BW_API size_t bw_result_motion(bw_result *result, const char *column, const double **values);
/* Returns the requested shapes. *points: number of points of all centre lines. *position [states x
 * points x 3] [m]. Returns the number of states. The first state is undeformed. */
BW_API size_t bw_result_shapes(bw_result *result, size_t *points, const double **position);
/* Returns the number of members; 0: no shapes were requested. *first [members + 1]: index of the
 * first point of each member. */
BW_API size_t bw_result_members(const bw_result *result, const int **first);
/* Returns the kind of a state: "path", "buckling", "motion", ...; NULL: there is no such state. */
BW_API const char *bw_result_shape_kind(const bw_result *result, size_t state);
/* Returns the path parameter, load factor, frequency [Hz] or time [s] of a state; NaN: there is no
 * such state. */
BW_API double bw_result_shape_value(const bw_result *result, size_t state);

/* Compares formulations in the same way as `beamwork converge --format json`. formulations:
 * separated by blanks; "all" or NULL: all formulations that support the physics of the scene.
 * meshes: "1,2,4"; NULL: those of the scene. options: "error" (error target of `answers`, default
 * 0.01), "select" (in the form of -k), "jobs" (processes), "stop" (a file descriptor, for example
 * of a pipe: when it becomes readable, the processes end and the call returns TIME_LIMIT). */
BW_API bw_status bw_converge(const bw_scene *scene, const char *formulations, const char *meshes,
                             const char *options, char **json, char **why);
/* Computes verdicts in the same way as `beamwork verify --json`. scene NULL: all built-in cases;
 * otherwise the case, or the scene file at its defaults and at the points of its reference values.
 * select: in the form of -k; NULL: all. results: HDF5 file to be written; NULL: none. options:
 * "jobs", "time_limit" ([s] of a run, 120), "refine" (number of additional meshes of each series,
 * each with twice the elements), "shapes", "stop", "tolerance" (relative, replaces those of the
 * cases), "not_worse_than" (a results file: larger errors and changed limits fail). Returns OK even
 * if verdicts differ from the expected ones. The document counts these verdicts ("unexpected"). */
BW_API bw_status bw_verify(const bw_scene *scene, const char *formulations, const char *select,
                           const char *options, const char *results, char **json, char **why);

#ifdef __cplusplus
}
#endif
#endif
