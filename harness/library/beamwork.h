/* beamwork.h: scenes, solutions and verdicts from your own program.
 *
 * Handles are opaque and documents are text: no struct crosses the border. SI units, UTF-8.
 * A function that can fail returns a bw_status. *why (NULL: not needed) is then one line that names
 * culprit and remedy; for a scene with mistakes it is a JSON list of all of its mistakes, with
 * file, line and column. It is NULL after BW_OK. Texts that are handed over (char **) are freed
 * with bw_free_text; const char * belong to the handle. After a failure the result is NULL.
 * Wherever a handle or a name is required, NULL is refused.
 *
 * The library prints nothing, ends no program, and leaves no signal handler, no locale, no rounding
 * mode and no handler of GSL or HDF5 after; what the host has set of these changes no number. A
 * loaded formulation runs inside the host's process: where it crashes, the host does; bw_converge
 * and bw_verify run it in processes of their own.
 *
 * Threads: different handles may be used at the same time, one handle by one thread at a time
 * (several threads may solve a scene that does not change). bw_truths and bw_formulation_load come
 * before the threads. A thread needs a stack of 1 MB. */
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

/* How a call ended. */
typedef enum bw_status {
    BW_OK,
    BW_NOT_CONVERGED, /* an iteration ended without meeting its criterion */
    BW_SINGULAR,      /* a matrix that must be invertible is not */
    BW_REFUSED,       /* the input makes no sense or is not offered */
    BW_FAULT,         /* file, disk or memory */
    BW_TIME_LIMIT,    /* stopped by the clock */
    BW_NO_VALUE       /* the requested value does not exist */
} bw_status;

/* A case or a scene file at values of its parameters, with the reference values that belong to it.
 */
typedef struct bw_scene bw_scene;
/* One cell: a scene solved with a formulation and a number of elements. */
typedef struct bw_result bw_result;

BW_API const char *bw_version(void);                 /* as "0.1.0" */
BW_API void bw_free_text(char *text);                /* NULL: nothing */
BW_API const char *bw_status_name(bw_status status); /* "ok", "not_converged", ... */

/* Sets the location of the packed reference values of the built-in cases, for all that is read from
 * now on. path NULL: BEAMWORK_TRUTHS, or beside the library, or share/beamwork of where it was
 * installed. FAULT: they are not there or damaged. Without them cases are solved all the same,
 * but results have no errors. */
BW_API bw_status bw_truths(const char *path, char **why);

/* Lists what is available, as `beamwork list --format json`. what NULL: all; or "cases",
 * "formulations", or the name of one case or formulation. */
BW_API bw_status bw_list(const char *what, char **json, char **why);
/* A formulation from outside, as --element takes it: "./mine.so", "exec:python3 my_beam.py". It
 * stays for the life of the program. One of another process serves one thread at a time. *name (may
 * be NULL): what it is called. */
BW_API bw_status bw_formulation_load(const char *path, char **name, char **why);

/* A built-in case at its defaults. */
BW_API bw_status bw_scene_case(const char *name, bw_scene **out, char **why);
/* A scene file's bytes; name: what messages call it (NULL: "scene"). */
BW_API bw_status bw_scene_read(const char *text, size_t size, const char *name, bw_scene **out,
                               char **why);
/* The same of a file. */
BW_API bw_status bw_scene_open(const char *path, bw_scene **out, char **why);
/* "NAME=VALUE", as --set: "thickness=0.5e-3". Results made before keep theirs. */
BW_API bw_status bw_scene_set(bw_scene *scene, const char *assignment, char **why);
/* Its parameters, its quantities and the formulations that can run it, as `beamwork list CASE
 * --format json`. */
BW_API bw_status bw_scene_json(const bw_scene *scene, char **json, char **why);
/* As a scene file, as `beamwork scene` writes it: it reads back as the same scene, bit for bit. */
BW_API bw_status bw_scene_write(const bw_scene *scene, char **yaml, char **why);
BW_API void bw_scene_free(bw_scene *scene); /* NULL: nothing; its results stay */

/* Solves one cell. formulation: as for -f ("beamw:mass=lumped"); NULL: chosen as `beamwork solve`
 * does. elements: of each member; 0: the coarsest mesh on which no value changes by more than
 * "error" from the one before; NOT_CONVERGED where the finest still does. options (NULL: none): a
 * JSON object with any of "all_dofs" (true: no degree of freedom is eliminated), "steps" (initial
 * number between stations; the step size adapts), "shapes" (most states of a path whose shapes are
 * kept; for a motion that many instants, 60 where 5 or fewer are requested), "threads", "error"
 * (default 0.001). After NOT_CONVERGED, SINGULAR and NO_VALUE *out is a result all the same, with
 * the values that were found. */
