#include "harness/library/library_impl.h"

#include <fcntl.h>
#include <gsl/gsl_errno.h>
#include <limits.h>
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "elements/shared/choice.h"
#include "harness/experiments/experiments.h"
#include "harness/numerics/numerics.h"

static source *source_hold(source *);
/* Sets *out to the reference values of a case, or only to the known deviations for a scene file.
 * The data are read in the first call. *out is NULL after FAULT. */
static status source_known(source *, const truths **out, fault *f);

enum { STEPS_MOST = 1000000 };

/* Reads the options. *stop: the descriptor that ends the solution; 0: none. */
static status read_options(const char *json, solution_request *out, int *stop, fault *f)
{
    int stability = 1;
    const call_option table[] = {
        {"stability", OPTION_SWITCH, &stability, 0, 1},
        {"all_dofs", OPTION_SWITCH, &out->keep_all, 0, 1},
        {"keep_all", OPTION_SWITCH, &out->keep_all, 0, 1}, /* former name of "all_dofs", which
                                                            * version 0.2 used */
        {"steps", OPTION_WHOLE, &out->steps, 1, STEPS_MOST},
        {"shapes", OPTION_WHOLE, &out->shapes, 0, SHAPES_ALL},
        {"threads", OPTION_WHOLE, &out->threads, 1, THREAD_POOL_MOST},
        {"stop", OPTION_FILE, stop, 1, INT_MAX},
        {"error", OPTION_SHARE, &out->error, 0, 0},
        {.name = NULL}};
    json_t *kept;
    const status outcome = options_read(json, table, &kept, f);
    json_decref(kept);
    out->skips_stability = !stability;
    return outcome;
}

static status read_truths(bw_result *r, const double parameter[], fault *f)
{
    const scene_file *file = source_file(r->from);
    if (file != NULL) {
        r->truths = &r->own;
        return scene_truths_add(file, parameter, &r->own, f);
    }
    source_known(r->from, &r->truths, NULL);
    return STATUS_OK;
}

static status choose(const bw_result *r, const char *name, solution_request *out,
                     solution_choice *why, fault *f)
{
    const truths *deviations = NULL;
    if (name != NULL)
        TRY(formulation_parse(name, &out->formulation, f));
    else
        source_known(r->from, &deviations, NULL);
    return solution_choose(out, deviations != NULL ? deviations->rule : NULL,
                           deviations != NULL ? deviations->rules : 0, 1, why, f);
}

static double error_of(const subject *s)
{
    const quantity_result *found = s->record;
    return s->truth != NULL
               ? verdict_error(&s->point->scene.quantity[s->index], found->value, s->truth->value)
               : NAN;
}

static status compare(bw_result *r, fault *f)
{
    const gathering g = {&r->sweep, NULL, r->truths};
    const int count = result_handle_scene(r)->quantities;
    subjects list = {0};
    r->error = malloc(((size_t)count + 1) * sizeof *r->error);
    if (r->error == NULL)
        return fault_memory(f, "errors");
    for (int i = 0; i < count; i++)
        r->error[i] = NAN;
    gather_mesh(&g, &record_quantity, 0, 0, &list);
    for (int i = 0; i < list.count; i++)
        r->error[list.row[i].index] = error_of(&list.row[i]);
    const int bad = list.bad;
    gather_free(&list);
    return bad ? fault_memory(f, "errors") : STATUS_OK;
}

/* Fills the result. *solved: status of the solution, whose message is in f. */
static status fill(bw_result *r, const bw_scene *from, const char *name, solution_request *what,
                   solution_choice *why, status *solved, fault *f)
{
    fault lost = {""};
    TRY(read_truths(r, from->parameter, f));
    TRY(choose(r, name, what, why, f));
    TRY(solution_plan(what, &r->sweep, f));
    *solved = solution_run(what, why, &r->sweep, f);
    if (*solved == STATUS_REFUSED || *solved == STATUS_FAULT)
        return *solved;
    const status compared = compare(r, &lost);
    if (compared != STATUS_OK)
        *f = lost;
    return compared;
}

