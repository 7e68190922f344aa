#include "harness/experiments/experiments_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases/format/format.h"
#include "cases/scene/scene.h"

/* Writes the scene as a scene file in a string, which the caller frees. REFUSED: the scene cannot
 * be written as a scene file. */
static status restart_text(const scene *, char **out, fault *);
/* Compares the scene with the stored text. REFUSED: the texts differ; the message gives the first
 * different line. */
static status restart_text_check(const char *former, const scene *, fault *);

status restart_possible(const scene *s, fault *f)
{
    for (int i = 0; i < s->loads; i++)
        if (s->load[i].feedback.node != SCENE_NONE && s->load[i].feedback.integral != 0)
            return fault_set(f, STATUS_REFUSED,
                             "%s (feedback): the integral of the error cannot be stored; remove "
                             "--save-state and --restart, and compute the whole motion in one run",
                             scene_called(s, SCENE_LOADS, i).text);
    for (int i = 0; i < s->analyses; i++)
        if (s->analysis[i].kind == SCENE_MOTION)
            return STATUS_OK;
    return fault_set(f, STATUS_REFUSED,
                     "--save-state and --restart require a motion, but the scene has none; remove "
                     "these options, or add an analysis with the key 'motion'");
}

void restart_free(restart *r)
{
    for (int i = 0; i < r->ends; i++)
        outcome_end_free(&r->end[i]);
    free(r->end);
    free(r->scene);
    memset(r, 0, sizeof *r);
}

static status check_chosen(const restart *r, const solution_request *of, fault *f)
{
    if (strcmp(r->formulation, of->formulation.key) != 0 || r->elements != of->elements)
        return fault_set(f, STATUS_REFUSED,
                         "the --restart file was written with -f %s -n %d, not with -f %s -n %d; "
                         "give the formulation and the number of elements of the file",
                         r->formulation, r->elements, of->formulation.key, of->elements);
    if (r->keep_all != of->keep_all)
        return fault_set(f, STATUS_REFUSED,
                         "the --restart file was written by a run %s --all-dofs; %s --all-dofs",
                         r->keep_all ? "with" : "without", r->keep_all ? "give" : "remove");
    return STATUS_OK;
}

/* Removes the stations before the stored state. REFUSED: there is no later station. */
static status drop_stations(outcome_end *e, scene *s, fault *f)
{
    scene_motion *m = &s->analysis[e->analysis].of.motion;
    const double last = m->path.value[m->path.stations - 1], near = 1e-9 * m->step;
    int kept = 0;
    e->omits = 0;
    for (int i = 0; i < m->path.stations; i++)
        if (m->path.value[i] >= e->time - near)
            m->path.value[kept++] = m->path.value[i];
        else {
            e->omits++;
            e->omitted = m->path.value[i];
        }
    if (!(last > e->time + near))
        return fault_set(f, STATUS_REFUSED,
                         "the --restart file ends at %.10g s, but the last station of the motion "
                         "is at %.10g s; add a later station to the scene",
                         e->time, last);
    m->path.stations = kept;
    return STATUS_OK;
}

status restart_begin(restart *r, solution_request *of, scene *s, fault *f)
{
    TRY(check_chosen(r, of, f));
    TRY(restart_text_check(r->scene, s, f));
    for (int i = 0; i < r->ends; i++) {
        const int k = r->end[i].analysis;
        if (k < 0 || k >= s->analyses || s->analysis[k].kind != SCENE_MOTION)
            return fault_set(f, STATUS_REFUSED,
                             "--restart: %s is not a motion of the scene; write the file again by "
                             "running the first part of the motion with --save-state",
                             scene_called(s, SCENE_ANALYSES, k).text);
        TRY(drop_stations(&r->end[i], s, f));
    }
    of->restart = r->end;
    of->restarts = r->ends;
    return STATUS_OK;
}

/* Contents of the file: `scene` and `formulation` as text, `run` (elements, keep_all, ends), and
 * for each end K of a motion `numbers_K`, the scalars of outcome_end, and `value_K`, its vector
 * `value`. */

static const char kind[] = "beamwork-motion-end-4";
enum { RUN = 3, NUMBERS = 21, FIRST_COUNT = 11, COUNTS = 5, MOST_ENDS = 1000 };

static void to_numbers(const outcome_end *e, double out[NUMBERS])
{
    const double list[NUMBERS] = {e->analysis,
                                  e->time,
                                  e->step,
                                  e->path,
                                  e->work,
                                  e->dissipated,
                                  e->largest,
                                  e->origin,
                                  e->stress,
                                  e->contraction,
                                  e->quiet,
                                  (double)e->states,
                                  (double)e->coordinates,
                                  (double)e->strains,
                                  (double)e->released,
                                  (double)e->between,
                                  e->turned,
                                  e->extent,
                                  e->rate,
                                  e->density,
                                  e->scale};
    memcpy(out, list, sizeof list);
}

