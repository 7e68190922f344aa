/* Energy of the whole structure during a motion. */
#include "cases/scene/scene.h"

static const entry_field fields[] = {
    QUANTITY_ANALYSIS,
    {"of", ENTRY_WORD, .needed = 1, .words = "kinetic|strain|energy|work|dissipated|drift",
     .summary =
         "energy-balance error: energy plus dissipated energy, minus initial energy and work",
     ENTRY_IN(scene_quantity, what.of.balance)},
    QUANTITY_TAKEN,
    {.name = NULL}};

static const char *unit(const scene *s, const scene_quantity *q)
{
    (void)s;
    (void)q;
    return "J";
}

static void meaning(FILE *to, const scene *s, const scene_quantity *q)
{
    (void)s;
    static const char *const word[] = {
        [SCENE_KINETIC] = "kinetic energy",
        [SCENE_STRAIN] = "strain energy, including springs",
        [SCENE_ENERGY] = "kinetic and strain energy",
        [SCENE_WORK] = "work of the loads and of the prescribed coordinates since the start",
        [SCENE_DISSIPATED] = "energy dissipated by damping since the start",
        [SCENE_DRIFT] = "energy plus dissipated energy, minus initial energy and work"};
    fputs(word[q->what.of.balance], to);
}

static double read(const scene_quantity *q, const quantity_state *state)
{
    return state->balance(state, q->what.of.balance);
}

const quantity_type quantity_energy = {.key = "energy",
                                       .summary = "energy of the structure during a motion",
                                       .kind = SCENE_BALANCE,
                                       .field = fields,
                                       .analyses = 1u << SCENE_MOTION,
                                       .between = 1,
                                       .unit = unit,
                                       .meaning = meaning,
                                       .read = read};
