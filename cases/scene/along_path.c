#include "cases/scene/scene_impl.h"

#include <math.h>

#include "elements/math/dense.h"

static double interpolate(int stations, const double at[], const double value[], double path)
{
    if (path <= at[0])
        return value[0];
    for (int i = 1; i < stations; i++)
        if (path <= at[i]) {
            const double t = (path - at[i - 1]) / (at[i] - at[i - 1]);
            return t == 1 ? value[i] : value[i - 1] + t * (value[i] - value[i - 1]);
        }
    return value[stations - 1];
}

double along_path_factor(const scene_load *load, double path)
{
    return load->stations > 0 ? interpolate(load->stations, load->path, load->factor, path) : path;
}

double along_path_rate(const scene_load *load, double path)
{
    if (load->stations == 0)
        return 1;
    for (int i = 1; i < load->stations; i++)
        if (path >= load->path[i - 1] && path < load->path[i])
            return (load->factor[i] - load->factor[i - 1]) / (load->path[i] - load->path[i - 1]);
    return 0;
}

double along_path_value(const scene_driver *d, double path)
{
    return interpolate(d->stations, d->path, d->value, path);
}

static int has_station(int stations, const double path[], double from, double to)
{
    int between = 0;
    for (int i = 0; i < stations; i++)
        between |= path[i] > from && path[i] < to;
    return between;
}

int along_path_is_straight(const scene *s, double from, double to)
{
    int bent = 0;
    for (int i = 0; i < s->loads; i++)
        bent |= has_station(s->load[i].stations, s->load[i].path, from, to);
    for (int d = 0; d < s->drivers; d++)
        bent |= s->driver[d].value != NULL &&
                has_station(s->driver[d].stations, s->driver[d].path, from, to);
    return !bent;
}

/* Range of the path in which loads or drivers change, or begin > end if there is no such range. */
typedef struct changes {
    double begin, end;
    scene_words last;
} changes;

static void add_changes(int stations, const double path[], const double value[],
                        scene_words owner_name, changes *c)
{
    for (int i = 1; i < stations; i++) {
        if (value[i] == value[i - 1])
            continue;
        c->begin = fmin(c->begin, path[i - 1]);
        if (path[i] > c->end)
            c->last = owner_name;
        c->end = fmax(c->end, path[i]);
    }
}

along_path_words along_path_end(const scene *s, int acting)
{
    along_path_words out = {""};
    changes c = {.begin = INFINITY, .end = -INFINITY};
    for (int i = 0; i < s->loads; i++) {
        const scene_load *load = &s->load[i];
        if (!scene_load_acts(load) || scene_acting_factor(s, acting, load->load_case) == 0)
            continue;
        if (load->stations == 0)
            return out;
        add_changes(load->stations, load->path, load->factor, scene_called(s, SCENE_LOADS, i), &c);
    }
    for (int d = 0; d < s->drivers; d++) {
        const scene_driver *driver = &s->driver[d];
        if (driver->value == NULL)
            return out;
        if (scene_acting_factor(s, acting, driver->load_case) == 0)
            continue;
        add_changes(driver->stations, driver->path, driver->value,
                    scene_called(s, SCENE_DRIVERS, d), &c);
    }
    if (c.begin > c.end)
        snprintf(out.text, sizeof out.text,
                 "; no load changes along the path; give a load that increases");
    else
        snprintf(out.text, sizeof out.text,
                 "; nothing changes outside path parameters %g to %g, because %s is constant "
                 "there; extend "
                 "its values, or remove its 'path' and 'factor' so that it increases with the path",
                 c.begin, c.end, c.last.text);
    return out;
}

/* Returns 1 if the values at all stations between 0 and 1 lie on one straight line. */
static int is_straight(int stations, const double path[], const double value[])
{
    for (int i = 0; i < stations; i++) {
        const double first = interpolate(stations, path, value, 0),
                     last = interpolate(stations, path, value, 1),
                     line = first + path[i] * (last - first);
        if (path[i] > 0 && path[i] < 1 &&
            !(fabs(value[i] - line) <= 1e-12 * (fabs(first) + fabs(last))))
            return 0;
    }
    return 1;
}

