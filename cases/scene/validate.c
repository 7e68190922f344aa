#include "cases/scene/scene_impl.h"

#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/section/section.h"

static status check_taper(const scene *s, int i, fault *f)
{
    const int at[2] = {s->member[i].section, s->member[i].section_q};
    section c[2];
    fault why = {""};
    for (int k = 0; k < 2; k++)
        if (scene_constants(s, at[k], &c[k], NULL) != STATUS_OK)
            return STATUS_OK; /* model_alloc reports the error */
    const section *const ends[2] = {&c[0], &c[1]};
    if (section_taper_check(&s->section[at[0]], &s->section[at[1]], ends, &why) != STATUS_OK)
        return fault_set(f, STATUS_REFUSED, "%s: %s", scene_called(s, SCENE_MEMBERS, i).text,
                         why.text);
    return STATUS_OK;
}

static status check_member(const scene *s, int i, fault *f)
{
    const scene_member *m = &s->member[i];
    if (m->section < 0 || m->section >= s->sections || m->section_q < 0 ||
        m->section_q >= s->sections)
        return fault_set(f, STATUS_REFUSED, "%s: the section does not exist; add the section first",
                         scene_called(s, SCENE_MEMBERS, i).text);
    double d[3], length = 0, along = 0, across = 0;
    scene_chord(s, i, d);
    for (int k = 0; k < 3; k++) {
        length += d[k] * d[k];
        along += d[k] * m->y_axis[k];
        across += m->y_axis[k] * m->y_axis[k];
    }
    if (!(length > 0))
        return fault_set(f, STATUS_REFUSED,
                         "%s: its ends coincide; move one of its nodes, or remove the member",
                         scene_called(s, SCENE_MEMBERS, i).text);
    if (!(across > 0) || !(across * length - along * along > 1e-12 * across * length))
        return fault_set(f, STATUS_REFUSED,
                         "%s: its y axis is zero or parallel to the member; give another direction",
                         scene_called(s, SCENE_MEMBERS, i).text);
    if (scene_member_tapers(m))
        TRY(check_taper(s, i, f));
    if (m->pretension != 0 && scene_constants(s, m->section, &(section){0}, NULL) == STATUS_OK)
        TRY(scene_member_elongation(s, i, sqrt(length), &d[0], f));
    return scene_validate_release(s, i, f);
}

/* Returns 1 if the matrix is symmetric and positive semidefinite, so that elimination has no
 * negative pivot. */
static int is_stiffness(const double K[36])
{
    double A[36], largest[6];
    memcpy(A, K, sizeof A);
    for (int i = 0; i < 6; i++) {
        largest[i] = A[7 * i];
        for (int j = 0; j < 6; j++)
            if (!isfinite(A[6 * i + j]) || A[6 * i + j] != A[6 * j + i])
                return 0;
    }
    for (int k = 0; k < 6; k++) {
        const double pivot = A[7 * k];
        if (!(pivot >= -1e-9 * largest[k]) || largest[k] < 0)
            return 0;
        for (int i = k + 1; i < 6; i++) {
            if (pivot <= 1e-9 * largest[k]) {
                if (fabs(A[6 * k + i]) > 1e-8 * sqrt(largest[k] * largest[i]))
                    return 0;
                continue;
            }
            const double part = A[6 * i + k] / pivot;
            for (int j = k + 1; j < 6; j++)
                A[6 * i + j] -= part * A[6 * k + j];
        }
    }
    return 1;
}

/* Checks that the points of a spring table ascend, that its values do not decrease, and that the
 * value at 0 is 0. Returns an error message or NULL. */
static const char *table_mistake(const scene_table *t)
{
    const int n = t->at.stations;
    double slope;
    if (n == 0 && t->value.stations == 0)
        return NULL;
    if (n < 2 || t->value.stations != n)
        return "give two or more points, each with 'at' and 'value'";
    for (int i = 0; i < n; i++)
        if (!isfinite(t->at.value[i]) || !isfinite(t->value.value[i]) ||
            (i > 0 && !(t->at.value[i] > t->at.value[i - 1])))
            return "'at' does not ascend, or a number is not finite; give finite numbers, "
                   "ascending in "
                   "'at'";
    for (int i = 1; i < n; i++)
        if (!(t->value.value[i] >= t->value.value[i - 1]))
            return "the values of 'value' decrease, which is unstable; give values that do not "
                   "decrease";
    double most = fmax(fabs(t->value.value[0]), fabs(t->value.value[n - 1]));
    return fabs(scene_table_at(t, 0, &slope)) <= 1e-12 * most
               ? NULL
               : "the value at 0 is not 0, but a spring has no force at rest; give a table whose "
                 "value at 0 is 0";
}

