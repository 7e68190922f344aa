#include "harness/terminal/table_curves.h"

#include <math.h>
#include <string.h>

#include "harness/newton/newton.h"
#include "harness/study/study.h"
#include "harness/terminal/paragraph.h"
#include "harness/terminal/table.h"
#include "harness/terminal/table_stability.h"

enum { COLUMN = 18, COLUMNS = (PARAGRAPH_WIDTH - COLUMN - 8) / COLUMN, ROWS = 20, NAME = 24 };
enum { MESH = 12, MESHES = 5, DIGITS = 8, X_DIGITS = 7 };

static const curve *curve_of(const scene *s, const solve_result *r, int quantity)
{
    if (quantity >= r->quantities || s->quantity[quantity].reduction != SCENE_CURVE)
        return NULL;
    const curve *c = &r->quantity[quantity].curve;
    return c->points > 0 ? c : NULL;
}

/* The analysis whose stations the curve is of, where steps end; SCENE_NONE: they are no equilibria
 * of a path with given stations. */
static int path_of(const scene *s, int quantity)
{
    const int analysis = s->quantity[quantity].analysis;
    const scene_analysis *a = &s->analysis[analysis];
    const int path =
        a->kind == SCENE_COMPLIANCE && a->follows != SCENE_NONE ? a->follows : analysis;
    const scene_analysis_kind kind = s->analysis[path].kind;
    return kind == SCENE_STATIC || kind == SCENE_ROTATION ? path : SCENE_NONE;
}

/* Do both have the same abscissa? */
static int beside(const scene *s, const solve_result *r, int a, int b)
{
    const curve *p = curve_of(s, r, a), *q = curve_of(s, r, b);
    return p != NULL && q != NULL && p->points == q->points && path_of(s, a) == path_of(s, b) &&
           strcmp(s->quantity[a].x.name, s->quantity[b].x.name) == 0 &&
           memcmp(p->x, q->x, (size_t)p->points * sizeof *p->x) == 0;
}

static void write_name(FILE *to, const char *name, const char *unit)
{
    char text[SCENE_NAME + SCENE_UNIT + 4];
    snprintf(text, sizeof text, "%s [%s]", name, unit);
    fprintf(to, "%*s", COLUMN, text);
    if (strlen(text) >= COLUMN)
        fputc(' ', to);
}

static double largest_of(int points, const double value[])
{
    double largest = 0;
    for (int i = 0; i < points; i++)
        largest = isfinite(value[i]) ? fmax(largest, fabs(value[i])) : largest;
    return largest;
}

/* 0 where the value is round-off beside the largest one. */
static double without_noise(int points, const double value[], int at)
{
    const double noise = 1e-13;
    return fabs(value[at]) < noise * largest_of(points, value) ? 0 : value[at];
}

/* To the digit that the mesh may change. */
static void write_value(FILE *to, const quantity_result *r, int at)
{
    const curve *c = &r->curve;
    const double value = without_noise(c->points, c->value, at),
                 apart = r->change * largest_of(c->points, c->value);
    char text[ROUNDING_TEXT];
    if (apart > pow(10, 2 - DIGITS) * fabs(value)) {
        rounding_known(value, apart, text);
        fprintf(to, "%*s", COLUMN, text);
    } else
        table_digits(to, COLUMN, value, DIGITS);
}

/* Curves list[count] over the abscissa of the first. */
static void write_block(FILE *to, const scene *s, const solve_result *r, int count,
                        const int list[])
{
    const curve *first = curve_of(s, r, list[0]);
    const scene_abscissa *x = &s->quantity[list[0]].x;
    const int rows = first->points <= ROWS + 4 ? first->points : ROWS;
    write_name(to, x->name, x->unit);
    for (int k = 0; k < count; k++)
        write_name(to, s->quantity[list[k]].name, s->quantity[list[k]].unit);
    const int path = path_of(s, list[0]);
    fprintf(to, "%s\n", path != SCENE_NONE ? "  stable" : "");
    for (int i = 0; i < rows; i++) {
        const int at = rows > 1 ? (int)((long)i * (first->points - 1) / (rows - 1)) : 0;
        table_value(to, COLUMN, X_DIGITS, 'g', without_noise(first->points, first->x, at));
        for (int k = 0; k < count; k++)
            write_value(to, &r->quantity[list[k]], at);
        if (path != SCENE_NONE)
            fprintf(to, "%8s",
                    table_stability_word(history_stability_at(
                        r, path, scene_path_of(&s->analysis[path])->value[at])));
        fputc('\n', to);
    }
    if (rows < first->points)
        paragraph_say(to, 0, 2, "  %d of %d points; --format csv and json have them all", rows,
                      first->points);
}