static status solve(const bw_scene *from, const char *name, int elements, const char *options,
                    bw_result **out, fault *f)
{
    status solved = STATUS_OK;
    int stop = 0;
    if (out != NULL)
        *out = NULL;
    if (from == NULL || out == NULL)
        return fault_set(
            f, STATUS_REFUSED,
            "bw_solve: an argument is NULL; give a scene and a pointer for the result");
    if (elements < 0 || elements > MESHES_FINEST)
        return fault_set(f, STATUS_REFUSED,
                         "the number of elements %d is not valid; give a whole number from 1 to "
                         "%d, or 0 to let the program choose",
                         elements, MESHES_FINEST);
    solution_request what = {
        .type = source_case(from->from), .parameter = from->parameter, .elements = elements};
    TRY(read_options(options, &what, &stop, f));
    bw_result *r = calloc(1, sizeof *r);
    if (r == NULL)
        return fault_memory(f, "a result");
    r->from = source_hold(from->from);
    solution_choice why = {.formulation = ""};
    stop_observe(stop);
    status filled = fill(r, from, name, &what, &why, &solved, f);
    if (filled == STATUS_FAULT && stop_check(NULL) != STATUS_OK)
        filled = fault_set(f, STATUS_TIME_LIMIT,
                           "stopped before the solution was finished, as option 'stop' requested");
    stop_observe(0);
    solution_choice_free(&why);
    if (filled == STATUS_OK)
        *out = r;
    else
        bw_result_free(r);
    return filled == STATUS_OK ? solved : filled;
}

bw_status bw_solve(const bw_scene *from, const char *name, int elements, const char *options,
                   bw_result **out, char **why)
{
    call c;
    call_begin(&c, why);
    return call_end(&c, solve(from, name, elements, options, out, &c.fault));
}

void bw_result_free(bw_result *r)
{
    if (r == NULL)
        return;
    sweep_free(&r->sweep);
    truths_free(&r->own);
    source_release(r->from);
    free(r->error);
    for (int i = 0; i < RESULT_COLUMNS; i++) {
        free(r->step[i]);
        free(r->motion[i]);
    }
    free(r->position);
    free(r);
}

_Static_assert((int)BW_FAULT == (int)STATUS_FAULT && (int)BW_NO_VALUE == (int)STATUS_NO_VALUE,
               "a bw_status is a status");

/* GSL has one error handler for all threads. The first call disables the handler, and the last call
 * restores it. nested: number of nested calls of this thread. */
static _Thread_local int nested;
static struct {
    pthread_mutex_t lock;
    int inside;
    gsl_error_handler_t *before;
    locale_t plain;
} state = {.lock = PTHREAD_MUTEX_INITIALIZER};

static void before_fork(void)
{
    known_hold();
    pthread_mutex_lock(&state.lock);
}

static void after_fork(void)
{
    pthread_mutex_unlock(&state.lock);
    known_release();
}

static void in_child(void)
{
    state.inside = nested;
    after_fork();
}

static void mind_forks(void)
{
    pthread_atfork(before_fork, after_fork, in_child);
}

static locale_t go_in(void)
{
    static pthread_once_t forks = PTHREAD_ONCE_INIT;
    pthread_once(&forks, mind_forks);
    nested++;
    pthread_mutex_lock(&state.lock);
    if (state.plain == (locale_t)0)
        state.plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (state.inside++ == 0)
        state.before = gsl_set_error_handler_off();
    const locale_t plain = state.plain;
    pthread_mutex_unlock(&state.lock);
    return plain;
}

static void go_out(void)
{
    nested--;
    pthread_mutex_lock(&state.lock);
    if (--state.inside == 0)
        gsl_set_error_handler(state.before);
    pthread_mutex_unlock(&state.lock);
}

void call_begin(call *c, char **why)
{
    c->fault.text[0] = '\0';
    c->text = NULL;
    c->why = why;
    if (why != NULL)
        *why = NULL;
    c->locale = uselocale(go_in());
    fegetenv(&c->arithmetic);
    fesetenv(FE_DFL_ENV);
}

/* Returns the number of bytes of the UTF-8 character that starts at this address; 0: invalid. */
static int character(const unsigned char *at)
{
    const int more = (at[0] >= 0xc2) + (at[0] >= 0xe0) + (at[0] >= 0xf0);
    if (at[0] < ' ' || at[0] == 0x7f || (at[0] >= 0x80 && at[0] < 0xc2) || at[0] > 0xf4)
        return 0;
    for (int i = 1; i <= more; i++)
        if ((at[i] & 0xc0) != 0x80)
            return 0;
    return 1 + more;
}

