#include "harness/newton/newton_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"

/* Numbers the end coordinates, and the unknown coordinates among them. Returns the number of end
 * coordinates. Out of memory: s->unknown is NULL. */
static int condensation_number(condensation *s, int count, const int released[]);
static status condensation_patterns(condensation *s, int ends, fault *f);

/* Above this condition number, corrections from an assembled tangent have fewer than three correct
 * digits, and Newton's method needs more iterations. */
static const double most_condition = 1e12;

/* Returns 1 if rounding would spoil an assembled tangent of the member. The condition number is
 * estimated as that of a cantilever: 12 EI/l^3 of the shortest element, times the flexibility
 * L^3/(3 EI), times the number of elements. */
static int loses_digits(const model *m, int member)
{
    const int first = model_first_element(m, member), end = model_first_element(m, member + 1);
    double length = 0, shortest = INFINITY;
    for (int i = first; i < end; i++) {
        length += model_kind_of(m, i)->length;
        shortest = fmin(shortest, model_kind_of(m, i)->length);
    }
    return 4 * pow(length / shortest, 3) * (end - first) > most_condition;
}

/* Returns 1 if members can be condensed, and at least one has `from` or more elements (0: so many
 * that rounding would spoil an assembled tangent). Conditions: all loads with a stiffness act at
 * the ends of members, no member lies on an elastic foundation, the axes do not rotate, the scene
 * is spatial, elements have neither forces with a history nor additional unknowns, and the model
 * does not keep all coordinates. */
static int applies(const equations *eq, int from)
{
    const model *m = eq->m;
    int found = 0;
    if (eq->loading.rotates || model_absolute(m) || model_keeps_all(m) ||
        model_scene(m)->plane != SCENE_SPACE || model_scalars(m) > 0)
        return 0;
    for (int i = 0; i < model_scene(m)->loads; i++) {
        const scene_load *load = &model_scene(m)->load[i];
        if (scene_load_along(load) &&
            (scene_load_unsymmetric(load) || (load->lumped && vec3_norm(load->at) > 0)))
            return 0;
    }
    for (int i = 0; i < model_scene(m)->members; i++) {
        if (scene_is_founded(&model_scene(m)->member[i]))
            return 0;
        found |= from > 0 ? model_first_element(m, i + 1) - model_first_element(m, i) >= from
                          : loses_digits(m, i);
    }
    return found;
}

static void append_released(const model *m, const mesh_element *from, int vertex, int begin,
                            mesh_element *to)
{
    const mesh_release *r = release_of(m, vertex);
    for (int k = 0; r != NULL && k < r->turns + r->slides; k++)
        to->index[to->columns++] = from->index[begin + k];
}

static int released_columns(const model *m, int vertex)
{
    const mesh_release *r = release_of(m, vertex);
    return r != NULL ? r->turns + r->slides : 0;
}

static status member_of(const model *m, int index, condensed_member *out, fault *f)
{
    const int nodes = model_nodes(m), last = model_first_element(m, index + 1) - 1;
    out->first = model_first_element(m, index);
    out->elements = last + 1 - out->first;
    const mesh_element *p = model_element(m, out->first), *q = model_element(m, last);
    mesh_element *e = &out->ends;
    *e = *p;
    e->nodes = 2;
    e->columns = 2 * NODE_COORDINATES;
    e->plain = p->plain && q->plain;
    e->vertex[1] = q->vertex[nodes - 1];
    e->warp[1] = q->warp[nodes - 1];
    memcpy(out->triad[0], p->triad[0], sizeof(mesh_triad));
    memcpy(out->triad[1], q->triad[nodes - 1], sizeof(mesh_triad));
    e->triad = out->triad;
    memcpy(&e->index[NODE_COORDINATES], &q->index[NODE_COORDINATES * (nodes - 1)],
           NODE_COORDINATES * sizeof e->index[0]);
    append_released(m, p, e->vertex[0], NODE_COORDINATES * nodes, e);
    append_released(m, q, e->vertex[1], q->columns - released_columns(m, e->vertex[1]), e);
    const int warps = p->warp[0] != NONE || p->warp[1] != NONE || q->warp[nodes - 1] != NONE;
    out->form = (piece_form){.joint = warps ? NODE_COORDINATES : NODE_COORDINATES - 1,
                             .nodes = nodes,
                             .strains = model_strains(m)};
    return pieces_alloc(out, f);
}

static status find_members(condensation *s, const condensation *of, fault *f)
{
    const model *m = s->m;
    s->members = model_scene(m)->members;
    s->member = calloc((size_t)s->members, sizeof *s->member);
    if (s->member == NULL)
        return fault_memory(f, "the ends of members");
    s->lent = of != NULL;
    if (s->lent) {
        memcpy(s->member, of->member, (size_t)s->members * sizeof *s->member);
        return STATUS_OK;
    }
    for (int i = 0; i < s->members; i++)
        TRY(member_of(m, i, &s->member[i], f));
    return STATUS_OK;
}

