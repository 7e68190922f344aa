#include "harness/model/division.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A place of a member at which pieces meet. */
typedef struct division_cut {
    int member;
    double place;
} division_cut;

static int in_order(const void *a, const void *b)
{
    const division_cut *p = a, *q = b;
    if (p->member != q->member)
        return p->member < q->member ? -1 : 1;
    return (p->place > q->place) - (p->place < q->place);
}

/* All of the loads, in order; returns how many. */
static int list_cuts(const scene *s, division_cut out[])
{
    int count = 0;
    for (int i = 0; i < s->loads; i++) {
        const scene_load *load = &s->load[i];
        for (int k = 0; k < 2 && scene_load_along(load); k++)
            if (load->range[k] > 0 && load->range[k] < 1)
                out[count++] = (division_cut){load->where, load->range[k]};
    }
    qsort(out, (size_t)count, sizeof *out, in_order);
    return count;
}

/* The places of one member, from its cuts on; returns how many cuts those are. */
static int place_pieces(int member, const division_cut cuts[], int count, double place[],
                        int *pieces)
{
    int used = 0;
    *pieces = 0;
    place[0] = 0;
    for (; used < count && cuts[used].member == member; used++)
        if (cuts[used].place - place[*pieces] >= DIVISION_LEAST &&
            1 - cuts[used].place >= DIVISION_LEAST)
            place[++*pieces] = cuts[used].place;
    place[++*pieces] = 1;
    return used;
}

status division_make(const scene *s, int elements, division *out, fault *f)
{
    const size_t members = (size_t)s->members, most = 2 * (size_t)s->loads;
    division_cut *cuts = malloc((most + 1) * sizeof *cuts);
    out->first = malloc((members + 1) * sizeof *out->first);
    out->each = malloc((members + 1) * sizeof *out->each);
    out->place = malloc((2 * members + most + 1) * sizeof *out->place);
    if (cuts == NULL || out->first == NULL || out->each == NULL || out->place == NULL) {
        free(cuts);
        return fault_set(f, STATUS_FAULT, "out of memory for the division of members");
    }
    const int count = list_cuts(s, cuts);
    int used = 0;
    out->first[0] = 0;
    for (int i = 0; i < s->members; i++) {
        int pieces;
        used += place_pieces(i, cuts + used, count - used, &out->place[out->first[i] + i], &pieces);
        out->first[i + 1] = out->first[i] + pieces;
        out->each[i] = s->member[i].divisions > 0 ? s->member[i].divisions : elements;
    }
    free(cuts);
    return STATUS_OK;
}

void division_free(division *d)
{
    free(d->first);
    free(d->each);
    free(d->place);
    memset(d, 0, sizeof *d);
}

int division_pieces(const division *d, int member)
{
    return d->first[member + 1] - d->first[member];
}

int division_elements(const division *d, int member)
{
    return division_pieces(d, member) * d->each[member];
}

int division_piece(const division *d, int member, int number, double ends[2])
{
    const int piece = number / d->each[member];
    memcpy(ends, &d->place[d->first[member] + member + piece], 2 * sizeof *ends);
    return number % d->each[member];
}

double division_place(const division *d, int member, int number, double x)
{
    double ends[2];
    const int in_piece = division_piece(d, member, number, ends);
    return ends[0] + (ends[1] - ends[0]) * ((in_piece + x) / d->each[member]);
}

double division_inside(const division *d, int member, int number, double place)
{
    double ends[2];
    const int in_piece = division_piece(d, member, number, ends);
    return (place - ends[0]) / (ends[1] - ends[0]) * d->each[member] - in_piece;
}

int division_at(const division *d, int member, double place, int before, double *x)
{
    const double *ends = &d->place[d->first[member] + member], rounding = 1e-12;
    const int pieces = division_pieces(d, member), each = d->each[member];
    int piece = 0;
    while (piece + 1 < pieces && ends[piece + 1] <= place + rounding)
        piece++;
    const double inside = (place - ends[piece]) / (ends[piece + 1] - ends[piece]) * each;
    const int in_piece = (int)fmin(fmax(floor(inside), 0), each - 1),
              number = piece * each + in_piece;
    *x = fmax(inside - in_piece, 0);
    if (!before || number == 0 || *x > rounding * each)
        return number;
    *x = 1;
    return number - 1;
}
