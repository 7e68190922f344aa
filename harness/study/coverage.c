/* How often limits lie within their uncertainty of an exact truth. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/study/coverage.h"

/* Of the series' case and formulation. */
static coverage *row_of(const sweep *s, judgement *j, const series *one, fault *f)
{
    const case_type *of = s->point[one->point].type;
    for (int i = 0; i < j->coverages; i++)
        if (j->coverage[i].type == one->formulation.type && j->coverage[i].of == of)
            return &j->coverage[i];
    coverage *more = realloc(j->coverage, (size_t)(j->coverages + 1) * sizeof *more);
    if (more == NULL) {
        fault_set(f, STATUS_FAULT, "out of memory for coverages");
        return NULL;
    }
    j->coverage = more;
    more[j->coverages] = (coverage){.of = of, .type = one->formulation.type, .point = one->point};
    return &more[j->coverages++];
}

static void count(const sweep *s, const verdict *v, coverage *row)
{
    for (int k = 0; k < COVERAGE_MESHES && k < s->series[v->series].meshes; k++) {
        const mesh_limit l = k == 0 ? v->fit : verdict_limit(s, v->series, v->quantity, k);
        if (l.meshes < 3)
            continue;
        row->series[k]++;
        row->covered[k] +=
            fabs(l.limit - v->truth->value) <= l.limit_uncertainty + v->truth->uncertainty;
    }
}

status coverage_count(const sweep *s, int first, judgement *out, fault *f)
{
    for (int i = first; i < out->verdicts; i++) {
        const verdict *v = &out->verdict[i];
        if (v->truth == NULL || strcmp(v->truth->kind, "exact") != 0 || isnan(v->fit.limit))
            continue;
        if (s->series[v->series].imported != NULL)
            continue;
        coverage *row = row_of(s, out, &s->series[v->series], f);
        if (row == NULL)
            return STATUS_FAULT;
        count(s, v, row);
    }
    return STATUS_OK;
}