static char *line_of(const fault *f)
{
    char *out = strdup(f->text);
    if (out == NULL)
        return NULL;
    for (unsigned char *at = (unsigned char *)out; *at != '\0';) {
        const int bytes = character(at);
        if (bytes == 0)
            *at = '?';
        at += bytes > 0 ? bytes : 1;
    }
    return out;
}

bw_status call_end(call *c, status outcome)
{
    fesetenv(&c->arithmetic);
    uselocale(c->locale);
    go_out();
    if (outcome != STATUS_OK && c->why != NULL)
        *c->why = c->text != NULL ? c->text : line_of(&c->fault);
    else
        free(c->text);
    return (bw_status)outcome;
}

static pthread_mutex_t hdf5 = PTHREAD_MUTEX_INITIALIZER;
static struct {
    H5E_auto2_t print;
    void *context;
} host;
static char place[PATH_MAX]; /* "": default location */

void known_hold(void)
{
    pthread_mutex_lock(&hdf5);
}

void known_release(void)
{
    pthread_mutex_unlock(&hdf5);
}

static void mute_library_errors(void)
{
    H5Eget_auto2(H5E_DEFAULT, &host.print, &host.context);
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
}

static void restore_library_errors(void)
{
    H5Eset_auto2(H5E_DEFAULT, host.print, host.context);
}

void known_lock(void)
{
    known_hold();
    mute_library_errors();
}

void known_unlock(void)
{
    restore_library_errors();
    known_release();
}

static void place_now(char path[PATH_MAX])
{
    if (place[0] != '\0')
        memcpy(path, place, PATH_MAX);
    else
        data_place_truths(path);
}

static status known_read_held(const case_type *type, truths *out, fault *f)
{
    char path[PATH_MAX];
    place_now(path);
    mute_library_errors();
    const status outcome =
        type != NULL ? truths_read_case(path, type, out, f) : truths_read_rules(path, out, f);
    restore_library_errors();
    return outcome;
}

status known_read(const case_type *type, truths *out, fault *f)
{
    known_hold();
    const status outcome = known_read_held(type, out, f);
    known_release();
    return outcome;
}

status known_read_all(truths *out, fault *f)
{
    char path[PATH_MAX];
    place_now(path);
    known_lock();
    const status outcome = truths_read(path, out, f);
    known_unlock();
    return outcome;
}

static status known_place(const char *path, fault *f)
{
    truths t;
    const size_t length = path != NULL ? strlen(path) : 0;
    if (length >= PATH_MAX)
        return fault_set(f, STATUS_REFUSED, "truths: the path is too long; give a shorter one");
    memcpy(place, path != NULL ? path : "", length + 1);
    const status outcome = known_read_all(&t, f);
    if (outcome == STATUS_OK)
        truths_free(&t);
    else
        place[0] = '\0';
    return outcome;
}

struct source {
    atomic_int holders;
    const case_type *type;
    scene_file *file;
    char *name;
    int is_known;
    truths known;
};

status source_new(const case_type *type, scene_file *file, char *name, source **out, fault *f)
{
    *out = calloc(1, sizeof **out);
    if (*out == NULL) {
        scene_file_free(file);
        free(name);
        return fault_memory(f, "a scene");
    }
    **out = (source){.type = type, .file = file, .name = name};
    atomic_init(&(*out)->holders, 1);
    return STATUS_OK;
}

static source *source_hold(source *s)
{
    atomic_fetch_add(&s->holders, 1);
    return s;
}

void source_release(source *s)
{
    if (s == NULL || atomic_fetch_sub(&s->holders, 1) > 1)
        return;
    truths_free(&s->known);
    scene_file_free(s->file);
    free(s->name);
    free(s);
}

const case_type *source_case(const source *s)
{
    return s->type;
}

const scene_file *source_file(const source *s)
{
    return s->file;
}

static status source_known(source *s, const truths **out, fault *f)
{
    status outcome = STATUS_OK;
    known_hold();
    if (!s->is_known)
        outcome = known_read_held(s->file == NULL ? s->type : NULL, &s->known, f);
    s->is_known |= outcome == STATUS_OK;
    *out = s->is_known ? &s->known : NULL;
    known_release();
    return outcome;
}

const char *bw_version(void)
{
    return environment_version();
}

