#include "cases/scene/scene.h"

#include <math.h>

typedef struct scaled {
    double *number;
    int power;
} scaled;

static void scale(size_t count, const scaled list[], double x)
{
    for (size_t i = 0; i < count; i++)
        *list[i].number *= pow(x, list[i].power);
}

#define SCALE(list, x) scale(sizeof(list) / sizeof(list)[0], list, x)

static void scale_vector(double v[3], double factor)
{
    for (int i = 0; i < 3; i++)
        v[i] *= factor;
}

static void scale_constants(section *c, double x)
{
    const scaled list[] = {{&c->young, -2},     {&c->shear_modulus, -2}, {&c->density, -4},
                           {&c->width, 1},      {&c->height, 1},         {&c->centroid[0], 1},
                           {&c->centroid[1], 1}};
    SCALE(list, x);
    for (int i = 0; i < 36; i++) { /* forces, then moments */
        const int power = (i / 6 > 2) + (i % 6 > 2);
        c->stiffness[i] *= pow(x, power);
        c->mass[i] *= pow(x, power - 2);
    }
    for (int i = 0; i < 9; i++) { /* in the order y, z, omega */
        const int power = 2 + (i / 3 == 2) + (i % 3 == 2);
        c->D[i] *= pow(x, power);
        c->F[i] *= pow(x, -power);
    }
}

static void scale_section(section_spec *spec, double x)
{
    for (int i = 0; i < spec->points; i++)
        for (int k = 0; k < 2; k++)
            spec->point[i][k] *= x;
    for (int i = 0; i < spec->walls; i++)
        spec->wall[i].thickness *= x;
    scale_constants(&spec->constants, x);
}

/* Returns 1 if the value of the driver is a length, 0 if it is an angle, and -1 if it prescribes
 * both. */
static int is_length(const scene *s, int driver)
{
    int lengths = 0, angles = 0;
    for (int i = 0; i < s->nodes; i++)
        for (int k = 0; k < 3; k++) {
            lengths += s->node[i].translation[k] == driver;
            angles += s->node[i].angle[k] == driver;
        }
    for (int i = 0; i < s->drivers; i++)
        if (s->driver[i].value == NULL && s->driver[i].condition_driver == driver)
            *(s->driver[i].condition_component <= SCENE_UZ ? &lengths : &angles) += 1;
    return lengths > 0 && angles > 0 ? -1 : lengths > 0;
}

static status scale_drivers(scene *s, double x, fault *f)
{
    for (int i = 0; i < s->drivers; i++) {
        const int length = is_length(s, i);
        if (length < 0)
            return fault_set(f, STATUS_REFUSED,
                             "motion '%s' prescribes both lengths and angles, so its unit is not "
                             "defined; use one motion for lengths and one for angles",
                             s->driver[i].name);
        if (s->driver[i].value == NULL || !length)
            continue;
        scene_function *function = &s->driver[i].function;
        function->scale = (function->scale != 0 ? function->scale : 1) * x;
        for (int k = 0; k < s->driver[i].stations; k++)
            s->driver[i].value[k] *= x;
    }
    return STATUS_OK;
}

static void scale_spring(scene_spring *p, double x)
{
    for (int i = 0; i < 36; i++) {
        p->stiffness[i] *= pow(x, (i / 6 >= 3) + (i % 6 >= 3) - 1);
        p->damping[i] *= pow(x, (i / 6 >= 3) + (i % 6 >= 3) - 1);
    }
}

static void scale_feedback(scene_load *load, double times)
{
    scene_feedback *b = &load->feedback;
    if (b->node == SCENE_NONE || b->component >= SCENE_RX)
        return;
    b->proportional /= times;
    b->derivative /= times;
    b->integral /= times;
    load->function.scale = (load->function.scale != 0 ? load->function.scale : 1) * times;
}

static void scale_load(scene_load *load, entry_base base, double times)
{
    if (base == ENTRY_LENGTH)
        scale_feedback(load, times);
    const double factor = pow(times, entry_power(entry_of_load(load->kind)->unit, base));
    scale_vector(load->vector, factor);
    scale_vector(load->last, factor);
}

static void scale_extract(const scene *s, scene_quantity *q, entry_base base, double times)
{
    const int power = entry_power(quantity_type_of(q)->unit(s, q), base);
    q->factor *= scene_is_timed(q->reduction) ? 1 : pow(times, -power);
    q->passing.level *= pow(times, power);
}

static void scale_entries(scene *s, entry_base base, double times)
{
    for (int i = 0; i < s->sections; i++)
        entry_scale(entry_section, &s->section[i], base, times);
    for (int i = 0; i < s->nodes; i++)
        entry_scale(entry_node, &s->node[i], base, times);
    for (int i = 0; i < s->members; i++)
        entry_scale(entry_member, &s->member[i], base, times);
    for (int i = 0; i < s->springs; i++)
        entry_scale(entry_spring, &s->spring[i], base, times);
    for (int i = 0; i < s->imperfections; i++)
        entry_scale(entry_imperfection, &s->imperfection[i], base, times);
    for (int i = 0; i < s->drivers; i++)
        entry_scale(entry_driver, &s->driver[i], base, times);
    for (int i = 0; i < s->loads; i++) {
        entry_scale(entry_load, &s->load[i], base, times);
        scale_load(&s->load[i], base, times);
    }
    for (int i = 0; i < s->analyses; i++)
        entry_scale(entry_analysis, &s->analysis[i], base, times);
    for (int i = 0; i < s->quantities; i++) {
        entry_scale(entry_quantity, &s->quantity[i], base, times);
        scale_extract(s, &s->quantity[i], base, times);
    }
}

