#include "harness/formulations/gather.h"

#include <stdlib.h>
#include <string.h>

enum { ENOUGH = 1 << 24 }; /* bytes of answers, from which on no further element is added */

static int make_room(gather *g)
{
    const int room = g->room > 0 ? 2 * g->room : 256;
    const size_t count = (size_t)room, nodes = (size_t)g->nodes;
    const element_data **data = realloc(g->data, count * sizeof(void *));
    if (data == NULL)
        return 0;
    g->data = data;
    node_state *x = realloc(g->x, count * nodes * sizeof *x);
    if (x == NULL)
        return 0;
    g->x = x;
    double *answer = realloc(g->answer, count * g->size * sizeof *answer);
    if (answer == NULL)
        return 0;
    g->answer = answer;
    g->room = room;
    return 1;
}

const double *gather_next(gather *g, const element_data *own, const node_state x[])
{
    if (g->answered)
        return g->answer + (size_t)g->next++ * g->size;
    if (g->failed || (g->count == g->room && !make_room(g))) {
        g->failed = 1;
        return NULL;
    }
    g->data[g->count] = own;
    memcpy(g->x + (size_t)g->count * (size_t)g->nodes, x, (size_t)g->nodes * sizeof *x);
    g->count++;
    return NULL;
}

static int is_full(const gather *g)
{
    return g->failed || (size_t)g->count * g->size * sizeof *g->answer > ENOUGH;
}

/* start[i]: the first state of element i; one that fails does not take all of its own. */
static void hand_out(gather *g, const int start[], int first, int end, gather_element *element,
                     gather_evaluate *evaluate, void *context)
{
    for (int k = 0; k < g->count && !g->failed; k += GATHER_TOGETHER)
        evaluate(context, g, k, g->count - k < GATHER_TOGETHER ? g->count - k : GATHER_TOGETHER);
    g->answered = 1;
    for (int i = first; i < end; i++) {
        g->next = start[i];
        element(context, g->failed ? NULL : g, i);
    }
    g->answered = g->count = g->failed = 0;
}

void gather_run(int count, int nodes, size_t size, gather_element *element,
                gather_evaluate *evaluate, void *context)
{
    gather g = {.nodes = nodes, .size = size};
    int first = 0, *start = malloc((size_t)count * sizeof *start);
    for (int i = 0; i < count && start == NULL; i++)
        element(context, NULL, i);
    for (int i = 0; i < count && start != NULL; i++) {
        start[i] = g.count;
        element(context, &g, i);
        if (i + 1 < count && !is_full(&g))
            continue;
        hand_out(&g, start, first, i + 1, element, evaluate, context);
        first = i + 1;
    }
    free(start);
    free(g.data);
    free(g.x);
    free(g.answer);
}