void table_curves_values(FILE *to, const scene *s, const solve_result *r)
{
    for (int q = 0; q < s->quantities; q++) {
        int list[COLUMNS], count = 0, known = curve_of(s, r, q) == NULL;
        for (int k = 0; k < q && !known; k++)
            known = beside(s, r, k, q); /* it stands there already */
        for (int k = q; k < s->quantities && !known; k++) {
            if (beside(s, r, q, k))
                list[count++] = k;
            if (count > 0 && (count == COLUMNS || k + 1 == s->quantities)) {
                write_block(to, s, r, count, list);
                count = 0;
            }
        }
    }
}

/* Is the curve the same on all meshes of all formulations, as what is prescribed is? */
static int is_given(const sweep *s, int quantity, int reference)
{
    const series *other = &s->series[reference];
    const solve_result *best = &other->cell[curve_error_finest(other, quantity)].solve;
    for (int i = 0; i < s->seriess; i++)
        for (int k = 0; s->series[i].missing[0] == '\0' && k < s->series[i].meshes; k++) {
            const solve_result *r = &s->series[i].cell[k].solve;
            if (!(curve_error_between(&s->point[0].scene, quantity, r, best, NULL) < 1e-14))
                return 0;
        }
    return 1;
}

/* In percent, without a sign. */
static void write_percent(FILE *to, double error)
{
    char text[ROUNDING_TEXT];
    rounding_percent(error, text);
    fprintf(to, "%*s", MESH, text[0] == '+' ? text + 1 : text);
}

static void errors_of(FILE *to, const sweep *s, int quantity, int index, int reference)
{
    const series *one = &s->series[index];
    const scene *what = &s->point[0].scene;
    const int finest = curve_error_finest(one, quantity);
    const series *other = &s->series[reference];
    const solve_result *best = &other->cell[curve_error_finest(other, quantity)].solve;
    const int first = one->meshes > MESHES ? one->meshes - MESHES : 0;
    const int at = fprintf(to, "  %-*s", NAME - 2, one->formulation.key);
    if (at > NAME)
        fprintf(to, "\n%*s", NAME, "");
    for (int k = first; k < one->meshes; k++)
        if (k == finest)
            fprintf(to, "%*s", MESH, "finest");
        else
            write_percent(to, finest >= 0 ? curve_error_between(what, quantity, &one->cell[k].solve,
                                                                &one->cell[finest].solve, NULL)
                                          : NAN);
    if (index != reference)
        write_percent(to, finest >= 0 ? curve_error_between(what, quantity,
                                                            &one->cell[finest].solve, best, NULL)
                                      : NAN);
    fputc('\n', to);
}

static void write_meshes(FILE *to, const series *one, int several, const char *reference)
{
    const int first = one->meshes > MESHES ? one->meshes - MESHES : 0;
    fprintf(to, "%*s", NAME, "n");
    for (int k = first; k < one->meshes; k++)
        fprintf(to, "%*d", MESH, one->mesh[k]);
    fprintf(to, "%s%s\n", several ? "  from " : "", several ? reference : "");
}

static void write_errors(FILE *to, const sweep *s, int quantity, int reference)
{
    const scene_quantity *q = &s->point[0].scene.quantity[quantity];
    int running = 0, last = -1;
    for (int i = 0; i < s->seriess; i++)
        running += s->series[i].missing[0] == '\0';
    const int at = fprintf(to, "\n%s [%s] over %s [%s], ", q->name, q->unit, q->x.name, q->x.unit);
    paragraph_say(to, at - 1, 4,
                  "largest error over the curve, of its largest value, against the finest mesh%s",
                  running > 1 ? "; of the finest one, from that of another formulation" : "");
    for (int i = 0; i < s->seriess; i++) {
        const series *one = &s->series[i];
        if (one->missing[0] != '\0')
            continue;
        const int same =
            last >= 0 && s->series[last].meshes == one->meshes &&
            memcmp(s->series[last].mesh, one->mesh, (size_t)one->meshes * sizeof *one->mesh) == 0;
        if (!same)
            write_meshes(to, one, running > 1, s->series[reference].formulation.key);
        last = i;
        errors_of(to, s, quantity, i, reference);
    }
}

void table_curves_errors(FILE *to, const sweep *s)
{
    const scene *what = &s->point[0].scene;
    int best = -1, mesh = -1;
    for (int q = 0; q < what->quantities; q++) {
        const int reference =
            what->quantity[q].reduction == SCENE_CURVE ? curve_error_reference(s, q) : -1;
        if (reference < 0)
            continue;
        if (is_given(s, q, reference))
            fprintf(to, "\n%s [%s]: the same curve on all meshes\n", what->quantity[q].name,
                    what->quantity[q].unit);
        else
            write_errors(to, s, q, reference);
        if (best < 0) {
            best = reference;
            mesh = curve_error_finest(&s->series[best], q);
        }
    }
    if (best < 0)
        return;
    fprintf(to, "\n%s, n = %d\n", s->series[best].formulation.key, s->series[best].mesh[mesh]);
    table_curves_values(to, what, &s->series[best].cell[mesh].solve);
}
