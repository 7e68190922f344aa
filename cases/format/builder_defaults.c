/* What a scene asks for where its file does not say: one analysis, and what can be seen of it. */
#include <math.h>
#include <stdio.h>

#include "cases/format/builder.h"

/* A path to the last station of the motions; without motions, one linear solution. */
static int add_analysis(builder *b)
{
    double end = 0;
    for (int i = 0; i < b->scene->drivers; i++) {
        const scene_driver *d = &b->scene->driver[i];
        if (d->value != NULL && d->path != NULL && d->stations > 0)
            end = fmax(end, d->path[d->stations - 1]);
    }
    return end > 0 ? scene_add_static(b->scene, 1, &end, 1) : scene_add_linear(b->scene);
}

/* Does the node carry a load or follow a motion? */
static int is_asked(const scene *s, int node)
{
    for (int i = 0; i < s->loads; i++)
        if (!scene_load_along(&s->load[i]) && s->load[i].where == node)
            return 1;
    for (int k = 0; k < 3; k++)
        if (s->node[node].translation[k] >= 0)
            return 1;
    return 0;
}

/* Largest extent of the positions [m]: values far below it are zero. */
static double size_of(const scene *s)
{
    double least[3] = {INFINITY, INFINITY, INFINITY}, most[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (int i = 0; i < s->nodes; i++)
        for (int k = 0; k < 3; k++) {
            least[k] = fmin(least[k], s->node[i].position[k]);
            most[k] = fmax(most[k], s->node[i].position[k]);
        }
    return s->nodes > 0 ? hypot(hypot(most[0] - least[0], most[1] - least[1]), most[2] - least[2])
                        : 0;
}

static void add_displacements(builder *b, int analysis, int node, int prefixed)
{
    static const char *const component[] = {"ux", "uy", "uz"};
    scene *s = b->scene;
    for (int k = 0; k < 3; k++) {
        char name[2 * SCENE_NAME + 8];
        if (s->node[node].translation[k] != SCENE_FREE)
            continue;
        snprintf(name, sizeof name, "%s%s%s_%s",
                 prefixed ? b->list[SCENE_ANALYSES].entry[analysis].name : "", prefixed ? "_" : "",
                 b->list[SCENE_NODES].entry[node].name, component[k]);
        scene_quantity *q =
            scene_add_quantity(s, name, "m", analysis, scene_coordinate(node, SCENE_UX + k));
        q->near_zero = 1e-6 * size_of(s);
    }
}

/* Translations of the nodes that are loaded or driven; of all free ones where none is. */
static void add_states(builder *b, int analysis, int prefixed)
{
    const scene *s = b->scene;
    int asked = 0;
    for (int i = 0; i < s->nodes; i++)
        asked += is_asked(s, i);
    for (int i = 0; i < s->nodes; i++)
        if (asked > 0 ? is_asked(s, i) : s->node[i].attached == SCENE_NONE)
            add_displacements(b, analysis, i, prefixed);
}

/* Of a motion. */
static void add_energy(builder *b, int analysis, int prefixed)
{
    char name[SCENE_NAME + 8];
    snprintf(name, sizeof name, "%s%senergy",
             prefixed ? b->list[SCENE_ANALYSES].entry[analysis].name : "", prefixed ? "_" : "");
    scene_add_quantity(b->scene, name, "J", analysis, scene_balance_of(SCENE_ENERGY));
}

static void add_quantities(builder *b)
{
    scene *s = b->scene;
    for (int i = 0; i < s->analyses; i++)
        switch (s->analysis[i].kind) {
        case SCENE_LINEAR:
        case SCENE_STATIC:
            add_states(b, i, s->analyses > 1);
            break;
        case SCENE_BUCKLING:
            scene_add_quantity(s, b->list[SCENE_ANALYSES].entry[i].name, "1", i,
                               scene_critical_factor(1, 0));
            break;
        case SCENE_MOTION:
            add_states(b, i, s->analyses > 1);
            add_energy(b, i, s->analyses > 1);
            break;
        case SCENE_MODAL:
        case SCENE_ROTATION:
            scene_add_quantity(s, b->list[SCENE_ANALYSES].entry[i].name, "Hz", i,
                               scene_frequency(0, SCENE_ANY));
            break;
        case SCENE_COMPLIANCE:
            for (int k = 0; k < 3; k++) {
                char name[SCENE_NAME + 8];
                snprintf(name, sizeof name, "%s_k_%c", b->list[SCENE_ANALYSES].entry[i].name,
                         "xyz"[k]);
                scene_add_quantity(s, name, "N/m", i, scene_stiffness_entry(SCENE_UX + k));
            }
            break;
        case SCENE_CONTINUATION:
            scene_add_quantity(s, b->list[SCENE_ANALYSES].entry[i].name, "1", i, scene_factor_at());
            break;
        }
}

void builder_defaults(builder *b)
{
    if (b->mistakes->count > 0)
        return;
    if (b->scene->analyses == 0 && add_analysis(b) < 0)
        return;
    if (b->scene->quantities == 0)
        add_quantities(b);
}