static status check_spring(const scene *s, int i, fault *f)
{
    const scene_spring *p = &s->spring[i];
    if (p->p == p->q)
        return fault_set(f, STATUS_REFUSED,
                         "%s: both ends are at %s; connect two nodes, or one node and the ground",
                         scene_called(s, SCENE_SPRINGS, i).text,
                         scene_called(s, SCENE_NODES, p->q).text);
    for (int k = 0; k < 6; k++) {
        static const char *const component[] = {"ux", "uy", "uz", "rx", "ry", "rz"};
        const char *mistake = table_mistake(&p->table[k]);
        if (mistake != NULL)
            return fault_set(f, STATUS_REFUSED, "%s: its table of %s: %s",
                             scene_called(s, SCENE_SPRINGS, i).text, component[k], mistake);
    }
    double damping[36];
    int finite = 1;
    for (int k = 0; k < 36; k++) {
        finite &= isfinite(p->stiffness[k]) != 0;
        damping[k] = p->damping[k] / 2 + p->damping[k / 6 + 6 * (k % 6)] / 2;
    }
    if (!finite || (!scene_spring_circulates(p) && !is_stiffness(p->stiffness)))
        return fault_set(f, STATUS_REFUSED,
                         "%s: its stiffness would supply energy; give six non-negative numbers, a "
                         "symmetric matrix without negative eigenvalues, or the 36 entries of a "
                         "bearing, whose cross terms differ",
                         scene_called(s, SCENE_SPRINGS, i).text);
    if (!is_stiffness(damping))
        return fault_set(f, STATUS_REFUSED,
                         "%s: its damping would supply energy to a motion; give six non-negative "
                         "numbers, or a matrix whose symmetric part has no negative eigenvalues",
                         scene_called(s, SCENE_SPRINGS, i).text);
    return STATUS_OK;
}

static int is_used(const scene *s, int driver)
{
    for (int i = 0; i < s->nodes; i++)
        for (int k = 0; k < 3; k++)
            if (s->node[i].translation[k] == driver || s->node[i].angle[k] == driver)
                return 1;
    for (int i = 0; i < s->drivers; i++)
        if (s->driver[i].condition_driver == driver)
            return 1;
    return 0;
}

/* Returns 1 if the coordinate of the condition is prescribed by the driver of the condition. */
static int is_conditioned(const scene *s, const scene_driver *d)
{
    const scene_node *n = &s->node[d->condition_node];
    const int k = d->condition_component;
    return k >= 0 && k < 6 &&
           (k < SCENE_RX ? n->translation[k] : n->angle[k - SCENE_RX]) == d->condition_driver;
}

static status check_driver(const scene *s, int i, fault *f)
{
    const scene_driver *d = &s->driver[i];
    if (!is_used(s, i))
        return fault_set(
            f, STATUS_REFUSED,
            "motion %s prescribes no coordinate; name it in 'drive' of a node, or remove it",
            d->name);
    if (d->value == NULL) {
        const int known = d->condition_driver >= 0 && d->condition_driver < s->drivers &&
                          s->driver[d->condition_driver].value != NULL;
        if (!known || d->condition_node == SCENE_NONE)
            return fault_set(f, STATUS_REFUSED,
                             "motion %s: it has neither values nor a condition that determines "
                             "them; give values, or such_that: {node: NODE, component: ux, motion: "
                             "MOTION} with a motion of known values",
                             d->name);
        if (!is_conditioned(s, d))
            return fault_set(
                f, STATUS_REFUSED,
                "motion %s: the coordinate in its condition is not prescribed by %s at "
                "%s; prescribe it there as well",
                d->name, s->driver[d->condition_driver].name,
                scene_called(s, SCENE_NODES, d->condition_node).text);
        return STATUS_OK;
    }
    for (int k = 0; k < d->stations; k++) {
        if (!isfinite(d->value[k]) || !isfinite(d->path[k]))
            return fault_set(f, STATUS_REFUSED,
                             "motion %s: value %d is NaN or Inf; give finite values", d->name, k);
        if (k > 0 && !(d->path[k] > d->path[k - 1]))
            return fault_set(
                f, STATUS_REFUSED,
                "motion %s: its path parameters must ascend; sort them and remove repetitions",
                d->name);
    }
    return STATUS_OK;
}

