#include "harness/experiments/specimen.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/arc.h"
#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "harness/formulations/formulations.h"

enum { SETTLING = 30 };

static int fits(const specimen *s)
{
    return s->inner <= SPECIMEN_INNER && s->memory <= SPECIMEN_MEMORY;
}

status specimen_make(const specimen_request *what, specimen *out, fault *f)
{
    memset(out, 0, sizeof *out);
    out->made = *what;
    memcpy(out->options, what->options, sizeof out->options);
    TRY(profiles_section(what->form, what->unit, &out->section, f));
    TRY(adapters_complete(what->given, out->options, &out->type, f));
    out->request =
        (element_request){.section = &out->section,
                          .length = (what->length > 0 ? what->length : 0.2385) / what->unit,
                          .features = what->features,
                          .options = out->options,
                          .type = what->given};
    memcpy(out->request.curvature, what->curvature, sizeof out->request.curvature);
    out->nodes = element_nodes(&out->type, out->options);
    out->strains = element_strains(&out->type, out->options);
    out->inner = element_inner(&out->type, out->options);
    out->memory = element_memory(&out->type, out->options);
    out->coordinates = NODE_COORDINATES * out->nodes;
    if (!fits(out))
        return fault_set(f, STATUS_FAULT,
                         "%d unknowns of its own with %d doubles of memory are "
                         "more than the checks have room for (%d and %d)",
                         out->inner, out->memory, SPECIMEN_INNER, SPECIMEN_MEMORY);
    out->size = out->type.data_size(&out->request);
    out->data = calloc(1, out->size > 0 ? out->size : 1);
    if (out->data == NULL)
        return fault_set(f, STATUS_FAULT, "data_size asks for %zu bytes, which there are not",
                         out->size);
    return out->type.prepare(&out->request, out->data, f);
}

void specimen_free(specimen *s)
{
    free(s->data);
    s->data = NULL;
}

unsigned specimen_features(const element_type *t, unsigned without)
{
    return t->offers & ~(unsigned)(FEATURE_CURVATURE | FEATURE_COUPLED) & ~without;
}

/* splitmix64 (Steele, Lea, Flood, OOPSLA 2014). */
static double number(unsigned long long *state)
{
    unsigned long long z = (*state += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return (double)((z ^ (z >> 31)) >> 11) / 9007199254740992.0 - 0.5;
}

void specimen_numbers(int count, unsigned seed, double out[])
{
    unsigned long long state = seed;
    for (int i = 0; i < count; i++)
        out[i] = number(&state);
}

/* Along the arc of its initial curvature. */
static void at_rest(const specimen *s, node_state x[])
{
    static const double ahead[3] = {1, 0, 0};
    const double length = s->request.length;
    double turn[3], q[4];
    for (int i = 0; i < 3; i++)
        turn[i] = s->request.curvature[i] * length;
    for (int k = 0; k < s->nodes; k++) {
        memset(&x[k], 0, sizeof x[k]);
        arc_at(turn, ahead, (double)k / (s->nodes - 1), x[k].r, q);
        rotation_matrix(q, x[k].R);
        for (int i = 0; i < 3; i++)
            x[k].r[i] *= length;
    }
}

void specimen_state(const specimen *s, double size, unsigned seed, node_state x[])
{
    double step[SPECIMEN_COORDINATES];
    node_state rest[ELEMENT_MAX_NODES];
    at_rest(s, rest);
    specimen_numbers(s->coordinates, seed, step);
    for (int i = 0; i < s->coordinates; i++)
        step[i] *= size * chart_unit(i, s->request.length);
    chart_move(rest, s->nodes, step, x);
}

void specimen_carry(const specimen *s, const double turn[3], const node_state x[], node_state out[])
{
    static const double shift[3] = {0.317, -1.21, 2.37}; /* [lengths] */
    double q[4], R[9];
    rotation_exp(turn, q);
    rotation_matrix(q, R);
    for (int k = 0; k < s->nodes; k++) {
        out[k] = x[k];
        mat3_mul_vec(R, x[k].r, out[k].r);
        mat3_mul(R, x[k].R, out[k].R);
        for (int i = 0; i < 3; i++) {
            out[k].r[i] += shift[i] * s->request.length;
            out[k].u[i] = out[k].r[i] - (x[k].r[i] - x[k].u[i]);
        }
    }
}

void specimen_moved(const specimen_place *at, int i, double si, int j, double sj, node_state out[])
{
    double step[SPECIMEN_COORDINATES] = {0};
    step[i] += si * chart_unit(i, at->s->request.length);
    step[j] += sj * chart_unit(j, at->s->request.length);
    chart_move(at->x, at->s->nodes, step, out);
}

void specimen_rest(const specimen *s, double inner[])
{
    memset(inner, 0, (size_t)s->inner * sizeof *inner);
    if (s->type.rest != NULL)
        s->type.rest(s->data, inner);
}

status specimen_settled(const specimen *s, const double e[], double inner[], stress_output *out)
{
    double memory[SPECIMEN_MEMORY], residual = 1;
    const double none[SPECIMEN_STRAINS] = {0};
    for (int i = 0; i < SETTLING && s->inner > 0 && s->type.update != NULL; i++) {
        TRY(s->type.stress(s->data, e, inner,
                           &(stress_output){.residual = &residual, .memory = memory}));
        if (s->type.update(s->data, none, memory, inner) < 1e-15)
            break;
    }
    out->memory = s->memory > 0 ? memory : NULL;
    const status outcome = s->type.stress(s->data, e, inner, out);
    out->memory = NULL;
    return outcome;
}

const char *specimen_coordinate(int c, char words[SPECIMEN_WORDS])
{
    const int node = c / NODE_COORDINATES + 1, k = c % NODE_COORDINATES;
    if (k < 3)
        snprintf(words, SPECIMEN_WORDS, "displacement along %c of node %d", "xyz"[k], node);
    else if (k < 6)
        snprintf(words, SPECIMEN_WORDS, "rotation about %c of node %d", "xyz"[k - 3], node);
    else
        snprintf(words, SPECIMEN_WORDS, "warping amplitude of node %d", node);
    return words;
}