status along_path_proportional(const scene *s, int acting, fault *f)
{
    static const char words[] =
        "its values do not vary linearly between path parameters 0 and 1, as a critical load about "
        "the undeformed state requires; name a static analysis in 'about'";
    for (int i = 0; i < s->loads; i++) {
        const scene_load *load = &s->load[i];
        if (load->stations > 0 && !is_straight(load->stations, load->path, load->factor) &&
            scene_acting_factor(s, acting, load->load_case) != 0)
            return fault_set(f, STATUS_REFUSED, "%s: %s", scene_called(s, SCENE_LOADS, i).text,
                             words);
    }
    for (int d = 0; d < s->drivers; d++) {
        const scene_driver *driver = &s->driver[d];
        if (driver->value != NULL && !is_straight(driver->stations, driver->path, driver->value) &&
            scene_acting_factor(s, acting, driver->load_case) != 0)
            return fault_set(f, STATUS_REFUSED, "motion %s: %s", driver->name, words);
    }
    return STATUS_OK;
}

const char *const scene_column_name[SCENE_COLUMNS] = {"linear",
                                                      "static",
                                                      "continuation",
                                                      "buckling",
                                                      "buckling about a path",
                                                      "modal",
                                                      "modal about a linear analysis",
                                                      "modal about a path",
                                                      "modal about an instant",
                                                      "compliance",
                                                      "compliance about a path",
                                                      "rotation",
                                                      "motion",
                                                      "harmonic",
                                                      "harmonic about a linear analysis",
                                                      "harmonic about a path",
                                                      "harmonic about an instant"};

static int called(const scene *s, scene_list list, int i, char *owner_name, int size)
{
    if (owner_name != NULL)
        snprintf(owner_name, (size_t)size, "%s", scene_called(s, list, i).text);
    return 1;
}

/* Returns 1 if `is` is true for a load that acts in the analysis. Writes the name of the first such
 * load to `owner_name`, which may be NULL. */
static int load_that(const scene *s, int analysis, int (*is)(const scene_load *), char *owner_name,
                     int size)
{
    for (int i = 0; i < s->loads; i++)
        if (is(&s->load[i]) &&
            scene_acting_factor(s, scene_acting_of(s, analysis), s->load[i].load_case) != 0)
            return called(s, SCENE_LOADS, i, owner_name, size);
    return 0;
}

