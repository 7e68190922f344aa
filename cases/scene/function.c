#include "cases/scene/scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int function_add(scene_function *to, double until, const char *text)
{
    scene_piece *longer = realloc(to->piece, ((size_t)to->pieces + 1) * sizeof *longer);
    if (longer == NULL)
        return -1;
    fault ignored;
    to->piece = longer;
    scene_piece *p = &to->piece[to->pieces];
    *p = (scene_piece){until, strdup(text), NULL};
    if (p->text == NULL)
        return -1;
    formula_read(text, &p->is, &ignored);
    to->pieces++;
    return 0;
}

void function_free(scene_function *f)
{
    for (int i = 0; i < f->pieces; i++) {
        free(f->piece[i].text);
        formula_free(f->piece[i].is);
    }
    free(f->piece);
    *f = (scene_function){0, NULL, 0};
}

int function_copy(scene_function *to, const scene_function *from)
{
    for (int i = 0; i < from->pieces; i++)
        if (function_add(to, from->piece[i].until, from->piece[i].text) < 0)
            return -1;
    to->scale = from->scale;
    return 0;
}

status function_check(const scene_function *s, fault *f)
{
    for (int i = 0; i < s->pieces; i++) {
        formula *again = NULL;
        if (s->piece[i].is == NULL) {
            TRY(formula_read(s->piece[i].text, &again, f));
            formula_free(again);
            return fault_memory(f, "a function of time");
        }
        if (i > 0 && i < s->pieces - 1 && !(s->piece[i].until > s->piece[i - 1].until))
            return fault_set(f, STATUS_REFUSED,
                             "a function of time in pieces: piece %d ends at %g s, not after the "
                             "end of the previous piece; sort the pieces",
                             i + 1, s->piece[i].until);
    }
    return STATUS_OK;
}

void function_at(const scene_function *f, double t, double out[3])
{
    int i = 0;
    while (i < f->pieces - 1 && t >= f->piece[i].until)
        i++;
    formula_at(f->piece[i].is, t, out);
    for (int k = 0; k < 3 && f->scale != 0; k++)
        out[k] *= f->scale;
}

/* Number of equal intervals of a piece at whose ends it is checked. */
enum { SAMPLES = 64 };

static int is_finite(const double at[3], int derivatives)
{
    for (int k = 0; k <= derivatives; k++)
        if (!isfinite(at[k]))
            return 0;
    return 1;
}

int function_finite(const scene_function *f, double end, int derivatives, double *time)
{
    double from = 0, at[3];
    for (int i = 0; i < f->pieces && from <= end; i++) {
        const int last = i == f->pieces - 1;
        const double to = last ? end : fmin(end, f->piece[i].until);
        for (int k = 0; k <= SAMPLES && from <= to; k++) {
            *time = k == SAMPLES ? to : from + k * (to - from) / SAMPLES;
            formula_at(f->piece[i].is, *time, at);
            if (!is_finite(at, derivatives))
                return 0;
        }
        from = last ? INFINITY : fmax(from, f->piece[i].until);
    }
    return 1;
}

int function_smooth(const scene_function *f, double end, double *time, int *derivative)
{
    static const double noise = 1e-9;
    for (int i = 0; i + 1 < f->pieces; i++) {
        double before[3], behind[3];
        *time = f->piece[i].until;
        if (*time <= 0 || *time >= end)
            continue;
        formula_at(f->piece[i].is, *time, before);
        formula_at(f->piece[i + 1].is, *time, behind);
        for (*derivative = 0; *derivative < 2; ++*derivative)
            if (fabs(before[*derivative] - behind[*derivative]) >
                noise * (1 + fabs(before[*derivative])))
                return 0;
    }
    return 1;
}

static int by_end(const void *a, const void *b)
{
    const scene_piece *const *x = a, *const *y = b;
    return ((*x)->until > (*y)->until) - ((*x)->until < (*y)->until);
}

static int list_ends(const scene_function *f, scene_piece *list[])
{
    for (int i = 0; i < f->pieces - 1; i++)
        list[i] = &f->piece[i];
    return f->pieces > 1 ? f->pieces - 1 : 0;
}

static int is_same(double a, double b)
{
    static const double rounding = 1e-12;
    return fabs(a - b) <= rounding * fabs(a);
}

void scene_join_instants(scene *s)
{
    size_t most = 1;
    int n = 0;
    for (int i = 0; i < s->drivers; i++)
        most += (size_t)s->driver[i].function.pieces;
    for (int i = 0; i < s->loads; i++)
        most += (size_t)s->load[i].function.pieces;
    scene_piece **piece = calloc(most, sizeof *piece);
    if (piece == NULL) {
        s->out_of_memory = 1;
        return;
    }
    for (int i = 0; i < s->drivers; i++)
        n += list_ends(&s->driver[i].function, piece + n);
    for (int i = 0; i < s->loads; i++)
        n += list_ends(&s->load[i].function, piece + n);
    qsort(piece, (size_t)n, sizeof *piece, by_end);
    for (int k = 1; k < n; k++)
        if (is_same(piece[k - 1]->until, piece[k]->until))
            piece[k]->until = piece[k - 1]->until;
    for (int i = 0; i < s->analyses; i++) {
        const scene_path *path = scene_path_of(&s->analysis[i]);
        for (int k = 0; k < n && s->analysis[i].kind == SCENE_MOTION; k++)
            if (is_same(path->value[path->stations - 1], piece[k]->until))
                piece[k]->until = path->value[path->stations - 1];
    }
    free(piece);
}