void bw_free_text(char *text)
{
    free(text);
}

const char *bw_status_name(bw_status s)
{
    return s >= BW_OK && s <= BW_NO_VALUE ? status_name((status)s) : "unknown";
}

bw_status bw_truths(const char *path, char **why)
{
    call c;
    call_begin(&c, why);
    return call_end(&c, known_place(path, &c.fault));
}

static status load(const char *path, char **name, fault *f)
{
    const element_type *type;
    if (name != NULL)
        *name = NULL;
    if (path == NULL)
        return fault_set(f, STATUS_REFUSED,
                         "bw_formulation_load: the path is NULL or empty; give the path of a "
                         "shared object, such as ./mine.so");
    TRY(plugin_load(path, &type, f));
    TRY(formulations_add(type, NULL, f));
    if (name != NULL && (*name = strdup(type->name)) == NULL)
        return fault_memory(f, "a name");
    return STATUS_OK;
}

bw_status bw_formulation_load(const char *path, char **name, char **why)
{
    call c;
    call_begin(&c, why);
    return call_end(&c, load(path, name, &c.fault));
}

static const char *name_at(const void *context, int i)
{
    return ((const call_option *)context)[i].name;
}

static status unknown(const char *key, const call_option table[], fault *f)
{
    const char *near = choice_nearest(key, name_at, table);
    return fault_set(f, STATUS_REFUSED,
                     "unknown option '%.60s'%s%s%s%s lists the options of each function", key,
                     near != NULL ? "; did you mean '" : "", near != NULL ? near : "",
                     near != NULL ? "'? " : "; ", "beamwork.h");
}

static int is_within(const call_option *o, json_int_t value)
{
    return value >= o->least && value <= o->most;
}

static status take(const call_option *o, json_t *value, fault *f)
{
    const double number = json_number_value(value);
    switch (o->kind) {
    case OPTION_SWITCH:
        if (!json_is_boolean(value))
            return fault_set(f, STATUS_REFUSED, "option '%s' is not valid; give true or false",
                             o->name);
        *(int *)o->to = json_is_true(value);
        return STATUS_OK;
    case OPTION_WHOLE:
        if (!json_is_integer(value) || !is_within(o, json_integer_value(value)))
            return fault_set(f, STATUS_REFUSED,
                             "option '%s' is not valid; give a whole number from %d to %d", o->name,
                             o->least, o->most);
        *(int *)o->to = (int)json_integer_value(value);
        return STATUS_OK;
    case OPTION_FILE:
        if (!json_is_integer(value) || !is_within(o, json_integer_value(value)) ||
            fcntl((int)json_integer_value(value), F_GETFD) < 0)
            return fault_set(f, STATUS_REFUSED,
                             "option '%s' is not valid; give the descriptor of an open file",
                             o->name);
        *(int *)o->to = (int)json_integer_value(value);
        return STATUS_OK;
    case OPTION_SHARE:
        if (!json_is_number(value) || !(number > 0 && number < 1))
            return fault_set(
                f, STATUS_REFUSED,
                "option '%s' is not valid; give a number between 0 and 1, such as 0.01", o->name);
        *(double *)o->to = number;
        return STATUS_OK;
    case OPTION_WORDS:
        break;
    }
    if (!json_is_string(value))
        return fault_set(f, STATUS_REFUSED, "option '%s' is not valid; give a text", o->name);
    *(const char **)o->to = json_string_value(value);
    return STATUS_OK;
}

status options_read(const char *json, const call_option table[], json_t **kept, fault *f)
{
    json_error_t error;
    const char *key;
    json_t *value;
    *kept = NULL;
    if (json == NULL)
        return STATUS_OK;
    *kept = json_loads(json, JSON_REJECT_DUPLICATES, &error);
    if (*kept == NULL)
        return fault_set(f, STATUS_REFUSED, "options: line %d, column %d: %.150s", error.line,
                         error.column, error.text);
    if (!json_is_object(*kept))
        return fault_set(f, STATUS_REFUSED,
                         "the options are not a JSON object; give one such as {\"threads\": 2}");
    json_object_foreach(*kept, key, value)
    {
        const call_option *o = table;
        while (o->name != NULL && strcmp(o->name, key) != 0)
            o++;
        TRY(o->name != NULL ? take(o, value, f) : unknown(key, table, f));
    }
    return STATUS_OK;
}
