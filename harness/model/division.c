#include "harness/model/model_impl.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "elements/section/section.h"

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

/* Sets place[*pieces + 1], the ends of the pieces of a member, from its cuts. Returns the number of
 * cuts of the member. */
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
        return fault_memory(f, "the division of members");
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

enum { MOST_NAMES = 4, MOST_PLACES = 8 };

static void put_member(model_words *w, const scene *s, const division *d, int member)
{
    const int pieces = division_pieces(d, member);
    const double *place = &d->place[d->first[member] + member];
    model_words_put(w, "%s%s has ", w->used > 0 ? "; " : "",
                    scene_name(s, SCENE_MEMBERS, member).text);
    if (d->each[member] == 0)
        model_words_put(w, "n elements ");
    else
        model_words_put(w, "%d elements, %d ", division_elements(d, member), d->each[member]);
    model_words_put(w, "in each of %d pieces, because loads begin, end or act at", pieces);
    for (int i = 1; i < pieces && i <= MOST_PLACES; i++)
        model_words_put(w, "%s %.6g", i > 1 ? "," : "", place[i]);
    model_words_put(w, "%s of the length", pieces - 1 > MOST_PLACES ? ", .." : "");
}

void division_words(const scene *s, int elements, char *text, size_t room)
{
    model_words w = {text, room, 0};
    division d = {0};
    int more = 0;
    text[0] = '\0';
    if (division_make(s, elements, &d, NULL) == STATUS_OK)
        for (int i = 0, named = 0; i < s->members; i++) {
            if (division_pieces(&d, i) == 1)
                continue;
            if (named++ < MOST_NAMES)
                put_member(&w, s, &d, i);
            else
                more++;
        }
    if (more > 0)
        model_words_put(&w, "; and %d more members", more);
    division_free(&d);
}

typedef struct taper {
    int p, q, steps, even, first;
} taper;

status profile_scene(model *m, fault *f)
{
    const scene *s = m->scene;
    m->section = calloc((size_t)(s->sections > 0 ? s->sections : 1), sizeof *m->section);
    if (m->section == NULL)
        return fault_memory(f, "sections");
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

/* Checks a section between the ends of a tapered member for properties that the sections at the
 * ends do not have. */
static status check_between(const model *m, int member, const section *c, fault *f)
{
    const scene_member *sm = &m->scene->member[member];
    const section *p = &m->section[sm->section], *q = &m->section[sm->section_q];
    const int cells = m->scene->section[sm->section].cells;
    const char *limit =
        missing_in_section(m->mesh.type, c, cells, (m->features & FEATURE_WARPING) != 0);
    if ((c->Iw > 0) != (p->Iw > 0 || q->Iw > 0))
        limit = "warping";
    else if (features_eccentric(c) && !features_eccentric(p) && !features_eccentric(q))
        limit = "a shear centre away from the centroid";
    if (limit == NULL)
        return STATUS_OK;
    return fault_set(f, STATUS_REFUSED,
                     "%s: only a part of the member has this property: %s; split the member with a "
                     "node where that part begins",
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
        return fault_memory(f, "%d sections", sections);
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
        fault_memory(f, "the sections of members");
    } else {
        const int tapers = list_tapers(m, list, member, sections);
        outcome = tapers > 0 ? fill_all(m, tapers, list, member, *sections, f) : STATUS_OK;
    }
    free(list);
    free(member);
    return outcome;
}
