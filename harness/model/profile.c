#include "harness/model/profile.h"
#include "cases/scene/names.h"

#include <stdlib.h>
#include <string.h>

#include "elements/section/taper.h"
#include "harness/model/missing.h"
#include "harness/model/model_impl.h"

/* A change from one section of the scene to another in so many steps, from m->section[first] on. */
typedef struct taper {
    int p, q, steps, even, first; /* even: of one length */
} taper;

status profile_scene(model *m, fault *f)
{
    const scene *s = m->scene;
    m->section = calloc((size_t)(s->sections > 0 ? s->sections : 1), sizeof *m->section);
    if (m->section == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for sections");
    for (int i = 0; i < s->sections; i++) {
        TRY(scene_constants(s, i, &m->section[i], f));
        missing_omit(&m->section[i], m->omits);
    }
    return STATUS_OK;
}

int profile_at(const model *m, int member, int number)
{
    const scene_member *sm = &m->scene->member[member];
    return m->profile[member] + (scene_member_tapers(sm) ? number : 0);
}

/* What the ends do not show, no formulation was asked for. */
static status check_between(const model *m, int member, const section *c, fault *f)
{
    const scene_member *sm = &m->scene->member[member];
    const section *p = &m->section[sm->section], *q = &m->section[sm->section_q];
    const int cells = m->scene->section[sm->section].cells;
    const char *limit =
        missing_in_section(m->mesh.type, c, cells, (m->features & FEATURE_WARPING) != 0);
    if ((c->Iw > 0) != (p->Iw > 0 || q->Iw > 0))
        limit = "warping in a part of a member only";
    else if (features_eccentric(c) && !features_eccentric(p) && !features_eccentric(q))
        limit = "a shear centre that leaves the centroid between the ends only";
    if (limit == NULL)
        return STATUS_OK;
    return fault_set(f, STATUS_REFUSED,
                     "%s: its section has between its ends what they have not: %s; put a node with "
                     "a section of its own there",
                     scene_called(m->scene, SCENE_MEMBERS, member).text, limit);
}

static status fill(model *m, int member, const taper *t, fault *f)
{
    const scene *s = m->scene;
    for (int i = 0; i < t->steps; i++) {
        section_spec spec;
        fault why = {""};
        section *c = &m->section[t->first + i];
        section_taper_at(&s->section[t->p], &s->section[t->q],
                         division_place(&m->division, member, i, 0.5), &spec);
        if (section_compute(&spec, c, &why) != STATUS_OK)
            return fault_set(f, STATUS_REFUSED, "%s, between its ends: %s",
                             scene_called(m->scene, SCENE_MEMBERS, member).text, why.text);
        missing_omit(c, m->omits);
        TRY(check_between(m, member, c, f));
    }
    return STATUS_OK;
}

/* Index of the taper of a member in the list; behind its end where it is new. */
static int find(int tapers, const taper *list, const taper *t)
{
    for (int i = 0; i < tapers; i++)
        if (list[i].p == t->p && list[i].q == t->q && list[i].steps == t->steps && list[i].even &&
            t->even)
            return i;
    return tapers;
}

static int list_tapers(model *m, taper *list, int *member, int *sections)
{
    const scene *s = m->scene;
    int tapers = 0;
    for (int i = 0; i < s->members; i++) {
        const scene_member *sm = &s->member[i];
        taper t = {sm->section, sm->section_q, division_elements(&m->division, i),
                   division_pieces(&m->division, i) == 1, *sections};
        m->profile[i] = sm->section;
        if (!scene_member_tapers(sm))
            continue;
        const int k = find(tapers, list, &t);
        if (k == tapers) {
            member[tapers] = i;
            list[tapers++] = t;
            *sections += t.steps;
        }
        m->profile[i] = list[k].first;
    }
    return tapers;
}

static status fill_all(model *m, int tapers, const taper *list, const int *member, int sections,
                       fault *f)
{
    section *all = realloc(m->section, (size_t)(sections + 1) * sizeof *all);
    if (all == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for %d sections", sections);
    m->section = all;
    for (int i = 0; i < tapers; i++) {
        TRY(fill(m, member[i], &list[i], f));
    }
    return STATUS_OK;
}

status profile_members(model *m, int *sections, fault *f)
{
    const size_t members = (size_t)m->scene->members;
    taper *list = malloc((members + 1) * sizeof *list);
    int *member = malloc((members + 1) * sizeof *member);
    m->profile = malloc((members + 1) * sizeof *m->profile);
    status outcome = STATUS_FAULT;
    *sections = m->scene->sections;
    if (list == NULL || member == NULL || m->profile == NULL) {
        fault_set(f, outcome, "out of memory for the sections of members");
    } else {
        const int tapers = list_tapers(m, list, member, sections);
        outcome = tapers > 0 ? fill_all(m, tapers, list, member, *sections, f) : STATUS_OK;
    }
    free(list);
    free(member);
    return outcome;
}
