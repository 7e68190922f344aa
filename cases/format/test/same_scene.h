/* Compares two scenes bit for bit. */
#ifndef BEAMWORK_TEST_SAME_SCENE_H
#define BEAMWORK_TEST_SAME_SCENE_H

#include <string.h>

#include "cases/scene/scene.h"

static inline int same_numbers(int n, const double a[], const double b[])
{
    return (a == NULL) == (b == NULL) && (a == NULL || memcmp(a, b, (size_t)n * sizeof *a) == 0);
}

static inline int same_section(const section_spec *a, const section_spec *b)
{
    section x, y;
    int same = a->kind == b->kind && a->points == b->points && a->walls == b->walls &&
               (a->kind == SECTION_MATRICES || entry_same(entry_section, a, b));
    for (int i = 0; same && i < a->points; i++)
        same = same_numbers(2, a->point[i], b->point[i]);
    for (int i = 0; same && i < a->walls; i++)
        same = a->wall[i].from == b->wall[i].from && a->wall[i].to == b->wall[i].to &&
               same_numbers(1, &a->wall[i].thickness, &b->wall[i].thickness);
    return same && section_compute(a, &x, NULL) == section_compute(b, &y, NULL) &&
           memcmp(&x, &y, sizeof x) == 0;
}

static inline int same_node(const scene_node *a, const scene_node *b)
{
    return entry_same(entry_node, a, b) &&
           memcmp(a->translation, b->translation, sizeof a->translation) == 0 &&
           a->rotation == b->rotation && memcmp(a->angle, b->angle, sizeof a->angle) == 0 &&
           (a->rotation == SCENE_ROTATION_SPATIAL || a->rotation == SCENE_ROTATION_VECTOR ||
            same_numbers(9, a->axis[0], b->axis[0]));
}

/* Returns 1 if the same ends of members share a warping coordinate in both scenes. The names of the
 * coordinates may differ. */
static inline int same_sharing(const scene *a, const scene *b)
{
    for (int i = 0; i < 2 * a->members; i++)
        for (int k = 0; k < i; k++) {
            const scene_member *p = &a->member[i / 2], *q = &a->member[k / 2],
                               *r = &b->member[i / 2], *s = &b->member[k / 2];
            const int one = (i % 2 ? p->warp_q : p->warp_p) == (k % 2 ? q->warp_q : q->warp_p);
            const int two = (i % 2 ? r->warp_q : r->warp_p) == (k % 2 ? s->warp_q : s->warp_p);
            if (one != two)
                return 0;
        }
    return 1;
}

static inline int same_warp(int a, int b)
{
    return a >= 0 ? b >= 0 : a == b;
}

static inline int same_release(const scene_release *a, const scene_release *b)
{
    return a->count == b->count && memcmp(a->component, b->component, sizeof a->component) == 0;
}

static inline int same_member(const scene_member *a, const scene_member *b)
{
    return entry_same(entry_member, a, b) && a->section == b->section &&
           a->section_q == b->section_q && same_warp(a->warp_p, b->warp_p) &&
           same_warp(a->warp_q, b->warp_q) && same_release(&a->release[0], &b->release[0]) &&
           same_release(&a->release[1], &b->release[1]);
}

static inline int same_spring(const scene_spring *a, const scene_spring *b)
{
    return entry_same(entry_spring, a, b) && same_numbers(36, a->stiffness, b->stiffness) &&
           same_numbers(36, a->damping, b->damping);
}

static inline int same_constraint(const scene_constraint *a, const scene_constraint *b)
{
    return a->nodes == b->nodes && a->components == b->components && a->master == b->master &&
           a->normal == b->normal &&
           memcmp(a->node, b->node, (size_t)a->nodes * sizeof *a->node) == 0 &&
           same_numbers(1, &a->ratio, &b->ratio);
}

static inline int same_imperfection(const scene_imperfection *a, const scene_imperfection *b)
{
    return entry_same(entry_imperfection, a, b) && a->nodes == b->nodes &&
           memcmp(a->node, b->node, (size_t)a->nodes * sizeof *a->node) == 0 &&
           same_numbers(3 * a->nodes, (const double *)a->shift, (const double *)b->shift);
}

static inline int same_function(const scene_function *a, const scene_function *b)
{
    if (a->pieces != b->pieces)
        return 0;
    for (int i = 0; i < a->pieces; i++)
        if (strcmp(a->piece[i].text, b->piece[i].text) != 0 ||
            (i + 1 < a->pieces && !same_numbers(1, &a->piece[i].until, &b->piece[i].until)))
            return 0;
    return 1;
}