static status build(condensation *s, const condensation *of, int count, const int released[],
                    int *few, fault *f)
{
    const model *m = s->m;
    TRY(find_members(s, of, f));
    s->number = malloc(((size_t)s->all + 1) * sizeof *s->number);
    s->end = calloc((size_t)s->members * MEMBER_COLUMNS, sizeof *s->end);
    if (s->number == NULL || s->end == NULL)
        return fault_memory(f, "the ends of members");
    const int ends = condensation_number(s, count, released);
    *few = ends <= MOST_ENDS;
    if (!*few)
        return STATUS_OK;
    s->small = malloc(((size_t)s->unknowns + 1) * sizeof *s->small);
    s->driven = malloc(((size_t)model_driven(m) + 1) * sizeof *s->driven);
    if (s->driven == NULL || s->unknown == NULL || s->small == NULL)
        return fault_memory(f, "the ends of members");
    s->K.symmetric = s->inside.symmetric = assemble_symmetric(m);
    s->inside.by_numbers = !s->inside.symmetric;
    TRY(condensation_patterns(s, ends, f));
    return factor_alloc(&s->inside, &s->factor, f);
}

static status allocate(const equations *eq, const condensation *of, int count, const int released[],
                       condensation **out, fault *f)
{
    const model *m = eq->m;
    int few = 0;
    condensation *s = calloc(1, sizeof *s);
    if (s == NULL)
        return fault_memory(f, "the ends of members");
    s->eq = eq;
    s->m = m;
    s->all = model_all_coordinates(m);
    const status outcome = build(s, of, count, released, &few, f);
    if (outcome == STATUS_OK && few)
        *out = s;
    else
        condensation_free(s);
    return outcome;
}

status condensation_alloc(const equations *eq, int from, int count, const int released[],
                          condensation **out, fault *f)
{
    *out = NULL;
    return applies(eq, from) ? allocate(eq, NULL, count, released, out, f) : STATUS_OK;
}

status condensation_alloc_like(const condensation *of, int count, const int released[],
                               condensation **out, fault *f)
{
    *out = NULL;
    return allocate(of->eq, of, count, released, out, f);
}

static void free_sparse(sparse *a)
{
    free(a->column);
    free(a->row);
    free(a->value);
}

void condensation_free(condensation *s)
{
    if (s == NULL)
        return;
    for (int i = 0; i < s->members && s->member != NULL && !s->lent; i++)
        pieces_free(&s->member[i]);
    free_sparse(&s->K);
    free_sparse(&s->inside);
    factor_free(s->factor);
    void *const all[] = {s->member, s->number, s->unknown, s->from, s->small, s->driven, s->end};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        free(all[i]);
    free(s);
}

static status member_matrix(condensation *s, condensed_member *of, double path, double K[],
                            fault *f)
{
    const int c = of->form.joint, n = 2 * NODE_COORDINATES;
    double small[4 * CHAIN_JOINT * CHAIN_JOINT], force[2 * NODE_COORDINATES];
    TRY(pieces_fill(s->eq, s->at, of, path, force, f));
    TRY(chain_stiffness(of->chain, small, f));
    s->negative += chain_negative(of->chain);
    memset(K, 0, (size_t)(n * n) * sizeof *K);
    for (int i = 0; i < 2 * c; i++)
        for (int j = 0; j < 2 * c; j++)
            K[(NODE_COORDINATES * (i / c) + i % c) * n + NODE_COORDINATES * (j / c) + j % c] =
                small[i * 2 * c + j];
    eliminate_matrix(s->m, s->at, &of->ends, force, K);
    return STATUS_OK;
}

static status members(condensation *s, double path, fault *f)
{
    double K[MODEL_MAX_COORDINATES * MODEL_MAX_COORDINATES];
    for (int i = 0; i < s->members; i++) {
        TRY(member_matrix(s, &s->member[i], path, K, f));
        assemble_discrete(&s->member[i].ends, K, &s->K);
    }
    return STATUS_OK;
}

status condensation_at(condensation *s, const model_state *at, double path, fault *f)
{
    const element_rotating_frame frame = loading_frame(&s->eq->loading, path);
    s->at = at;
    s->negative = 0;
    sparse_zero(&s->K);
    ahead_strains(s->eq, at, AHEAD_H, at->sigma);
    const status outcome = members(s, path, f);
    ahead_end(s->eq);
    TRY(outcome);
    for (int i = 0; i < model_discretes(s->m); i++) {
        element_part part = {.incompatibility = 0};
        discrete_equations(s->m, at, model_discrete(s->m, i), &frame, NULL, part.force, part.K);
        assemble_discrete(&model_discrete(s->m, i)->el, part.K, &s->K);
    }
    loads_subtract_at_vertices(s->eq, at, path, &s->K);
    linearise_add_held_moments(s->eq, at, path, &s->K);
    return STATUS_OK;
}

