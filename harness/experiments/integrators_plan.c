#include "harness/experiments/experiments_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/shared/choice.h"

/* Returns the list first, first/ratio, first/ratio^2, ... */
static integrators_list integrators_list_divided(double first, double ratio, int count);
/* Returns the time [s] from which no load acts. INFINITY: there are supports, or some load or
 * prescribed motion does not end. */
static double integrators_alone_from(const scene *s);

enum {
    STATIONS_OF_ERROR = 20,
    USUAL_STEPS = 4,
    USUAL_TOLERANCES = 3,
    PARTS = 100 /* ratio of consecutive tolerances */
};
static const double usual_tolerance = 1e-4,
                    same = 1e-9 /* usual_tolerance: default tolerance of a step; same: times count
                                   as equal if their relative difference is smaller */
    ;

static int motion_of(const scene *s)
{
    for (int i = 0; i < s->analyses; i++)
        if (s->analysis[i].kind == SCENE_MOTION)
            return i;
    return -1;
}

static status no_motion(const char *name, fault *f)
{
    return fault_set(
        f, STATUS_REFUSED,
        "case %s has no transient analysis; choose a case with a motion, such as pendulum", name);
}

status integrators_plan_default(integrators_plan_request *r, fault *f)
{
    scene s;
    status outcome = cell_scene(r->type, r->parameter, NULL, &s, f);
    const int analysis = outcome == STATUS_OK ? motion_of(&s) : -1;
    if (outcome == STATUS_OK && analysis < 0)
        outcome = no_motion(r->type->name, f);
    if (outcome == STATUS_OK) {
        if (r->elements == 0)
            r->elements = s.meshes > 1 ? s.mesh[1] : 4;
        if (r->steps.count == 0 && r->tolerances.count == 0) {
            r->steps = integrators_list_divided(2 * scene_motion_of(&s.analysis[analysis])->step, 2,
                                                USUAL_STEPS);
            r->tolerances = integrators_list_divided(usual_tolerance, PARTS, USUAL_TOLERANCES);
        }
    }
    scene_free(&s);
    return outcome;
}

static status stations_of(double spacing, double end, scene_path *out, fault *f)
{
    const int before = (int)ceil(end / spacing * (1 - same)) - 1;
    double *value = malloc((size_t)(before + 1) * sizeof *value);
    if (value == NULL)
        return fault_memory(f, "the stations of a motion");
    for (int i = 0; i < before; i++)
        value[i] = (i + 1) * spacing;
    value[before] = end;
    free(out->value);
    *out = (scene_path){before + 1, value};
    return STATUS_OK;
}

static status set_motion(integrators *p, const integrators_group *g, const integrators_run *r,
                         double spacing, fault *f)
{
    sweep_point *at = &p->sweep.point[p->sweep.points - 1];
    scene_motion *how = &at->scene.analysis[g->analysis].of.motion;
    how->scheme = r->method.scheme;
    if (how->mass == SCENE_MASS_USUAL)
        how->mass = SCENE_LUMPED;
    how->alpha = r->method.alpha;
    how->step = r->step;
    how->tolerance = r->tolerance;
    return stations_of(spacing, g->end, &how->path, f);
}

/* Returns the number of times at which shapes are stored: the start and the stations. If there are
 * fewer than SHAPES_FEW stations, the intervals between them are subdivided. */
static int frames_of(const integrators_group *g, double spacing)
{
    const int parts = (int)ceil(g->end / spacing * (1 - same));
    return 1 + parts * (parts < SHAPES_FEW ? SHAPES_FEW : 1);
}

static status add_motion(integrators *p, const integrators_group *g,
                         const integrators_plan_request *q, integrators_run *r, double spacing,
                         fault *f)
{
    p->sweep.whole_only = 1;
    TRY(plan_add(&p->sweep, q->type, q->parameter, NULL, &g->elements, 1, f));
    sweep_point *at = &p->sweep.point[p->sweep.points - 1];
    if (at->status != STATUS_OK)
        return fault_set(f, at->status, "%s", at->reason);
    at->shapes = q->errors ? frames_of(g, spacing) : 0;
    at->whole_steps = q->whole;
    TRY(set_motion(p, g, r, spacing, f));
    TRY(plan_extend(&p->sweep, &q->formulation, 1, f));
    r->series = p->sweep.seriess - 1;
    series *one = &p->sweep.series[r->series];
    fault why = {""};
    if (one->missing[0] == '\0' && scene_validate(&at->scene, &why) != STATUS_OK)
        snprintf(one->missing, sizeof one->missing, "%.*s", (int)sizeof one->missing - 1, why.text);
    return STATUS_OK;
}