static void of_numbers(const double in[NUMBERS], outcome_end *e)
{
    *e = (outcome_end){.analysis = (int)in[0],
                       .time = in[1],
                       .step = in[2],
                       .path = in[3],
                       .work = in[4],
                       .dissipated = in[5],
                       .largest = in[6],
                       .origin = in[7],
                       .stress = in[8],
                       .contraction = in[9],
                       .quiet = (int)in[10],
                       .states = (size_t)in[11],
                       .coordinates = (size_t)in[12],
                       .strains = (size_t)in[13],
                       .released = (size_t)in[14],
                       .between = (size_t)in[15],
                       .turned = in[16],
                       .extent = in[17],
                       .rate = in[18],
                       .density = in[19],
                       .scale = in[20]};
}

static void put_values(record_file *r, const char *name, size_t count, const double value[])
{
    const hsize_t size = count;
    H5Dclose(record_values(r, r->file, name, 1, &size, value, NULL));
}

static void put_text(record_file *r, const char *name, const char *text)
{
    const hsize_t size = strlen(text);
    H5Dclose(record_array(r, r->file, name, H5T_NATIVE_CHAR, 1, &size, text));
}

static void put_ends(record_file *r, const solve_result *of)
{
    for (int i = 0; i < of->ends; i++) {
        char name[40];
        double numbers[NUMBERS];
        to_numbers(&of->end[i], numbers);
        snprintf(name, sizeof name, "numbers_%d", i);
        put_values(r, name, NUMBERS, numbers);
        snprintf(name, sizeof name, "value_%d", i);
        put_values(r, name, outcome_end_values(&of->end[i]), of->end[i].value);
    }
}

status restart_write(const char *path, const solution_request *of, const sweep *s, fault *f)
{
    const solve_result *solved = &s->series[0].cell[0].solve;
    const double run[RUN] = {of->elements, of->keep_all, solved->ends};
    record_file r;
    char *text;
    TRY(restart_text(&s->point[0].scene, &text, f));
    status outcome = record_open(&r, f);
    if (outcome == STATUS_OK) {
        put_text(&r, "kind", kind);
        put_text(&r, "formulation", of->formulation.key);
        put_text(&r, "scene", text);
        put_values(&r, "run", RUN, run);
        put_ends(&r, solved);
        outcome = record_close(&r, path, f);
    }
    free(text);
    return outcome;
}

typedef struct source {
    hid_t file;
    const char *path;
} source;

/* Returns the contents of a one-dimensional data set, followed by a zero; NULL: the data set does
 * not exist or has another form. *count: on entry, the required number of values (negative: any
 * number); on return, the number of values. */
static void *take(const source *from, const char *name, hid_t type, size_t size, long *count)
{
    const hid_t set =
        H5Lexists(from->file, name, H5P_DEFAULT) > 0 ? H5Dopen2(from->file, name, H5P_DEFAULT) : -1;
    const hid_t space = set >= 0 ? H5Dget_space(set) : -1;
    const hid_t stored = set >= 0 ? H5Dget_type(set) : -1;
    const hssize_t there = space >= 0 && H5Sget_simple_extent_ndims(space) == 1
                               ? H5Sget_simple_extent_npoints(space)
                               : -1;
    void *out = NULL;
    if (there >= 0 && there < (1L << 40) && (*count < 0 || there == *count) && stored >= 0 &&
        H5Tget_class(stored) == H5Tget_class(type))
        out = calloc((size_t)there + 1, size);
    if (out != NULL && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, out) < 0) {
        free(out);
        out = NULL;
    }
    *count = there;
    handles_close(3, (const hid_t[]){stored, space, set});
    return out;
}

static char *take_text(const source *from, const char *name)
{
    long any = -1;
    return take(from, name, H5T_NATIVE_CHAR, 1, &any);
}

static double *take_values(const source *from, const char *name, long count)
{
    return take(from, name, H5T_NATIVE_DOUBLE, sizeof(double), &count);
}

static status damaged(const source *from, fault *f)
{
    return fault_set(
        f, STATUS_FAULT,
        "%.200s was not written by --save-state of this version of beamwork; run the first part of "
        "the motion again with --save-state, for example --save-state state.h5",
        from->path);
}

static int whole(double x, double most)
{
    return x >= 0 && x <= most && x == floor(x);
}

