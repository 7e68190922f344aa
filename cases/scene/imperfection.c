#include "cases/scene/scene_impl.h"

#include <math.h>
#include <string.h>

#include "elements/math/dense.h"

int scene_add_imperfection(scene *s)
{
    const int i = scene_grow(s, &s->imperfection, &s->imperfections, sizeof *s->imperfection);
    if (i >= 0) {
        s->imperfection[i].analysis = SCENE_NONE;
        s->imperfection[i].factor = 1;
    }
    return i;
}

void scene_shift_node(scene *s, int imperfection, int node, const double shift[3])
{
    if (imperfection < 0) /* out of memory */
        return;
    scene_imperfection *p = &s->imperfection[imperfection];
    int shifts = p->nodes;
    const int i = scene_grow(s, &p->shift, &shifts, sizeof *p->shift),
              k = i >= 0 ? scene_grow(s, &p->node, &p->nodes, sizeof *p->node) : i;
    if (k < 0)
        return;
    p->node[k] = node;
    memcpy(p->shift[k], shift, sizeof p->shift[k]);
}

static int root_of(const scene *s, int analysis)
{
    while (s->analysis[analysis].follows != SCENE_NONE)
        analysis = s->analysis[analysis].follows;
    return analysis;
}

int scene_is_perfect(const scene *s, int analysis)
{
    for (int i = 0; i < s->imperfections; i++)
        if (s->imperfection[i].analysis != SCENE_NONE &&
            root_of(s, s->imperfection[i].analysis) == root_of(s, analysis))
            return 1;
    return 0;
}

static status check_mode(const scene *s, int i, fault *f)
{
    const scene_imperfection *p = &s->imperfection[i];
    const scene_analysis *a = &s->analysis[p->analysis];
    if ((a->kind != SCENE_BUCKLING && a->kind != SCENE_MODAL) || a->damped)
        return fault_set(f, STATUS_REFUSED,
                         "%s: %s has no undamped modes; name a buckling or a modal analysis",
                         scene_called(s, SCENE_IMPERFECTIONS, i).text,
                         scene_called(s, SCENE_ANALYSES, p->analysis).text);
    return STATUS_OK;
}

static status check_shifts(const scene *s, int i, fault *f)
{
    const scene_imperfection *p = &s->imperfection[i];
    const int normal = scene_normal(s);
    for (int k = 0; k < p->nodes; k++) {
        const scene_words called = scene_called(s, SCENE_IMPERFECTIONS, i);
        const char *owner_name = called.text;
        const double *v = p->shift[k];
        if (p->node[k] < 0 || p->node[k] >= s->nodes)
            return fault_set(f, STATUS_REFUSED, "%s: a shifted node does not exist; add it first",
                             owner_name);
        if (!isfinite(v[0]) || !isfinite(v[1]) || !isfinite(v[2]))
            return fault_set(f, STATUS_REFUSED,
                             "%s: the shift of %s is not finite; give finite numbers", owner_name,
                             scene_called(s, SCENE_NODES, p->node[k]).text);
        if (normal != SCENE_NONE && v[normal] != 0)
            return fault_set(f, STATUS_REFUSED,
                             "%s: the shift of %s leaves the plane; make that component 0",
                             owner_name, scene_called(s, SCENE_NODES, p->node[k]).text);
        for (int other = 0; other < k; other++)
            if (p->node[other] == p->node[k])
                return fault_set(f, STATUS_REFUSED, "%s: %s is shifted twice; give only one shift",
                                 owner_name, scene_called(s, SCENE_NODES, p->node[k]).text);
    }
    return STATUS_OK;
}

status scene_validate_imperfections(const scene *s, fault *f)
{
    int used = s->imperfections == 0;
    for (int i = 0; i < s->analyses; i++)
        used |= s->imperfections > 0 && !scene_is_perfect(s, i);
    for (int i = 0; i < s->imperfections; i++)
        TRY(s->imperfection[i].analysis != SCENE_NONE ? check_mode(s, i, f)
                                                      : check_shifts(s, i, f));
    return used ? STATUS_OK
                : fault_set(f, STATUS_REFUSED,
                            "%s: no analysis uses this imperfection; add one whose base state is "
                            "not that of the analysis of the mode",
                            scene_called(s, SCENE_IMPERFECTIONS, 0).text);
}