void condensation_take(condensation *s, const condensation *of, const model_state *at)
{
    s->at = at;
    s->negative = of->negative;
    memcpy(s->K.value, of->K.value, (size_t)s->K.column[s->K.n] * sizeof *s->K.value);
}

sparse *condensation_ends(condensation *s)
{
    return &s->K;
}

status condensation_factor(condensation *s, fault *f)
{
    for (int k = 0; k < s->inside.column[s->inside.n]; k++)
        s->inside.value[k] = s->K.value[s->from[k]];
    s->factorisations++;
    return factor_numeric(s->factor, &s->inside, f);
}

static void note(const mesh_element *el, int number[])
{
    for (int k = 0; k < el->columns; k++)
        if (el->index[k] != NONE)
            number[el->index[k]] = 0;
}

static int condensation_number(condensation *s, int count, const int released[])
{
    const model *m = s->m;
    int ends = 0;
    for (int i = 0; i < s->all; i++)
        s->number[i] = NONE;
    for (int i = 0; i < s->members; i++)
        note(&s->member[i].ends, s->number);
    for (int i = 0; i < model_discretes(m); i++)
        note(&model_discrete(m, i)->el, s->number);
    for (int i = 0; i < s->all; i++)
        if (s->number[i] != NONE)
            s->number[i] = ends++;
    s->unknown = malloc(((size_t)ends + 1) * sizeof *s->unknown);
    for (int i = 0; i < s->all && s->unknown != NULL; i++) {
        int unknown = i < model_unknowns(m);
        for (int k = 0; k < count; k++)
            unknown |= released[k] == i;
        if (s->number[i] != NONE && unknown)
            s->unknown[s->unknowns++] = i;
    }
    return ends;
}

static void couple(const condensation *s, const mesh_element *el, int ends, char coupled[])
{
    for (int i = 0; i < el->columns; i++)
        for (int k = 0; k < el->columns; k++)
            if (el->index[i] != NONE && el->index[k] != NONE)
                coupled[s->number[el->index[k]] * ends + s->number[el->index[i]]] = 1;
}

static status pattern_of(const condensation *s, int count, const int list[], int ends,
                         const char coupled[], int own, sparse *out, fault *f)
{
    size_t entries = 0;
    for (int j = 0; j < count; j++)
        for (int i = 0; i < count; i++)
            entries += coupled[s->number[list[j]] * ends + s->number[list[i]]];
    out->n = own ? count : s->all;
    out->column = calloc((size_t)out->n + 1, sizeof *out->column);
    out->row = malloc((entries + 1) * sizeof *out->row);
    out->value = calloc(entries + 1, sizeof *out->value);
    if (out->column == NULL || out->row == NULL || out->value == NULL)
        return fault_memory(f, "the ends of members");
    int at = 0, done = 0;
    for (int j = 0; j < count; j++) {
        const int column = own ? j : list[j];
        for (; done <= column; done++)
            out->column[done] = at;
        for (int i = 0; i < (out->symmetric ? j + 1 : count); i++)
            if (coupled[s->number[list[j]] * ends + s->number[list[i]]])
                out->row[at++] = own ? i : list[i];
    }
    for (; done <= out->n; done++)
        out->column[done] = at;
    return STATUS_OK;
}

static status find_sources(condensation *s, fault *f)
{
    const sparse *a = &s->inside;
    s->from = malloc(((size_t)a->column[a->n] + 1) * sizeof *s->from);
    if (s->from == NULL)
        return fault_memory(f, "the ends of members");
    for (int j = 0; j < a->n; j++)
        for (int k = a->column[j]; k < a->column[j + 1]; k++) {
            int at = s->K.column[s->unknown[j]];
            while (s->K.row[at] != s->unknown[a->row[k]])
                at++;
            s->from[k] = at;
        }
    return STATUS_OK;
}

static status patterns_with(condensation *s, int ends, char coupled[], int list[], fault *f)
{
    for (int i = 0; i < s->members; i++)
        couple(s, &s->member[i].ends, ends, coupled);
    for (int i = 0; i < model_discretes(s->m); i++)
        couple(s, &model_discrete(s->m, i)->el, ends, coupled);
    for (int i = 0; i < ends; i++)
        coupled[i * ends + i] = 1;
    for (int i = 0; i < s->all; i++)
        if (s->number[i] != NONE)
            list[s->number[i]] = i;
    TRY(pattern_of(s, ends, list, ends, coupled, 0, &s->K, f));
    TRY(pattern_of(s, s->unknowns, s->unknown, ends, coupled, 1, &s->inside, f));
    return find_sources(s, f);
}

static status condensation_patterns(condensation *s, int ends, fault *f)
{
    char *coupled = calloc((size_t)ends * (size_t)ends + 1, 1);
    int *list = calloc((size_t)ends + 1, sizeof *list);
    status outcome = STATUS_FAULT;
    if (coupled != NULL && list != NULL)
        outcome = patterns_with(s, ends, coupled, list, f);
    else
        fault_memory(f, "the ends of members");
    free(coupled);
    free(list);
    return outcome;
}