static status read_end(const source *from, int i, outcome_end *out, fault *f)
{
    char name[40];
    snprintf(name, sizeof name, "numbers_%d", i);
    double *numbers = take_values(from, name, NUMBERS);
    int good = numbers != NULL && whole(numbers[0], MOST_ENDS) && whole(numbers[10], 1e9) &&
               isfinite(numbers[1]) && numbers[2] > 0 && isfinite(numbers[2]);
    for (int k = FIRST_COUNT; good && k < FIRST_COUNT + COUNTS; k++)
        good = whole(numbers[k], 1e12);
    if (good) {
        of_numbers(numbers, out);
        snprintf(name, sizeof name, "value_%d", i);
        out->value = take_values(from, name, (long)outcome_end_values(out));
        good = out->value != NULL;
    }
    free(numbers);
    return good ? STATUS_OK : damaged(from, f);
}

static status read_all(const source *from, restart *out, fault *f)
{
    char *of = take_text(from, "kind"), *key = take_text(from, "formulation");
    double *run = take_values(from, "run", RUN);
    out->scene = take_text(from, "scene");
    const int good = of != NULL && strcmp(of, kind) == 0 && key != NULL &&
                     strlen(key) < sizeof out->formulation && run != NULL && whole(run[0], 1e9) &&
                     whole(run[1], 1) && whole(run[2], MOST_ENDS) && run[2] > 0 &&
                     out->scene != NULL;
    if (good) {
        snprintf(out->formulation, sizeof out->formulation, "%s", key);
        out->elements = (int)run[0];
        out->keep_all = (int)run[1];
        out->ends = (int)run[2];
        out->end = calloc((size_t)out->ends, sizeof *out->end);
    }
    free(of);
    free(key);
    free(run);
    if (!good)
        return damaged(from, f);
    if (out->end == NULL) {
        out->ends = 0;
        return fault_memory(f, "the final state of a motion");
    }
    for (int i = 0; i < out->ends; i++)
        TRY(read_end(from, i, &out->end[i], f));
    return STATUS_OK;
}

status restart_read(const char *path, restart *out, fault *f)
{
    source from = {.path = path};
    memset(out, 0, sizeof *out);
    TRY(checksum_check(path, f));
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    from.file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    if (from.file < 0)
        return damaged(&from, f);
    const status outcome = read_all(&from, out, f);
    H5Fclose(from.file);
    return outcome;
}

/* Replaces the stations of all motions by the single station *zero. */
static void equal_stations(scene *plain, double *zero)
{
    for (int i = 0; i < plain->analyses; i++)
        if (plain->analysis[i].kind == SCENE_MOTION)
            plain->analysis[i].of.motion.path = (scene_path){1, zero};
}

static status restart_text(const scene *s, char **out, fault *f)
{
    static const write_head head = {"motion", "a motion that continues another motion", "none"};
    double zero = 0;
    scene plain = *s;
    *out = NULL;
    plain.quantities = plain.meshes = 0;
    plain.analysis = malloc((size_t)(s->analyses + 1) * sizeof *plain.analysis);
    if (plain.analysis != NULL) {
        memcpy(plain.analysis, s->analysis, (size_t)s->analyses * sizeof *plain.analysis);
        equal_stations(&plain, &zero);
        *out = write_scene_text(&plain, &head);
    }
    free(plain.analysis);
    if (*out == NULL)
        return fault_memory(f, "the text of a scene");
    if (**out != '\0')
        return STATUS_OK;
    free(*out);
    *out = NULL;
    return fault_set(f, STATUS_REFUSED,
                     "a continued motion is identified by its scene file, but scene files cannot "
                     "express this scene; remove --save-state and --restart");
}

static int line_of(const char **text)
{
    *text += strspn(*text, " ");
    return (int)strcspn(*text, "\n");
}

enum { BEFORE = 30, EXCERPT = 70 };
static int excerpt_length(int length)
{
    return length < EXCERPT ? length : EXCERPT;
}

static status differ(const char *former, const char *now, fault *f)
{
    while (*former != '\0' || *now != '\0') {
        const char *a = former, *b = now;
        const int n = line_of(&a), k = line_of(&b);
        if (n != k || memcmp(a, b, (size_t)n) != 0) {
            int same = 0;
            while (same < n && same < k && a[same] == b[same])
                same++;
            same = same > BEFORE ? same - BEFORE : 0;
            return fault_set(
                f, STATUS_REFUSED,
                "the --restart file belongs to another scene: there '%.*s', here '%.*s'; give the "
                "scene and the parameters with which the file was written",
                excerpt_length(n - same), a + same, excerpt_length(k - same), b + same);
        }
        former = a + n + (a[n] == '\n');
        now = b + k + (b[k] == '\n');
    }
    return STATUS_OK;
}

static status restart_text_check(const char *former, const scene *s, fault *f)
{
    char *now;
    TRY(restart_text(s, &now, f));
    const status outcome = differ(former, now, f);
    free(now);
    return outcome;
}
