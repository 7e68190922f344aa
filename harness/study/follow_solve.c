#include <string.h>

#include "harness/study/follow_impl.h"

/* Frequencies as quantities of the first modal analysis: its index, and how many; 0: none. */
static int count_wanted(const scene *s, int *analysis)
{
    int count = 0;
    for (*analysis = 0; *analysis < s->analyses; ++*analysis)
        if (s->analysis[*analysis].kind == SCENE_MODAL)
            break;
    for (int i = 0; i < s->quantities; i++)
        count += scene_asks(&s->quantity[i], *analysis, SCENE_FREQUENCY);
    return *analysis < s->analyses ? count : 0;
}

static status solve_at(follow_walk *w, double value, cell_result *cell,
                       const state_matrices **state, fault *f)
{
    cell_request request = w->of->cell;
    scene own;
    request.parameter[w->of->parameter] = value;
    request.solve.systems = 1;
    memset(cell, 0, sizeof *cell);
    const status built = cell_scene(request.type, request.parameter, NULL, &own, f);
    status outcome = built;
    if (built == STATUS_OK) {
        if (w->out->modes == 0)
            w->out->modes = count_wanted(&own, &w->analysis);
        request.scene = &own;
        outcome = cell_run(&request, cell, f);
    }
    scene_free(&own);
    TRY(outcome);
    for (int i = 0; i < cell->solve.systems.states; i++)
        if (cell->solve.systems.state[i].analysis == w->analysis)
            *state = &cell->solve.systems.state[i];
    if (*state == NULL || w->out->modes == 0)
        return fault_set(f, STATUS_REFUSED,
                         "no modes to follow: the scene has no modal analysis with frequencies as "
                         "quantities");
    return STATUS_OK;
}

status follow_solve(follow_walk *w, double value, const follow_shapes *before, follow_shapes *out,
                    double *least, fault *f)
{
    cell_result cell;
    const state_matrices *state = NULL;
    memset(out, 0, sizeof *out);
    *least = 1;
    status outcome = solve_at(w, value, &cell, &state, f);
    if (outcome == STATUS_OK && before == NULL) {
        w->out->modes = w->out->modes < state->modes ? w->out->modes : state->modes;
        outcome = follow_match_first(state, w->out->modes, out, f);
    } else if (outcome == STATUS_OK) {
        outcome = follow_match_next(before, state, out, least, f);
    }
    cell_result_free(&cell);
    return outcome;
}