static inline int same_driver(const scene_driver *a, const scene_driver *b)
{
    return a->stations == b->stations && same_numbers(a->stations, a->path, b->path) &&
           same_numbers(a->stations, a->value, b->value) && entry_same(entry_driver, a, b) &&
           same_function(&a->function, &b->function);
}

static inline int same_load(const scene_load *a, const scene_load *b)
{
    return a->kind == b->kind && a->where == b->where && same_numbers(3, a->vector, b->vector) &&
           same_numbers(3, a->last, b->last) && a->varies == b->varies &&
           same_numbers(2, a->range, b->range) && entry_same(entry_load, a, b) &&
           a->stations == b->stations && same_numbers(a->stations, a->path, b->path) &&
           same_numbers(a->stations, a->factor, b->factor) &&
           same_function(&a->function, &b->function);
}

static inline int same_analysis(const scene_analysis *a, const scene_analysis *b)
{
    if (!entry_same(entry_analysis, a, b))
        return 0;
    if (a->kind == SCENE_CONTINUATION)
        return same_numbers(1, &scene_continuation_of(a)->control.step_max,
                            &scene_continuation_of(b)->control.step_max);
    return a->kind != SCENE_MOTION ||
           (scene_motion_of(a)->scheme == scene_motion_of(b)->scheme &&
            same_numbers(1, &scene_motion_of(a)->alpha.mass, &scene_motion_of(b)->alpha.mass) &&
            same_numbers(1, &scene_motion_of(a)->alpha.force, &scene_motion_of(b)->alpha.force));
}

static inline int same_combination(const scene_combination *a, const scene_combination *b)
{
    int same = a->terms == b->terms;
    for (int i = 0; same && i < a->terms; i++)
        same = a->term[i].load_case == b->term[i].load_case &&
               same_numbers(1, &a->term[i].factor, &b->term[i].factor);
    return same;
}

static inline int same_overs(const scene_quantity *a, const scene_quantity *b)
{
    int same = a->overs == b->overs;
    for (int i = 0; same && i < a->overs; i++)
        same = a->over[i] == b->over[i];
    return same;
}

static inline int same_quantity(const scene_quantity *a, const scene_quantity *b)
{
    const double x[] = {a->at, a->x.factor, a->x.offset, a->prediction.value},
                 y[] = {b->at, b->x.factor, b->x.offset, b->prediction.value};
    const char *one = a->prediction.source, *two = b->prediction.source;
    return entry_same(entry_quantity, a, b) && same_overs(a, b) && strcmp(a->name, b->name) == 0 &&
           strcmp(a->unit, b->unit) == 0 && a->reduction == b->reduction &&
           a->transform == b->transform && strcmp(a->x.name, b->x.name) == 0 &&
           strcmp(a->x.unit, b->x.unit) == 0 && same_numbers(4, x, y) &&
           (one == NULL) == (two == NULL) && (one == NULL || strcmp(one, two) == 0);
}

/* Returns the name of the first list that differs, and sets *index to its first entry that differs.
 * Returns NULL if the scenes are equal. */
static inline const char *differing(const scene *a, const scene *b, int *index)
{
    *index = 0;
    if (a->sections != b->sections || a->nodes != b->nodes || a->members != b->members ||
        a->springs != b->springs || a->drivers != b->drivers || a->loads != b->loads ||
        a->analyses != b->analyses || a->quantities != b->quantities || a->cases != b->cases ||
        a->combinations != b->combinations || a->constraints != b->constraints ||
        a->imperfections != b->imperfections)
        return "counts";
#define EACH(list, count, same)                                                                    \
    for (*index = 0; *index < a->count; (*index)++)                                                \
        if (!same(&a->list[*index], &b->list[*index]))                                             \
            return #list;
    EACH(section, sections, same_section)
    EACH(node, nodes, same_node)
    EACH(member, members, same_member)
    EACH(spring, springs, same_spring)
    EACH(constraint, constraints, same_constraint)
    EACH(imperfection, imperfections, same_imperfection)
    EACH(driver, drivers, same_driver)
    EACH(load, loads, same_load)
    EACH(combination, combinations, same_combination)
    EACH(analysis, analyses, same_analysis)
    EACH(quantity, quantities, same_quantity)
#undef EACH
    if (!same_sharing(a, b))
        return "sharing";
    if (a->plane != b->plane || a->omits != b->omits || a->shear_theory != b->shear_theory ||
        a->lumped != b->lumped || a->meshes != b->meshes ||
        memcmp(a->mesh, b->mesh, (size_t)a->meshes * sizeof *a->mesh) != 0)
        return "plane, omits, theory of shear or meshes";
    return NULL;
}

#endif
