#include "harness/analysis/analysis_impl.h"

#include <stdlib.h>

static status no_memory(fault *f)
{
    return fault_memory(f, "a state space");
}

status second_order_triplets(int rows, int columns, const double value[], triplets *out, fault *f)
{
    double *turned = calloc((size_t)rows * (size_t)columns + 1, sizeof *turned);
    if (turned == NULL)
        return no_memory(f);
    for (size_t i = 0; i < (size_t)rows; i++)
        for (size_t j = 0; j < (size_t)columns; j++)
            turned[j * (size_t)rows + i] = value[i * (size_t)columns + j];
    const status outcome = triplets_of_columns(rows, columns, turned, out, f);
    free(turned);
    return outcome;
}

status second_order_take(const second_order *m, int outputs, linear_model *out, fault *f)
{
    const int N = m->n + m->motions;
    TRY(second_order_triplets(N, N, m->K, &out->K, f));
    TRY(second_order_triplets(N, N, m->C, &out->C, f));
    TRY(second_order_triplets(N, N, m->M, &out->M, f));
    TRY(second_order_triplets(N, m->inputs, m->B, &out->B, f));
    for (int i = 0; i < 3; i++)
        TRY(second_order_triplets(outputs, N, m->L[i], &out->L[i], f));
    return second_order_triplets(outputs, m->inputs, m->D, &out->D, f);
}

static int input_of(const system_matrices *s, int load, int reference)
{
    int i = 0;
    while (s->input[i].load != load || s->input[i].reference != reference)
        i++;
    return i;
}

static status close_loops(const vibration *v, const system_matrices *s, int inputs,
                          state_space *space, fault *f)
{
    state_space_loop *loop = calloc((size_t)v->loops + 1, sizeof *loop);
    if (loop == NULL)
        return no_memory(f);
    for (int l = 0; l < v->loops; l++) {
        const scene_feedback *b = v->loop[l].gains;
        const int load = v->loop[l].load, first = s->outputs + 2 * l;
        loop[l] =
            (state_space_loop){.input = input_of(s, load, 0),
                               .measured = first,
                               .rate = first + 1,
                               .reference = input_of(s, load, 1),
                               .times = scene_acting_factor(v->c->scene, v->c->eq.loading.acting,
                                                            v->c->scene->load[load].load_case),
                               .proportional = b->proportional,
                               .derivative = b->derivative,
                               .integral = b->integral};
    }
    const status outcome = state_space_close(space, inputs, s->outputs, v->loops, loop, f);
    free(loop);
    return outcome;
}

status second_order_state_space(const vibration *v, const system_matrices *of,
                                const second_order *m, int reduced, linear_model *out, fault *f)
{
    const analysis_context *c = v->c;
    state_space s = {0};
    fault why = {""};
    status outcome = state_space_of(m, &s, &why);
    if (outcome == STATUS_OK && v->loops > 0)
        outcome = close_loops(v, of, m->inputs, &s, &why);
    if (outcome != STATUS_OK && s.improper >= of->outputs)
        fault_set(
            f, outcome,
            "state space: %s (feedback) has a derivative gain, but the measured coordinate follows "
            "an input immediately, without a mass between them; add a mass there",
            scene_called(c->scene, SCENE_LOADS, v->loop[(s.improper - of->outputs) / 2].load).text);
    else if (outcome != STATUS_OK && s.improper >= 0 && reduced)
        fault_set(f, outcome,
                  "--reduce %.60s: quantity %s has no state space if modes of coordinates without "
                  "mass are included; give fewer modes",
                  c->options->reduce, c->scene->quantity[of->output[s.improper].quantity].name);
    else if (outcome != STATUS_OK && s.improper >= 0)
        fault_set(f, outcome, "state space: quantity %s: %s; remove it, or add a mass",
                  c->scene->quantity[of->output[s.improper].quantity].name, why.text);
    else if (outcome != STATUS_OK && reduced)
        fault_set(f, outcome, "--reduce %.60s: %s; give fewer modes", c->options->reduce, why.text);
    else if (outcome != STATUS_OK)
        fault_set(f, outcome, "state space: %s", why.text);
    if (outcome == STATUS_OK)
        outcome = second_order_triplets(s.states, s.states, s.A, &out->state.A, f);
    if (outcome == STATUS_OK)
        outcome = second_order_triplets(s.states, m->inputs, s.B, &out->state.B, f);
    if (outcome == STATUS_OK)
        outcome = second_order_triplets(of->outputs, s.states, s.C, &out->state.C, f);
    if (outcome == STATUS_OK)
        outcome = second_order_triplets(of->outputs, m->inputs, s.D, &out->state.D, f);
    out->loops = v->loops;
    out->eliminated = s.eliminated;
    state_space_free(&s);
    return outcome;
}