/* Returns the spacing of the stations [s], at which errors are examined. */
static double spacing_of(const integrators_group *g, const integrators_plan_request *q)
{
    const double coarsest = q->steps.count > 0 ? q->steps.value[0] : g->step,
                 all = g->end / coarsest, wanted = ceil(all / STATIONS_OF_ERROR * (1 - same));
    if (!q->errors)
        return g->end;
    if (fabs(all - round(all)) > same * all)
        return fmin(g->end, coarsest * wanted);
    int steps = (int)wanted;
    while (steps > 1 && (int)round(all) % steps != 0)
        steps--;
    return fmin(g->end, coarsest * steps);
}

static status add_run(integrators *p, const integrators_plan_request *q,
                      const integrators_run *what, fault *f)
{
    integrators_run *more = realloc(p->run, (size_t)(p->runs + 1) * sizeof *more);
    if (more == NULL)
        return fault_memory(f, "motions");
    p->run = more;
    integrators_group *g = &p->group[p->groups - 1];
    integrators_run *r = &p->run[p->runs];
    *r = *what;
    r->group = p->groups - 1;
    TRY(add_motion(p, g, q, r, spacing_of(g, q), f));
    p->runs++;
    g->runs++;
    return STATUS_OK;
}

static void read_exactly(scene *s, int analysis)
{
    scene_set_curve(scene_add_quantity(s, "energy at all stations", "J", analysis,
                                       scene_balance_of(SCENE_ENERGY)),
                    "time", "s", 1, 0);
}

static status add_reference(integrators *p, integrators_group *g, const integrators_plan_request *q,
                            fault *f)
{
    integrators_run r = {.step = g->step};
    TRY(integrators_method_read("radau", (int)strlen("radau"), &r.method, f));
    g->reference = p->sweep.seriess;
    for (int i = 0; i <= INTEGRATORS_CHECKS; i++) {
        r.tolerance = integrators_reference[i];
        TRY(add_motion(p, g, q, &r, spacing_of(g, q), f));
        scene *s = &p->sweep.point[p->sweep.points - 1].scene;
        read_exactly(s, g->analysis);
        if (s->out_of_memory)
            return fault_memory(f, "a motion");
    }
    return STATUS_OK;
}

static status add_runs(integrators *p, const integrators_plan_request *q, fault *f)
{
    const double step = p->group[p->groups - 1].step;
    for (int m = 0; m < q->methods; m++) {
        integrators_run r = {.method = q->method[m]};
        for (int i = 0; i < q->steps.count; i++) {
            r.step = q->steps.value[i];
            r.tolerance = 0;
            TRY(add_run(p, q, &r, f));
        }
        for (int i = 0; i < q->tolerances.count && r.method.estimate; i++) {
            r.step = step;
            r.tolerance = q->tolerances.value[i];
            TRY(add_run(p, q, &r, f));
        }
    }
    return STATUS_OK;
}

static status look(integrators_group *g, const integrators_plan_request *q, fault *f)
{
    scene s;
    const status outcome = cell_scene(q->type, q->parameter, NULL, &s, f);
    g->analysis = outcome == STATUS_OK ? motion_of(&s) : -1;
    if (g->analysis >= 0) {
        const scene_motion *how = scene_motion_of(&s.analysis[g->analysis]);
        g->step = how->step;
        g->end = how->path.value[how->path.stations - 1];
        g->from = integrators_alone_from(&s);
    }
    scene_free(&s);
    return outcome;
}

status integrators_plan_add(integrators *p, const integrators_plan_request *q, fault *f)
{
    integrators_group *more = realloc(p->group, (size_t)(p->groups + 1) * sizeof *more);
    if (more == NULL)
        return fault_memory(f, "motions");
    p->group = more;
    integrators_group *g = &p->group[p->groups];
    *g = (integrators_group){.type = q->type,
                             .formulation = q->formulation,
                             .elements = q->elements,
                             .first = p->runs,
                             .reference = -1,
                             .uncertainty = NAN};
    memcpy(g->parameter, q->parameter, sizeof g->parameter);
    TRY(look(g, q, f));
    if (g->analysis < 0)
        return no_motion(q->type->name, f);
    p->groups++;
    if (q->errors)
        TRY(add_reference(p, g, q, f));
    return add_runs(p, q, f);
}

const char integrators_method_all[] = "alpha,alpha:rho=0.5,hht,trapezoidal,conserving,radau";

enum { SCHEME_WORDS = 6, ORDER_OF_EXPLICIT = 8 };

/* Names of the integrators. For each: the key of its parameter (NULL: none), the default value and
 * the largest value. */