static status check_range(const scene *s, int i, fault *f)
{
    const scene_load *load = &s->load[i];
    const int spread = scene_load_along(load) && load->kind != SCENE_GRAVITY,
              within = scene_load_within(load);
    const double *r = load->range;
    if (load->varies && (!spread || within))
        return fault_set(f, STATUS_REFUSED,
                         "%s: only a distributed load can vary along its member; remove 'to_value'",
                         scene_called(s, SCENE_LOADS, i).text);
    if (load->lumped && (!scene_load_along(load) || within))
        return fault_set(
            f, STATUS_REFUSED,
            "%s: the load acts at one position, but only distributed loads, and gravity "
            "on members, can be lumped; remove 'lumped'",
            scene_called(s, SCENE_LOADS, i).text);
    if (within)
        return r[0] >= 0 && r[0] <= 1 && r[1] == r[0]
                   ? STATUS_OK
                   : fault_set(f, STATUS_REFUSED,
                               "%s: its position is the fraction %g of the member's length; give a "
                               "fraction from 0 to 1",
                               scene_called(s, SCENE_LOADS, i).text, r[0]);
    if (spread)
        return r[0] >= 0 && r[0] < r[1] && r[1] <= 1
                   ? STATUS_OK
                   : fault_set(f, STATUS_REFUSED,
                               "%s: the load acts from %g to %g of the member's length; give "
                               "two increasing fractions from 0 to 1",
                               scene_called(s, SCENE_LOADS, i).text, r[0], r[1]);
    if (r[0] != 0 || r[1] != (load->kind == SCENE_GRAVITY))
        return fault_set(
            f, STATUS_REFUSED,
            "%s: 'from' and 'to' select a part of a member, but the load is %s; remove both keys",
            scene_called(s, SCENE_LOADS, i).text,
            load->kind == SCENE_GRAVITY ? "the weight of a whole member" : "at a node");
    return STATUS_OK;
}

/* A temperature has no direction, and no position except its range. */
static status check_temperature(const scene *s, int i, fault *f)
{
    const scene_load *load = &s->load[i];
    const scene_member *m = &s->member[load->where];
    const int profile[2] = {m->section, m->section_q};
    const double gradient[3] = {load->gradient[0], load->gradient[1], 0};
    int expands = load->temperature == 0 && vec3_norm(gradient) == 0;
    section c;
    if (load->lumped || load->follower || load->axes != SCENE_AXES_FIXED ||
        vec3_norm(load->at) > 0 || load->varies)
        return fault_set(f, STATUS_REFUSED,
                         "%s: %s acts on the sections of its member; remove 'to_value', 'lumped', "
                         "'at', 'axes' and 'follower'",
                         scene_called(s, SCENE_LOADS, i).text, scene_heat_word(load));
    if (load->elongation != 0 && (load->temperature != 0 || vec3_norm(gradient) > 0))
        return fault_set(f, STATUS_REFUSED,
                         "%s: an elongation has no temperature and no gradient; give the "
                         "temperature in a second load",
                         scene_called(s, SCENE_LOADS, i).text);
    if (!isfinite(load->temperature) || !isfinite(load->gradient[0]) ||
        !isfinite(load->gradient[1]))
        return fault_set(f, STATUS_REFUSED,
                         "%s: a temperature is NaN or Inf; give finite temperatures",
                         scene_called(s, SCENE_LOADS, i).text);
    for (int k = 0; k < 2; k++)
        expands |= scene_constants(s, profile[k], &c, NULL) != STATUS_OK || c.expansion != 0;
    if (!expands)
        return fault_set(
            f, STATUS_REFUSED,
            "%s: a temperature acts on %s, whose section has no expansion; give 'expansion' [1/K]",
            scene_called(s, SCENE_LOADS, i).text, scene_called(s, SCENE_MEMBERS, load->where).text);
    return STATUS_OK;
}

