/* Closes feedback loops around a state-space form x' = A x + B w. For each loop, the factor u = Kp
 * (r - y) + Kd (r' - y') + Ki z, with z' = r - y, is multiplied by `times` and added to its input.
 * The references r are states, and their rates are inputs. */
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "harness/numerics/numerics.h"

static status no_memory(fault *f)
{
    return fault_memory(f, "a state space");
}

/* Sizes, and the factors of all loops as functions of states, references, integrals and inputs. */
typedef struct closing {
    const state_space *of;
    const state_space_loop *loop;
    int loops, inputs;
    size_t wide; /* length of the rows: states + 2 loops + inputs */
    double *u;   /* [loops x wide] */
} closing;

/* Adds to the row to[wide] row y of the outputs of the open loops, multiplied by `times`. */
static void add_output(const closing *c, int y, double times, double to[])
{
    const size_t states = (size_t)c->of->states, inputs = (size_t)c->inputs;
    for (size_t j = 0; j < states; j++)
        to[j] += times * c->of->C[(size_t)y * states + j];
    for (size_t j = 0; j < inputs; j++)
        to[states + 2 * (size_t)c->loops + j] += times * c->of->D[(size_t)y * inputs + j];
}

/* Adds to the row to[wide] the contribution of the loops through the inputs, multiplied by `times`.
 * by_input: row of B or D [inputs]. */
static void add_loops(const closing *c, const double by_input[], double times, double to[])
{
    for (int l = 0; l < c->loops; l++)
        for (size_t j = 0; j < c->wide; j++)
            to[j] += times * by_input[c->loop[l].input] * c->loop[l].times *
                     c->u[(size_t)l * c->wide + j];
}

/* Solves (1 + Kp D + Kd D') u = ... for the factors, which may act instantaneously on the measured
 * outputs. */
static status find_factors(closing *c, fault *f)
{
    const size_t loops = (size_t)c->loops, states = (size_t)c->of->states;
    double *own = calloc(loops * loops + 1, sizeof *own);
    int *pivot = calloc(loops + 1, sizeof *pivot), singular = 1;
    if (own != NULL && pivot != NULL) {
        for (size_t l = 0; l < loops; l++) {
            const state_space_loop *one = &c->loop[l];
            double *u = c->u + l * c->wide;
            add_output(c, one->measured, -one->proportional, u);
            if (one->derivative != 0)
                add_output(c, one->rate, -one->derivative, u);
            for (size_t k = 0; k < loops; k++)
                own[l * loops + k] =
                    (l == k) - c->loop[k].times * u[states + 2 * loops + (size_t)c->loop[k].input];
            u[states + l] += one->proportional;
            u[states + loops + l] += one->integral;
            u[states + 2 * loops + (size_t)one->reference] += one->derivative;
        }
        singular = dense_lu_regular(c->loops, own, pivot);
        if (!singular)
            dense_lu_solve(c->loops, (int)c->wide, own, pivot, c->u);
    }
    const int enough = own != NULL && pivot != NULL;
    free(own);
    free(pivot);
    return !enough    ? no_memory(f)
           : singular ? fault_set(f, STATUS_REFUSED,
                                  "a feedback loop acts immediately on the coordinate that it "
                                  "measures, and its gain leaves the factor of its load "
                                  "undetermined; change the gain, or add a mass")
                      : STATUS_OK;
}

static int position(const closing *c, int loop)
{
    int at = c->of->states + c->loops;
    for (int l = 0; l < loop; l++)
        at += c->loop[l].integral != 0;
    return at;
}

static void keep_row(const closing *c, const double row[], double A[], double B[])
{
    const size_t known = (size_t)c->of->states + (size_t)c->loops;
    memcpy(A, row, known * sizeof *A);
    for (int l = 0; l < c->loops; l++)
        if (c->loop[l].integral != 0)
            A[position(c, l)] = row[known + (size_t)l];
    memcpy(B, row + known + (size_t)c->loops, (size_t)c->inputs * sizeof *B);
}

static void fill(const closing *c, int outputs, double row[], state_space *out)
{
    const size_t was = (size_t)c->of->states, loops = (size_t)c->loops, inputs = (size_t)c->inputs,
                 states = (size_t)out->states;
    for (size_t i = 0; i < was; i++) {
        memset(row, 0, c->wide * sizeof *row);
        memcpy(row, c->of->A + i * was, was * sizeof *row);
        memcpy(row + was + 2 * loops, c->of->B + i * inputs, inputs * sizeof *row);
        add_loops(c, c->of->B + i * inputs, 1, row);
        keep_row(c, row, out->A + i * states, out->B + i * inputs);
    }
    for (int l = 0; l < c->loops; l++) {
        const size_t at = (size_t)position(c, l);
        out->B[(was + (size_t)l) * inputs + (size_t)c->loop[l].reference] = 1;
        if (c->loop[l].integral == 0)
            continue;
        memset(row, 0, c->wide * sizeof *row);
        row[was + (size_t)l] = 1;
        add_output(c, c->loop[l].measured, -1, row);
        add_loops(c, c->of->D + (size_t)c->loop[l].measured * inputs, -1, row);
        keep_row(c, row, out->A + at * states, out->B + at * inputs);
    }
    for (int y = 0; y < outputs; y++) {
        memset(row, 0, c->wide * sizeof *row);
        add_output(c, y, 1, row);
        add_loops(c, c->of->D + (size_t)y * inputs, 1, row);
        keep_row(c, row, out->C + (size_t)y * states, out->D + (size_t)y * inputs);
    }
}

status state_space_close(state_space *s, int inputs, int outputs, int loops,
                         const state_space_loop loop[], fault *f)
{
    closing c = {.of = s, .loop = loop, .loops = loops, .inputs = inputs};
    state_space out = {.eliminated = s->eliminated, .improper = -1};
    out.states = position(&c, loops);
    c.wide = (size_t)s->states + 2 * (size_t)loops + (size_t)inputs;
    const size_t states = (size_t)out.states;
    double *row = calloc(c.wide + 1, sizeof *row);
    c.u = calloc((size_t)loops * c.wide + 1, sizeof *c.u);
    out.A = calloc(states * states + 1, sizeof *out.A);
    out.B = calloc(states * (size_t)inputs + 1, sizeof *out.B);
    out.C = calloc((size_t)outputs * states + 1, sizeof *out.C);
    out.D = calloc((size_t)outputs * (size_t)inputs + 1, sizeof *out.D);
    status outcome = row != NULL && c.u != NULL && out.A != NULL && out.B != NULL &&
                             out.C != NULL && out.D != NULL
                         ? find_factors(&c, f)
                         : no_memory(f);
    if (outcome == STATUS_OK) {
        fill(&c, outputs, row, &out);
        state_space_free(s);
        *s = out;
    } else {
        state_space_free(&out);
    }
    free(row);
    free(c.u);
    return outcome;
}