static const struct {
    const char *word, *value;
    double usual, most;
    scene_scheme scheme;
    int order, estimate;
} schemes[SCHEME_WORDS] = {
    {"alpha", "rho", 0.9, 1, SCENE_ALPHA, 2, 1},
    {"hht", "alpha", 0.05, 1 / 3.0, SCENE_ALPHA, 2, 1},
    {"trapezoidal", NULL, 0, 0, SCENE_ALPHA, 2, 1},
    {"conserving", NULL, 0, 0, SCENE_CONSERVING, 2, 0},
    {"radau", NULL, 0, 0, SCENE_RADAU, INTEGRATORS_REFERENCE_ORDER, 1},
    {"explicit", NULL, 0, 0, SCENE_EXPLICIT, ORDER_OF_EXPLICIT, 1},
};

static status refuse(const char *name, fault *f)
{
    return fault_set(f, STATUS_REFUSED,
                     "--integrator '%.31s' is unknown; give one of " INTEGRATORS_METHODS, name);
}

/* Reads "KEY=NUMBER" of a scheme; an empty text leaves *value unchanged. Returns 1, or 0 if the
 * text is invalid. */
static int read_value(const char *text, const char *key, double most, double *value)
{
    const size_t length = key != NULL ? strlen(key) : 0;
    const char *end;
    if (text[0] == '\0')
        return 1;
    if (key == NULL || strncmp(text, key, length) != 0 || text[length] != '=')
        return 0;
    return number_read(text + length + 1, &end, value) && *end == '\0' && *value >= 0 &&
           *value <= most;
}

status integrators_method_read(const char *text, int length, integrators_method *out, fault *f)
{
    memset(out, 0, sizeof *out);
    snprintf(out->name, sizeof out->name, "%.*s", length, text);
    const size_t word = strcspn(out->name, ":");
    int i = 0;
    while (i < SCHEME_WORDS &&
           (strlen(schemes[i].word) != word || strncmp(schemes[i].word, out->name, word) != 0))
        i++;
    if (i == SCHEME_WORDS || length >= INTEGRATORS_METHOD_NAME)
        return refuse(out->name, f);
    double value = schemes[i].usual;
    const char *rest = out->name + word + (out->name[word] == ':');
    if (!read_value(rest, schemes[i].value, schemes[i].most, &value))
        return refuse(out->name, f);
    out->scheme = schemes[i].scheme;
    out->order = schemes[i].order;
    out->estimate = schemes[i].estimate;
    if (out->scheme == SCENE_ALPHA && i == 0)
        out->alpha = scene_alpha_of_radius(value);
    else if (out->scheme == SCENE_ALPHA)
        out->alpha = (scene_alpha){0, value};
    return STATUS_OK;
}

status integrators_method_read_list(const char *text, int most, integrators_method list[],
                                    int *count, fault *f)
{
    for (const char *at = text;; at++) {
        const int length = (int)strcspn(at, ",");
        if (*count == most)
            return fault_set(f, STATUS_REFUSED,
                             "--integrator: more than %d integrators are given; give fewer", most);
        TRY(integrators_method_read(at, length, &list[*count], f));
        for (int i = 0; i < *count; i++)
            if (strcmp(list[i].name, list[*count].name) == 0)
                return fault_set(f, STATUS_REFUSED, "--integrator: %s is given twice; give it once",
                                 list[i].name);
        ++*count;
        at += length;
        if (*at == '\0')
            return STATUS_OK;
    }
}

static integrators_list integrators_list_divided(double first, double ratio, int count)
{
    integrators_list out = {.count = count};
    for (int i = 0; i < count; i++)
        out.value[i] = i == 0 ? first : out.value[i - 1] / ratio;
    return out;
}

static status list_refuse(const char *option, const char *text, fault *f)
{
    return fault_set(f, STATUS_REFUSED,
                     "--%s '%.60s' is not valid; give at most %d positive numbers, such as "
                     "0.1,0.05, or a range that is halved, such as 0.1..0.0125",
                     option, text, INTEGRATORS_LIST_MOST);
}

/* Returns the end of a positive number; NULL: the text does not start with a positive number. */
static const char *positive(const char *at, double *out)
{
    const char *end;
    if (!number_read(at, &end, out) || *out <= 0)
        return NULL;
    return *end == '.' && end[-1] == '.' ? end - 1 : end;
}

static status read_range(const char *option, const char *text, double from, double to, double ratio,
                         integrators_list *out, fault *f)
{
    const int count = to <= from ? 1 + (int)lround(log(from / to) / log(ratio)) : 0;
    if (count < 1 || count > INTEGRATORS_LIST_MOST)
        return list_refuse(option, text, f);
    *out = integrators_list_divided(from, ratio, count);
    return STATUS_OK;
}

