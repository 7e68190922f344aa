#include "harness/cli/supports_told.h"

#include <math.h>
#include <stdio.h>

#include "harness/model/warping_ends.h"
#include "harness/study/cell.h"

enum { MOST_MEMBERS = 200, ELEMENTS = 2 };
static const double rounding = 1e-8;

static int is_moved(const scene *s)
{
    for (int i = 0; i < s->analyses; i++)
        if (s->analysis[i].kind == SCENE_MOTION)
            return 1;
    return 0;
}

static int is_near(double a, double b, double near_zero)
{
    return fabs(a - b) <= rounding * fmax(fmax(fabs(a), fabs(b)), near_zero);
}

static int is_same_curve(const curve *a, const curve *b, double near_zero)
{
    int same = a->points == b->points;
    for (int i = 0; same && i < a->points; i++)
        same = is_near(a->value[i], b->value[i], near_zero);
    return same;
}

static int is_same(const scene *s, const cell_result *a, const cell_result *b)
{
    if (a->solve.quantities != b->solve.quantities ||
        a->counters.negative_pivots != b->counters.negative_pivots)
        return 0;
    for (int i = 0; i < a->solve.quantities; i++) {
        const quantity_result *p = &a->solve.quantity[i], *q = &b->solve.quantity[i];
        const double near_zero = s->quantity[i].near_zero;
        if (p->status != q->status || !is_same_curve(&p->curve, &q->curve, near_zero) ||
            (p->status == STATUS_OK && s->quantity[i].reduction != SCENE_CURVE &&
             !is_near(p->value, q->value, near_zero)))
            return 0;
    }
    return 1;
}

/* Do the answers of the two scenes differ? 1 too where that cannot be told. */
static int differs(const scene *now, const scene *before, const formulation *chosen)
{
    cell_result held = {.size = {0}}, freed = {.size = {0}};
    cell_request request = {.scene = now, .elements = ELEMENTS};
    int same = 0;
    if (now->members > MOST_MEMBERS || is_moved(now))
        return 1;
    cell_formulation(&request, chosen);
    if (cell_run(&request, &held, NULL) == STATUS_OK) {
        request.scene = before;
        same = cell_run(&request, &freed, NULL) == STATUS_OK && is_same(now, &held, &freed);
    }
    cell_result_free(&held);
    cell_result_free(&freed);
    return !same;
}

void supports_told(const scene_file *file, const double parameter[], const formulation *chosen,
                   const scene *s)
{
    char ends[FAULT_TEXT] = "";
    scene before;
    if (file == NULL)
        return;
    if (scene_file_build_before(file, parameter, &before, NULL) == STATUS_OK)
        warping_ends_freed(s, &before, ends, sizeof ends);
    if (ends[0] != '\0' && differs(s, &before, chosen))
        fprintf(stderr,
                "beamwork: warping is %s, as supports say; earlier versions left it free: write "
                "'warping: free' at these members for the former answer\n",
                ends);
    scene_free(&before);
}