/* Steps of the control coordinate are lengths, whereas steps of arc length are dimensionless. */
static void scale_steps(scene_analysis *a, double x)
{
    if (a->kind != SCENE_CONTINUATION || a->of.continuation.control.by_arc)
        return;
    a->of.continuation.control.step *= x;
    a->of.continuation.control.step_max *= x;
}

/* Returns 1 if the stations are lengths: for a continuation, or a compliance analysis that follows
 * one. */
static int stations_are_lengths(const scene *s, const scene_quantity *q)
{
    if (q->analysis < 0 || q->analysis >= s->analyses)
        return 0;
    const scene_analysis *a = &s->analysis[q->analysis];
    if (a->kind == SCENE_COMPLIANCE && a->follows != SCENE_NONE)
        a = &s->analysis[a->follows];
    return a->kind == SCENE_CONTINUATION;
}

static void scale_stations(const scene *s, scene_quantity *q, double x)
{
    if (!stations_are_lengths(s, q))
        return;
    q->at *= x;
    q->x.factor /= q->reduction == SCENE_CURVE ? x : 1;
}

status scene_change_unit(scene *s, double x, fault *f)
{
    if (!(x > 0 && isfinite(x)))
        return fault_set(f, STATUS_REFUSED,
                         "%g length units per metre are not possible; give a positive number", x);
    for (int i = 0; i < s->sections; i++)
        scale_section(&s->section[i], x);
    scale_entries(s, ENTRY_LENGTH, x);
    for (int i = 0; i < s->springs; i++)
        scale_spring(&s->spring[i], x);
    for (int i = 0; i < s->imperfections; i++)
        for (int k = 0; k < s->imperfection[i].nodes; k++)
            scale_vector(s->imperfection[i].shift[k], x);
    for (int i = 0; i < s->analyses; i++)
        scale_steps(&s->analysis[i], x);
    for (int i = 0; i < s->quantities; i++)
        scale_stations(s, &s->quantity[i], x);
    return scale_drivers(s, x, f);
}

void scene_change_force(scene *s, double y)
{
    scale_entries(s, ENTRY_FORCE, y);
    for (int i = 0; i < s->sections; i++) {
        section *c = &s->section[i].constants;
        double *const list[] = {&c->young, &c->shear_modulus, &c->density};
        for (size_t k = 0; k < sizeof list / sizeof list[0]; k++)
            *list[k] *= y;
        for (int k = 0; k < 36; k++) {
            c->stiffness[k] *= y;
            c->mass[k] *= y;
        }
    }
    for (int i = 0; i < s->springs; i++)
        for (int k = 0; k < 36; k++) {
            s->spring[i].stiffness[k] *= y;
            s->spring[i].damping[k] *= y;
        }
}

/* Returns the largest dimension of a section, or 0 if the section is not given by dimensions. */
static double size_of(const section_spec *spec)
{
    double low[2] = {0}, high[2] = {0};
    if (spec->kind == SECTION_RECTANGLE)
        return fmax(spec->width, spec->height);
    if (spec->kind == SECTION_TUBE)
        return spec->diameter;
    for (int i = 0; spec->kind == SECTION_WALLS && i < spec->points; i++)
        for (int k = 0; k < 2; k++) {
            low[k] = i == 0 ? spec->point[i][k] : fmin(low[k], spec->point[i][k]);
            high[k] = i == 0 ? spec->point[i][k] : fmax(high[k], spec->point[i][k]);
        }
    return fmax(high[0] - low[0], high[1] - low[1]);
}

static double longest(const scene *s)
{
    double most = 0;
    for (int i = 0; i < s->members; i++) {
        const scene_node *p = &s->node[s->member[i].p], *q = &s->node[s->member[i].q];
        most = fmax(most,
                    hypot(hypot(p->position[0] - q->position[0], p->position[1] - q->position[1]),
                          p->position[2] - q->position[2]));
    }
    return most;
}

/* Structures in SI units satisfy the bounds below. For example, the wave speed in solids is between
 * 30 m/s and 30 km/s. */
int scene_looks_foreign(const scene *s, char words[FAULT_TEXT])
{
    static const double soft[2] = {1e3, 1e6}, stiff = 1e8, wide = 15, slow = 30, fast = 3e4;
    const double length = longest(s);
    for (int i = 0; i < s->sections; i++) {
        const section_spec *spec = &s->section[i];
        const double E = spec->kind == SECTION_CONSTANTS && !(spec->young > 0)
                             ? spec->constants.young
                             : spec->young,
                     rho = spec->kind == SECTION_CONSTANTS && !(spec->density > 0)
                               ? spec->constants.density
                               : spec->density,
                     size = size_of(spec), speed = rho > 0 ? sqrt(E / rho) : NAN;
        if (spec->kind == SECTION_MATRICES || !(E > 0))
            continue;
        if (E >= soft[0] && E <= soft[1] && length >= 10 && size >= 0.1) {
            snprintf(
                words, FAULT_TEXT,
                "a Young's modulus of %g Pa and members of %g m suggest units of mm, N and MPa", E,
                length);
            return 1;
        }
        if (E >= stiff && size >= wide && length >= wide) {
            snprintf(words, FAULT_TEXT,
                     "a section width of %g m and a Young's modulus of %g Pa suggest lengths in mm",
                     size, E);
            return 1;
        }
        if ((rho >= 300 && speed < slow) || (E >= soft[0] && speed > fast)) {
            snprintf(words, FAULT_TEXT,
                     "no solid has a Young's modulus of %g Pa and a density of %g kg/m^3; the "
                     "values seem to be in other units",
                     E, rho);
            return 1;
        }
    }
    return 0;
}