status integrators_list_read(const char *option, const char *text, double ratio,
                             integrators_list *out, fault *f)
{
    const char *at = text;
    double to;
    out->count = 0;
    do {
        at = out->count < INTEGRATORS_LIST_MOST ? positive(at, &out->value[out->count]) : NULL;
        if (at != NULL && out->count == 0 && strncmp(at, "..", 2) == 0) {
            at = positive(at + 2, &to);
            return at != NULL && *at == '\0'
                       ? read_range(option, text, out->value[0], to, ratio, out, f)
                       : list_refuse(option, text, f);
        }
        if (at == NULL || (*at != ',' && *at != '\0'))
            return list_refuse(option, text, f);
        out->count++;
    } while (*at++ == ',');
    return STATUS_OK;
}

static int is_held(const scene_node *n)
{
    for (int i = 0; i < 3; i++)
        if (n->translation[i] != SCENE_FREE || n->angle[i] != SCENE_FREE)
            return 1;
    return n->rotation != SCENE_ROTATION_SPATIAL;
}

/* Returns 1 if the function is zero at all examined times after `from`. */
static int is_over(const scene_function *f, double from)
{
    static const double later[] = {0, 0.37, 1, 7.3, 61};
    for (size_t i = 0; i < sizeof later / sizeof later[0]; i++) {
        double value[3];
        function_at(f, from + later[i], value);
        if (value[0] != 0 || value[1] != 0)
            return 0;
    }
    return 1;
}

static double load_until(const scene_load *load)
{
    const scene_function *f = &load->function;
    if (!scene_load_acts(load))
        return 0;
    if (f->pieces > 0) {
        const double from = f->pieces > 1 ? f->piece[f->pieces - 2].until : 0;
        return is_over(f, from) ? from : INFINITY;
    }
    if (load->stations > 0 && load->factor[load->stations - 1] == 0)
        return load->path[load->stations - 1];
    return INFINITY;
}

static double integrators_alone_from(const scene *s)
{
    double from = 0;
    for (int i = 0; i < s->nodes; i++)
        if (is_held(&s->node[i]))
            return INFINITY;
    for (int i = 0; i < s->springs; i++)
        if (s->spring[i].p == SCENE_NONE || s->spring[i].q == SCENE_NONE)
            return INFINITY;
    for (int i = 0; i < s->members; i++)
        if (scene_is_founded(&s->member[i]))
            return INFINITY;
    for (int i = 0; i < s->loads; i++)
        from = fmax(from, load_until(&s->load[i]));
    return from;
}

static double apart(const double a[3], const double b[3])
{
    double square = 0;
    for (int i = 0; i < 3; i++)
        square += (a[i] - b[i]) * (a[i] - b[i]);
    return sqrt(square);
}

/* Returns the angle between the rotations of two unit quaternions; their signs have no effect.
 * Small angles are accurate too. */
static double angle(const double a[4], const double b[4])
{
    double less = 0, more = 0;
    for (int i = 0; i < 4; i++) {
        less += (a[i] - b[i]) * (a[i] - b[i]);
        more += (a[i] + b[i]) * (a[i] + b[i]);
    }
    return 4 * atan2(sqrt(fmin(less, more)), sqrt(fmax(less, more)));
}

static double size_of(const shapes *s)
{
    double size = 0;
    for (int i = 0; i < s->nodes; i++)
        for (int k = 0; k < i; k++)
            size = fmax(size, apart(s->node + 3 * (size_t)i, s->node + 3 * (size_t)k));
    return size > 0 ? size : 1;
}

static double of_state(const shapes *a, const shapes *b, size_t at, size_t other, double size)
{
    double largest = 0;
    for (size_t i = 0; i < (size_t)a->points; i++) {
        const centreline_point *p = &a->point[at * (size_t)a->points + i],
                               *q = &b->point[other * (size_t)b->points + i];
        largest = fmax(largest, fmax(apart(p->r, q->r) / size, angle(p->q, q->q)));
    }
    for (size_t i = 0; i < (size_t)a->nodes; i++)
        largest = fmax(largest, apart(a->node + 3 * (at * (size_t)a->nodes + i),
                                      b->node + 3 * (other * (size_t)b->nodes + i)) /
                                    size);
    return largest;
}

double integrators_distance(const cell_result *cell, const cell_result *other, int analysis)
{
    const shapes *a = &cell->solve.shapes, *b = &other->solve.shapes;
    double largest = 0;
    if (cell->solve.status != STATUS_OK || other->solve.status != STATUS_OK || a->states == 0 ||
        a->states != b->states || a->points != b->points)
        return NAN;
    const double size = size_of(a);
    for (int i = 0; i < a->states; i++)
        if (a->state[i].kind == SHAPE_MOTION && a->state[i].analysis == analysis)
            largest = fmax(largest, of_state(a, b, (size_t)i, (size_t)i, size));
    return largest;
}

double integrators_distance_of(const scene_quantity *q, const quantity_result *one,
                               const quantity_result *other)
{
    return one->status == STATUS_OK && other->status == STATUS_OK
               ? fabs(verdict_error(q, one->value, other->value))
               : NAN;
}
