#include "harness/record/reach_line.h"

#include <stdlib.h>

/* A series that reaches the level. */
typedef struct reached {
    const char *key;
    int elements;
    double seconds;
} reached;

static int sooner(const void *a, const void *b)
{
    const double p = ((const reached *)a)->seconds, q = ((const reached *)b)->seconds;
    return (p > q) - (p < q);
}

static int find_reached(const sweep *s, const truths *t, reached *out)
{
    int count = 0;
    for (int i = 0; i < s->seriess; i++) {
        const series *one = &s->series[i];
        const int mesh = reach_every(s, t, i, REACH_LINE_LEVEL);
        if (mesh < 0)
            continue;
        const solve_result *r = &one->cell[mesh].solve;
        out[count++] =
            (reached){one->formulation.key, one->mesh[mesh], r->seconds_setup + r->seconds_solve};
    }
    qsort(out, (size_t)count, sizeof *out, sooner);
    return count;
}

static void write_unreached(FILE *to, const sweep *s, const truths *t)
{
    const char *before = "; not reached by ";
    for (int i = 0; i < s->seriess; i++) {
        if (s->series[i].missing[0] != '\0' || reach_every(s, t, i, REACH_LINE_LEVEL) >= 0)
            continue;
        fprintf(to, "%s%s", before, s->series[i].formulation.key);
        before = ", ";
    }
}

/* Number of quantities that formulations have a reference for; those without are named. */
static int write_unreferenced(FILE *to, const sweep *s, const truths *t)
{
    const char *before = "; no reference, neither a truth nor an agreement of two families, for ";
    int known = 0;
    if (s->seriess > 0)
        for (int q = 0; q < s->point[s->series[0].point].scene.quantities; q++) {
            const point *p = &s->point[s->series[0].point];
            int found = 0;
            if (p->scene.quantity[q].reduction == SCENE_CURVE)
                continue;
            for (int i = 0; i < s->seriess; i++)
                found |= verdict_reference(t, p, &s->series[i].formulation, q) != NULL;
            known += found;
            if (found)
                continue;
            if (to != NULL)
                fprintf(to, "%s%s", before, p->scene.quantity[q].name);
            before = ", ";
        }
    return known;
}

void reach_line_write(FILE *to, const sweep *s, const truths *t)
{
    reached *all = calloc((size_t)s->seriess + 1, sizeof *all);
    const int count = all != NULL ? find_reached(s, t, all) : 0;
    const int known = write_unreferenced(NULL, s, t);
    fprintf(to, "for 1 %% in every quantity: ");
    if (count == 0)
        fprintf(to, known > 0 ? "no formulation on these meshes" : "nothing to measure by");
    for (int i = 0; i < count; i++)
        fprintf(to, "%s%s n = %d (%.2g ms)", i > 0 ? "; " : "", all[i].key, all[i].elements,
                1e3 * all[i].seconds);
    if (known > 0)
        write_unreached(to, s, t);
    write_unreferenced(to, s, t);
    fputc('\n', to);
    free(all);
}