BW_API bw_status bw_solve(const bw_scene *scene, const char *formulation, int elements,
                          const char *options, bw_result **out, char **why);
BW_API void bw_result_free(bw_result *result); /* NULL: nothing */
/* As `beamwork solve --format json`. */
BW_API bw_status bw_result_json(const bw_result *result, char **json, char **why);
BW_API const char *bw_result_formulation(const bw_result *result); /* name with its options */
BW_API int bw_result_elements(const bw_result *result);            /* of each member */

/* How many quantities it has; they are counted from 0. */
BW_API int bw_result_quantities(const bw_result *result);
/* The name of one; NULL: there is no such one. */
BW_API const char *bw_result_name(const bw_result *result, int quantity);
/* The SI unit of one; NULL: there is no such one. */
BW_API const char *bw_result_unit(const bw_result *result, int quantity);
/* [unit of the quantity]; NaN: it has no value, or there is no such quantity. */
BW_API double bw_result_value(const bw_result *result, const char *quantity);
/* (value - truth)/|truth|, as `beamwork solve` shows it; NaN: there is no truth. */
BW_API double bw_result_error(const bw_result *result, const char *quantity);
/* Point of the value: for a largest or least value of a motion, or one at an instant, the time [s];
 * along other paths the path parameter; NaN: none, or no value. */
BW_API double bw_result_at(const bw_result *result, const char *quantity);
/* Points of a curve; 0: the quantity is not one. The arrays [points] are the result's. */
BW_API size_t bw_result_curve(const bw_result *result, const char *quantity, const double **x,
                              const double **y);
/* A column of numbers of its load steps, as `beamwork schema` names them ("path", "iterations",
 * "correction", ...); their number, 0: there are none, or no such column. The array is the
 * result's. */
BW_API size_t bw_result_steps(bw_result *result, const char *column, const double **values);
/* A column of its motions in time: one row for the initial state and one for the end of each step.
 * Names as in `beamwork schema` ("time", "step", "kinetic", "strain", "work", "drift", "px", "lz",
 * ...). Returns the number of rows; 0: the result has no motion, or there is no such column. The
 * array is the result's. */
BW_API size_t bw_result_motion(bw_result *result, const char *column, const double **values);
/* Shapes that were requested: *points of all centre lines together; *position [states x points x
 * 3] [m]; the number of states, the first of them undeformed. */
BW_API size_t bw_result_shapes(bw_result *result, size_t *points, const double **position);
/* *first [members + 1]: the point where each member begins; the number of members. */
BW_API size_t bw_result_members(const bw_result *result, const int **first);
/* Kind of a state: "path", "buckling", "motion", ...; NULL: there is no such state. */
BW_API const char *bw_result_shape_kind(const bw_result *result, size_t state);
/* Its path parameter, load factor, frequency [Hz] or time [s]; NaN: there is no such state. */
BW_API double bw_result_shape_value(const bw_result *result, size_t state);

/* Formulations side by side, as `beamwork converge --format json`. formulations: separated by
 * blanks, "all" or NULL: all that support what the scene needs. meshes: "1,2,4"; NULL: the scene's.
 * options: "error" (0.01: the error that `answers` refers to), "select" (as -k), "jobs"
 * (processes), "stop" (a file descriptor: once it can be read, as a pipe into which the caller
 * writes, the processes end and the call returns
 * TIME_LIMIT). */
BW_API bw_status bw_converge(const bw_scene *scene, const char *formulations, const char *meshes,
                             const char *options, char **json, char **why);
/* Verdicts, as `beamwork verify --json`. scene NULL: all built-in cases; else that scene's file at
 * its defaults and the points of its truths, or that case. select: as -k, NULL: all. results: an
 * HDF5 file to write, NULL: none. options: "jobs", "time_limit" ([s] of a cell, 120), "refine"
 * (more meshes of each series, each with twice the elements), "shapes", "stop", "tolerance"
 * (relative, in place of those of the cases), "not_worse_than" (a file of results: larger errors
 * than there fail, and limits that moved). OK also where verdicts differ from the expected ones:
 * the document counts them ("unexpected"). */
BW_API bw_status bw_verify(const bw_scene *scene, const char *formulations, const char *select,
                           const char *options, const char *results, char **json, char **why);

#ifdef __cplusplus
}
#endif
#endif