static status check_load_kind(const scene *s, int i, fault *f)
{
    const scene_load *load = &s->load[i];
    section c;
    if (load->kind == SCENE_TEMPERATURE)
        return check_temperature(s, i, f);
    if (load->elongation != 0 || load->temperature != 0 || load->gradient[0] != 0 ||
        load->gradient[1] != 0)
        return fault_set(f, STATUS_REFUSED, "%s: a %s has no temperature or gradient; remove them",
                         scene_called(s, SCENE_LOADS, i).text, entry_of_load(load->kind)->name);
    if (vec3_norm(load->at) > 0 &&
        (scene_load_turns(load) || load->kind == SCENE_GRAVITY || load->kind == SCENE_WEIGHT))
        return fault_set(f, STATUS_REFUSED,
                         "%s: only forces act at an offset; the position of a moment has no "
                         "effect, and gravity acts at the centres of mass; remove 'at'",
                         scene_called(s, SCENE_LOADS, i).text);
    if (load->axes == SCENE_AXES_MEMBER && !scene_load_along(load))
        return fault_set(f, STATUS_REFUSED,
                         "%s: the load is given in a member's axes but acts on a node; "
                         "write axes: fixed, or apply the load to a member",
                         scene_called(s, SCENE_LOADS, i).text);
    if (load->kind != SCENE_GRAVITY && load->kind != SCENE_WEIGHT)
        return STATUS_OK;
    if (load->axes != SCENE_AXES_FIXED || load->follower)
        return fault_set(f, STATUS_REFUSED,
                         "%s: gravity has fixed axes; remove 'axes' and 'follower'",
                         scene_called(s, SCENE_LOADS, i).text);
    if (load->kind == SCENE_WEIGHT)
        return s->node[load->where].body.mass > 0
                   ? STATUS_OK
                   : fault_set(f, STATUS_REFUSED,
                               "%s: gravity acts on %s, which has no mass; give it a mass",
                               scene_called(s, SCENE_LOADS, i).text,
                               scene_called(s, SCENE_NODES, load->where).text);
    const int profile[2] = {s->member[load->where].section, s->member[load->where].section_q};
    for (int k = 0; k < 2; k++)
        if (scene_constants(s, profile[k], &c, NULL) == STATUS_OK && !(c.density > 0))
            return fault_set(
                f, STATUS_REFUSED,
                "%s: gravity acts on %s, whose section has no density; give it a density",
                scene_called(s, SCENE_LOADS, i).text,
                scene_called(s, SCENE_MEMBERS, load->where).text);
    return STATUS_OK;
}

static status check_feedback(const scene *s, int i, fault *f)
{
    const scene_load *load = &s->load[i];
    const scene_feedback *b = &load->feedback;
    const scene_words owner_name = scene_called(s, SCENE_LOADS, i);
    if (b->node == SCENE_NONE)
        return STATUS_OK;
    if (load->kind != SCENE_FORCE && load->kind != SCENE_MOMENT)
        return fault_set(f, STATUS_REFUSED,
                         "%s: feedback is supported only for a force or a moment at a node; add a "
                         "node where the load acts",
                         owner_name.text);
    if (b->proportional == 0 && b->derivative == 0 && b->integral == 0)
        return fault_set(f, STATUS_REFUSED,
                         "%s: the feedback has no gain; give proportional, derivative or integral",
                         owner_name.text);
    return b->from != b->node
               ? STATUS_OK
               : fault_set(f, STATUS_REFUSED,
                           "%s: the component of %s minus itself is always 0; name "
                           "another node in 'from', or remove 'from'",
                           owner_name.text, scene_called(s, SCENE_NODES, b->node).text);
}

