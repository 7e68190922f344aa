#include "harness/records/comparison_lines.h"

#include <math.h>
#include <string.h>

const char *const comparison_kind_names[COMPARISON_KINDS] = {"worse", "better", "changed", "gone",
                                                             "new"};

void comparison_lines_heading(const listing *l, comparison_kind kind)
{
    l->out->count[kind]++;
    fprintf(l->to, "%-8s %s", comparison_kind_names[kind], l->name);
    if (l->elements > 0)
        fprintf(l->to, " n=%d", l->elements);
}

void comparison_lines_lone(const listing *l, comparison_kind kind)
{
    comparison_lines_heading(l, kind);
    fputc('\n', l->to);
}

void comparison_lines_status(const listing *l, const char *before, const char *after)
{
    if (strcmp(before, after) == 0)
        return;
    comparison_kind kind = CHANGE_OTHER;
    if (strcmp(after, "ok") == 0)
        kind = CHANGE_BETTER;
    else if (strcmp(before, "ok") == 0)
        kind = CHANGE_WORSE;
    comparison_lines_heading(l, kind);
    fprintf(l->to, ": %s -> %s\n", before, after);
}

void comparison_lines_work(const listing *l, const long before[RESULTS_WORKS],
                           const long after[RESULTS_WORKS], int meshes)
{
    for (int k = 0; k < RESULTS_WORKS; k++) {
        const double old = (double)before[k], new = (double)after[k];
        l->out->work[0][k] += old;
        l->out->work[1][k] += new;
        if (fabs(new - old) <= l->limits->work * old / meshes)
            continue;
        comparison_lines_heading(l, new > old ? CHANGE_WORSE : CHANGE_BETTER);
        fprintf(l->to, ": %s %ld -> %ld", results_work_names[k], before[k], after[k]);
        fprintf(l->to, old > 0 ? " (%+.1f %%)\n" : "\n", 100 * (new - old) / old);
    }
}

void comparison_lines_cost(const listing *l, double before, double after)
{
    const double milli = 1e3;
    if (!(before > 0 && after > 0))
        return;
    l->out->cost[0] += before;
    l->out->cost[1] += after;
    if (fabs(after - before) <= l->limits->work * before)
        return;
    comparison_lines_heading(l, after > before ? CHANGE_WORSE : CHANGE_BETTER);
    fprintf(l->to, ": cost %.4g ms -> %.4g ms (%+.1f %%)\n", milli * before, milli * after,
            100 * (after - before) / before);
}