#define LOAD(name, condition)                                                                      \
    static int is_##name(const scene_load *l)                                                      \
    {                                                                                              \
        return condition;                                                                          \
    }                                                                                              \
    static int has_##name(const scene *s, int analysis, char *owner_name, int size)                \
    {                                                                                              \
        return load_that(s, analysis, is_##name, owner_name, size);                                \
    }
LOAD(force,
     l->kind == SCENE_FORCE && l->towards == SCENE_NONE && !l->follower && vec3_norm(l->at) == 0)
LOAD(following_force, l->kind == SCENE_FORCE && l->follower)
LOAD(force_beside, l->kind == SCENE_FORCE && vec3_norm(l->at) > 0)
LOAD(moment, l->kind == SCENE_MOMENT && !l->follower)
LOAD(following_moment, l->kind == SCENE_MOMENT && l->follower)
LOAD(line, l->kind == SCENE_DISTRIBUTED && !l->follower)
LOAD(following_line, l->kind == SCENE_DISTRIBUTED && l->follower)
LOAD(part_of_line, l->kind == SCENE_DISTRIBUTED && !l->follower && l->range[1] - l->range[0] < 1)
LOAD(varying_line, l->kind == SCENE_DISTRIBUTED && !l->follower && l->varies)
LOAD(lumped_line, l->kind == SCENE_DISTRIBUTED && !l->follower && l->lumped)
LOAD(line_of_moments, l->kind == SCENE_DISTRIBUTED_MOMENT)
LOAD(force_within, l->kind == SCENE_MEMBER_FORCE && !l->follower)
LOAD(following_force_within, l->kind == SCENE_MEMBER_FORCE && l->follower)
LOAD(moment_within, l->kind == SCENE_MEMBER_MOMENT)
LOAD(gravity, l->kind == SCENE_GRAVITY)
LOAD(weight, l->kind == SCENE_WEIGHT)
LOAD(temperature, l->kind == SCENE_TEMPERATURE && l->elongation == 0)
LOAD(tension, l->tension != 0)
LOAD(elongation, l->elongation != 0)

static int is_fed_back(const scene_load *l)
{
    int acts = l->stations == 0;
    for (int k = 0; k < l->stations; k++)
        acts |= l->factor[k] != 0;
    return l->feedback.node != SCENE_NONE && acts && scene_load_acts(l);
}

static int has_feedback(const scene *s, int analysis, char *owner_name, int size)
{
    const scene_analysis *a = &s->analysis[analysis];
    return (!a->damped || !isnan(scene_instant_of(s, analysis))) && !a->open_loops &&
           load_that(s, analysis, is_fed_back, owner_name, size);
}

LOAD(staying, along_path_factor(l, 0) != 0)
LOAD(of_case, l->load_case != SCENE_NONE)

#define MEMBER(name, condition)                                                                    \
    static int has_##name(const scene *s, int analysis, char *owner_name, int size)                \
    {                                                                                              \
        (void)analysis;                                                                            \
        for (int i = 0; i < s->members; i++) {                                                     \
            const scene_member *m = &s->member[i];                                                 \
            if (condition)                                                                         \
                return called(s, SCENE_MEMBERS, i, owner_name, size);                              \
        }                                                                                          \
        return 0;                                                                                  \
    }
MEMBER(strain, vec3_norm(m->strain) > 0)
MEMBER(pretension, m->pretension != 0)
MEMBER(unstressed_length, m->unstressed_length != 0)
MEMBER(free_curvature, m->free_curvature[0] != 0 || m->free_curvature[1] != 0)
MEMBER(curvature, vec3_norm(m->curvature) > 0)
MEMBER(imperfection, m->bow[0] != 0 || m->bow[1] != 0)
MEMBER(taper, scene_member_tapers(m))
MEMBER(offset, scene_is_beside(m, 0) || scene_is_beside(m, 1))
MEMBER(foundation, scene_is_founded(m))
MEMBER(release, m->release[0].count + m->release[1].count > 0)
MEMBER(damping, m->damping > 0)
MEMBER(matrices, s->section[m->section].kind == SECTION_MATRICES)
MEMBER(held_warping, m->warp_p == SCENE_WARP_FIXED || m->warp_q == SCENE_WARP_FIXED)

#define NODE(name, condition)                                                                      \
    static int has_##name(const scene *s, int analysis, char *owner_name, int size)                \
    {                                                                                              \
        (void)analysis;                                                                            \
        for (int i = 0; i < s->nodes; i++) {                                                       \
            const scene_node *n = &s->node[i];                                                     \
            if (condition)                                                                         \
                return called(s, SCENE_NODES, i, owner_name, size);                                \
        }                                                                                          \
        return 0;                                                                                  \
    }
NODE(mass, n->body.mass > 0)
NODE(inertia, n->body.inertia[0] + n->body.inertia[1] + n->body.inertia[2] > 0)
NODE(tied, n->attached != SCENE_NONE)
NODE(axes, vec3_norm(n->axes[0]) > 0)
NODE(fork, n->rotation == SCENE_ROTATION_FORK)

static int has_dashpot(const scene *s, int analysis, char *owner_name, int size)
{
    (void)analysis;
    for (int i = 0; i < s->springs; i++)
        if (scene_spring_damps(&s->spring[i]))
            return called(s, SCENE_SPRINGS, i, owner_name, size);
    return 0;
}

static int has_unsymmetric_dashpot(const scene *s, int analysis, char *owner_name, int size)
{
    (void)analysis;
    for (int i = 0; i < s->springs; i++)
        if (scene_spring_gyrates(&s->spring[i]))
            return called(s, SCENE_SPRINGS, i, owner_name, size);
    return 0;
}

static int has_unsymmetric_spring(const scene *s, int analysis, char *owner_name, int size)
{
    for (int i = 0; i < s->springs && !s->analysis[analysis].damped; i++)
        if (scene_spring_circulates(&s->spring[i]))
            return called(s, SCENE_SPRINGS, i, owner_name, size);
    return 0;
}

static int has_spring(const scene *s, int analysis, char *owner_name, int size)
{
    (void)analysis;
    for (int i = 0; i < s->springs; i++)
        for (int k = 0; k < 36; k++)
            if (s->spring[i].stiffness[k] != 0)
                return called(s, SCENE_SPRINGS, i, owner_name, size);
    return 0;
}

static int has_table(const scene *s, int analysis, char *owner_name, int size)
{
    (void)analysis;
    for (int i = 0; i < s->springs; i++)
        for (int k = 0; k < 6; k++)
            if (s->spring[i].table[k].at.stations > 0)
                return called(s, SCENE_SPRINGS, i, owner_name, size);
    return 0;
}

static int has_kink(const scene *s, int analysis, char *owner_name, int size)
{
    (void)analysis;
    for (int i = 0; i < s->springs; i++)
        if (scene_spring_kink(&s->spring[i]) != SCENE_NONE)
            return called(s, SCENE_SPRINGS, i, owner_name, size);
    return 0;
}

static int has_constraint(const scene *s, int analysis, char *owner_name, int size)
{
    (void)analysis;
    return s->constraints > 0 && called(s, SCENE_CONSTRAINTS, 0, owner_name, size);
}

static int has_diaphragm(const scene *s, int analysis, char *owner_name, int size)
{
    (void)analysis;
    for (int i = 0; i < s->constraints; i++)
        if (s->constraint[i].master != SCENE_NONE)
            return called(s, SCENE_CONSTRAINTS, i, owner_name, size);
    return 0;
}

static int has_shared_warping(const scene *s, int analysis, char *owner_name, int size)
{
    (void)analysis;
    for (int i = 0; i < 2 * s->members; i++)
        for (int j = 0; j < i; j++) {
            const scene_member *a = &s->member[i / 2], *b = &s->member[j / 2];
            const int one = i % 2 ? a->warp_q : a->warp_p, other = j % 2 ? b->warp_q : b->warp_p;
            if (one >= 0 && one == other)
                return called(s, SCENE_MEMBERS, i / 2, owner_name, size);
        }
    return 0;
}

static int has_start(const scene *s, int analysis, char *owner_name, int size)
{
    (void)analysis;
    for (int i = 0; i < s->analyses; i++)
        if (s->analysis[i].kind == SCENE_MOTION) {
            const scene_start *b = &s->analysis[i].of.motion.start;
            if (vec3_norm(b->velocity) > 0 || vec3_norm(b->spin) > 0)
                return called(s, SCENE_ANALYSES, i, owner_name, size);
        }
    return 0;
}

static int has_shape(const scene *s, int analysis, int by_mode, char *owner_name, int size)
{
    for (int i = 0; i < s->imperfections && !scene_is_perfect(s, analysis); i++)
        if ((s->imperfection[i].analysis != SCENE_NONE) == by_mode)
            return called(s, SCENE_IMPERFECTIONS, i, owner_name, size);
    return 0;
}

static int has_mode(const scene *s, int analysis, char *owner_name, int size)
{
    return has_shape(s, analysis, 1, owner_name, size);
}

static int has_shifts(const scene *s, int analysis, char *owner_name, int size)
{
    return has_shape(s, analysis, 0, owner_name, size);
}

static int has_drive(const scene *s, int analysis, char *owner_name, int size)
{
    (void)analysis;
    return s->drivers > 0 && called(s, SCENE_DRIVERS, 0, owner_name, size);
}

static int has_drive_of_case(const scene *s, int analysis, char *owner_name, int size)
{
    (void)analysis;
    for (int i = 0; i < s->drivers; i++)
        if (s->driver[i].load_case != SCENE_NONE)
            return called(s, SCENE_DRIVERS, i, owner_name, size);
    return 0;
}

static int has_spin(const scene *s, int analysis, char *owner_name, int size)
{
    const int follows = s->analysis[analysis].follows;
    return scene_rotates(&s->analysis[analysis])
               ? called(s, SCENE_ANALYSES, analysis, owner_name, size)
               : follows != SCENE_NONE && has_spin(s, follows, owner_name, size);
}

static const char *const
    no_potential = "has no potential, so the tangent stiffness is not symmetric, "
                   "and flutter is possible; request the analysis about a static "
                   "path, or use a motion analysis",
    *const not_symmetric = "has no potential, so the stiffness is not symmetric; use "
                           "damped modes (damped: yes), a harmonic, a static or a "
                           "motion analysis",
    *const no_tangent = "has a different stiffness in each direction, but this analysis "
                        "requires a single stiffness at rest; use a static analysis, or "
                        "request this analysis about a static path that loads one direction",
    *const no_feedback = "acts only in motions, harmonic analyses and damped modes (damped: yes); "
                         "to switch it off in other analyses, add path: [0, 1], factor: [0, 0] to "
                         "the load; about an instant of a motion, add loops: open to the analysis",
    *const no_strains = "has stresses that the undeformed state does not have; request "
                        "the analysis about a static or a linear analysis",
    *const no_drive =
        "is prescribed, but a continuation changes only loads; remove it, or use a static analysis",
    *const no_spin = "causes Coriolis forces on moving masses, which this analysis omits; for "
                     "frequencies, use a 'rotation' analysis with the same omega";

/* The columns are:
 *   - linear; static; continuation;
 *   - buckling about the undeformed state and about a path;
 *   - modal about the undeformed state, a linear analysis, a path and an instant;
 *   - compliance about the undeformed state and about a path; rotation; motion;
 *   - harmonic about the undeformed state, a linear analysis, a path and an instant. */
const scene_input scene_inputs[] = {
    {"force", "uuuuu-uuu-uuu-uuu", NULL, has_force},
    {"follower force", "uusxu-xuu-usu-xuu", no_potential, has_following_force},
    {"force at an offset from its node", "uuusu-suu-uuu-suu", NULL, has_force_beside},
    {"moment", "uussu-suu-usu-suu", NULL, has_moment},
    {"follower moment", "uusxu-xuu-usu-xuu", no_potential, has_following_moment},
    {"load along a member", "uuuuu-uuu-uuu-uuu", NULL, has_line},
    {"follower load along a member", "uusxu-xuu-usu-xuu", no_potential, has_following_line},
    {"load along a part of a member", "uuuuu-uuu-uuu-uuu", NULL, has_part_of_line},
    {"load that varies along a member", "uuuuu-uuu-uuu-uuu", NULL, has_varying_line},
    {"lumped load along a member", "uuuuu-uuu-uuu-uuu", NULL, has_lumped_line},
    {"moments along a member", "uusxu-xuu-usu-xuu", no_potential, has_line_of_moments},
    {"force within a member", "uuuuu-uuu-uuu-uuu", NULL, has_force_within},
    {"follower force within a member", "uusxu-xuu-usu-xuu", no_potential,
     has_following_force_within},
    {"moment within a member", "uusxu-xuu-usu-xuu", no_potential, has_moment_within},
    {"gravity on members", "uuuuu-uuu-uuu-uuu", NULL, has_gravity},
    {"weight of a body", "uuuuu-uuu-uuu-uuu", NULL, has_weight},
    {"temperature", "uuuuu-uuu-uuu-uuu", NULL, has_temperature},
    {"constant load", "uuuuu-uuu-uuu-uuu", NULL, has_staying},
    {"strain of a member", "uuuuuuuuuuuuuxuuu", no_strains, has_strain},
    {"pretension", "uuuuuuuuuuuuuxuuu", no_strains, has_pretension},
    {"unstressed length", "uuuuuuuuuuuuuxuuu", no_strains, has_unstressed_length},
    {"free curvature", "uuuuuuuuuuuuuxuuu", no_strains, has_free_curvature},
    {"load with a load case", "uuuuu-uuu-uuu-uuu", NULL, has_of_case},
    {"initial curvature", "uuuuuuuuuuuuuuuuu", NULL, has_curvature},
    {"imperfection", "uuuuuuuuuuuuuuuuu", NULL, has_imperfection},
    {"imperfection given by a mode", "uuuuuuuuuuuuuuuuu", NULL, has_mode},
    {"imperfection given by shifts", "uuuuuuuuuuuuuuuuu", NULL, has_shifts},
    {"taper", "uuuuuuuuuuuuuuuuu", NULL, has_taper},
    {"section given by its matrices", "uuuuuuuuuuuuuuuuu", NULL, has_matrices},
    {"spring", "uuuuuuuuuuuuuuuuu", NULL, has_spring},
    {"unsymmetric spring", "uusxuxxuuuuxuuuuu", not_symmetric, has_unsymmetric_spring},
    {"offset of an end", "uuuuuuuuuuuuuuuuu", NULL, has_offset},
    {"foundation", "uuuuuuuuuuuuuuuuu", NULL, has_foundation},
    {"spring given by a table", "uuuuuuuuuuuuuuuuu", NULL, has_table},
    {"spring with a kink at rest", "xuuxuxxuuxuuuxxuu", no_tangent, has_kink},
    {"release", "uuuuuuuuuuuuuuuuu", NULL, has_release},
    {"warping held", "uuuuuuuuuuuuuuuuu", NULL, has_held_warping},
    {"warping shared", "uuuuuuuuuuuuuuuuu", NULL, has_shared_warping},
    {"node attached to another", "uuuuuuuuuuuuuuuuu", NULL, has_tied},
    {"supports along rotated axes", "uuuuuuuuuuuuuuuuu", NULL, has_axes},
    {"constraint", "uuuuuuuuuuuuuuuuu", NULL, has_constraint},
    {"diaphragm", "uuuuuuuuuuuuuuuuu", NULL, has_diaphragm},
    {"fork", "uuuuuuuuuuuuuuuuu", NULL, has_fork},
    {"mass of a node", "-ii-iuuuu-iuuuuuu", NULL, has_mass},
    {"inertia of a node", "-ii-iuuuu-iuuuuuu", NULL, has_inertia},
    {"motion with a load case", "uuxuu-uuu-uuu-uuu", no_drive, has_drive_of_case},
    {"motion of a node", "uuxuu-uuu-uuu-uuu", no_drive, has_drive},
    {"initial velocity", "--------u---u---u", NULL, has_start},
    {"rotating axes", "-uu-u--xu-uuu--uu", no_spin, has_spin},
    {"damping", "----i--iu---uuuuu", NULL, has_damping},
    {"dashpot", "----i--iu---uuuuu", NULL, has_dashpot},
    {"unsymmetric dashpot", "----i--iu---uuuuu", NULL, has_unsymmetric_dashpot},
    {"elongation", "uuuuu-uuu-uuu-uuu", NULL, has_elongation},
    {"tension between nodes", "uuusu-suu-uuu-suu", NULL, has_tension},
    {"feedback", "xxxxxxxxxxxxuuuux", no_feedback, has_feedback},
    {NULL, "", NULL, NULL}};

scene_column scene_column_of(const scene *s, int analysis)
{
    const scene_analysis *a = &s->analysis[analysis];
    switch (a->kind) {
    case SCENE_LINEAR:
        return SCENE_OF_LINEAR;
    case SCENE_STATIC:
        return SCENE_OF_STATIC;
    case SCENE_CONTINUATION:
        return SCENE_OF_CONTINUATION;
    case SCENE_BUCKLING:
        return a->follows == SCENE_NONE ? SCENE_OF_BUCKLING : SCENE_OF_BUCKLING_ABOUT;
    case SCENE_HARMONIC:
        return a->follows == SCENE_NONE                       ? SCENE_OF_HARMONIC
               : s->analysis[a->follows].kind == SCENE_LINEAR ? SCENE_OF_HARMONIC_LINEAR
               : s->analysis[a->follows].kind == SCENE_MOTION ? SCENE_OF_HARMONIC_INSTANT
                                                              : SCENE_OF_HARMONIC_ABOUT;
    case SCENE_MODAL:
        return a->follows == SCENE_NONE                       ? SCENE_OF_MODAL
               : s->analysis[a->follows].kind == SCENE_LINEAR ? SCENE_OF_MODAL_LINEAR
               : s->analysis[a->follows].kind == SCENE_MOTION ? SCENE_OF_MODAL_INSTANT
                                                              : SCENE_OF_MODAL_ABOUT;
    case SCENE_COMPLIANCE:
        return a->follows == SCENE_NONE ? SCENE_OF_COMPLIANCE : SCENE_OF_COMPLIANCE_ABOUT;
    case SCENE_ROTATION:
        return SCENE_OF_ROTATION;
    case SCENE_MOTION:
        break;
    }
    return SCENE_OF_MOTION;
}

int scene_inputs_flutter(const scene *s, int analysis)
{
    if (s->analysis[analysis].follows == SCENE_NONE)
        return 0;
    for (int i = 0; i < s->loads; i++)
        if (s->load[i].load_case != SCENE_NONE && scene_load_unsymmetric(&s->load[i]))
            return 1;
    for (const scene_input *i = scene_inputs; i->name != NULL; i++)
        if ((i->part[SCENE_OF_BUCKLING] == SCENE_PART_STATE ||
             i->part[SCENE_OF_BUCKLING] == SCENE_PART_REFUSED) &&
            i->stands(s, analysis, NULL, 0))
            return 1;
    return 0;
}

static status check_unknown(const scene *s, int analysis, scene_column column, fault *f)
{
    for (int d = 0; d < s->drivers; d++)
        if (s->driver[d].value == NULL && s->driver[d].function.pieces == 0 &&
            (column == SCENE_OF_LINEAR || column == SCENE_OF_BUCKLING))
            return fault_set(f, STATUS_REFUSED,
                             "%s (%s) and motion %s: the value of the motion is unknown, and only "
                             "a static path determines such a value; use a static analysis",
                             scene_called(s, SCENE_ANALYSES, analysis).text,
                             scene_column_name[column], s->driver[d].name);
    return STATUS_OK;
}

status scene_inputs_check(const scene *s, int analysis, fault *f)
{
    const scene_column column = scene_column_of(s, analysis);
    char owner_name[SCENE_NAME + 32];
    TRY(check_unknown(s, analysis, column, f));
    for (const scene_input *i = scene_inputs; i->name != NULL; i++)
        if (i->part[column] == SCENE_PART_REFUSED &&
            i->stands(s, analysis, owner_name, sizeof owner_name))
            return fault_set(f, STATUS_REFUSED, "%s (%s): %s (%s) %s",
                             scene_called(s, SCENE_ANALYSES, analysis).text,
                             scene_column_name[column], owner_name, i->name, i->why);
    return STATUS_OK;
}