static status check_tension(const scene *s, int i, fault *f)
{
    const scene_load *load = &s->load[i];
    const scene_words owner_name = scene_called(s, SCENE_LOADS, i);
    double apart[3];
    if (load->towards == SCENE_NONE)
        return load->tension == 0
                   ? STATUS_OK
                   : fault_set(
                         f, STATUS_REFUSED,
                         "%s: a tension acts between two nodes; name the second one with 'towards'",
                         owner_name.text);
    if (load->kind != SCENE_FORCE || vec3_norm(load->vector) > 0 || load->follower ||
        vec3_norm(load->at) > 0)
        return fault_set(f, STATUS_REFUSED,
                         "%s: 'towards' applies only to a tension, and a tension has no vector, "
                         "'where', 'at' or 'follower'; remove the keys that do not apply",
                         owner_name.text);
    for (int k = 0; k < 3; k++)
        apart[k] = s->node[load->towards].position[k] - s->node[load->where].position[k];
    return vec3_norm(apart) > 0
               ? STATUS_OK
               : fault_set(f, STATUS_REFUSED,
                           "%s: both nodes have the same position, so the tension has no "
                           "direction; move one of them",
                           owner_name.text);
}

static status check_load(const scene *s, int i, fault *f)
{
    const scene_load *load = &s->load[i];
    const int limit = scene_load_along(load) ? s->members : s->nodes;
    if (load->where < 0 || load->where >= limit)
        return fault_set(f, STATUS_REFUSED,
                         "%s: the node or member of this load does not exist; add it first",
                         scene_called(s, SCENE_LOADS, i).text);
    for (int k = 0; k < 3; k++)
        if (!isfinite(load->vector[k]) || !isfinite(load->last[k]))
            return fault_set(f, STATUS_REFUSED,
                             "%s: a component is NaN or Inf; give three finite components",
                             scene_called(s, SCENE_LOADS, i).text);
    TRY(check_range(s, i, f));
    TRY(check_feedback(s, i, f));
    TRY(check_tension(s, i, f));
    TRY(check_load_kind(s, i, f));
    return scene_validate_carried(s, i, f);
}

static status check_numbers(const scene *s, fault *f)
{
    const struct {
        scene_list list;
        size_t size;
        const entry_field *table;
        const void *first;
    } all[] = {{SCENE_SECTIONS, sizeof *s->section, entry_section, s->section},
               {SCENE_NODES, sizeof *s->node, entry_node, s->node},
               {SCENE_MEMBERS, sizeof *s->member, entry_member, s->member},
               {SCENE_SPRINGS, sizeof *s->spring, entry_spring, s->spring},
               {SCENE_IMPERFECTIONS, sizeof *s->imperfection, entry_imperfection, s->imperfection},
               {SCENE_DRIVERS, sizeof *s->driver, entry_driver, s->driver},
               {SCENE_LOADS, sizeof *s->load, entry_load, s->load},
               {SCENE_ANALYSES, sizeof *s->analysis, entry_analysis, s->analysis},
               {SCENE_QUANTITIES, sizeof *s->quantity, entry_quantity, s->quantity}};
    fault why = {""};
    for (size_t k = 0; k < sizeof all / sizeof all[0]; k++)
        for (int i = 0; i < scene_count(s, all[k].list); i++)
            if (entry_check(s, all[k].table, (const char *)all[k].first + (size_t)i * all[k].size,
                            &why) != STATUS_OK)
                return fault_set(f, STATUS_REFUSED, "%s: %s", scene_called(s, all[k].list, i).text,
                                 why.text);
    return STATUS_OK;
}

status scene_validate(const scene *s, fault *f)
{
    static status (*const check[])(const scene *, int, fault *) = {
        scene_validate_node,     check_member,           check_spring,
        scene_validate_turns,    check_driver,           check_load,
        scene_validate_analysis, scene_validate_quantity};
    const int count[] = {s->nodes,   s->members, s->springs,  s->nodes,
                         s->drivers, s->loads,   s->analyses, s->quantities};
    if (s->out_of_memory)
        return fault_set(f, STATUS_FAULT, "%s: out of memory while the scene was built", s->name);
    TRY(check_numbers(s, f));
    TRY(scene_validate_functions(s, f));
    TRY(scene_validate_cases(s, f));
    for (size_t k = 0; k < sizeof count / sizeof count[0]; k++)
        for (int i = 0; i < count[k]; i++) {
            TRY(check[k](s, i, f));
        }
    TRY(scene_validate_plane(s, f));
    TRY(scene_validate_imperfections(s, f));
    return scene_validate_constraints(s, f);
}
