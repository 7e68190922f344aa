/* Momentum of the whole structure during a motion, or its angular momentum about the origin. */
#include "cases/scene/scene.h"

static const entry_field fields[] = {
    QUANTITY_ANALYSIS,
    {"component", ENTRY_WORD, .needed = 1, .words = "px|py|pz|lx|ly|lz",
     .summary = "p: linear; l: angular, about the origin",
     ENTRY_IN(scene_quantity, what.of.balance), .first = SCENE_PX, .turns = ENTRY_COMPONENT},
    QUANTITY_TAKEN,
    {.name = NULL}};

static const char *unit(const scene *s, const scene_quantity *q)
{
    (void)s;
    return q->what.of.balance < SCENE_LX ? "kg m/s" : "kg m^2/s";
}

static void meaning(FILE *to, const scene *s, const scene_quantity *q)
{
    (void)s;
    const int component = (int)q->what.of.balance - (int)SCENE_PX;
    fprintf(to, component < SCENE_RX ? "momentum along %c" : "angular momentum about the %c axis",
            meaning_axis(component));
}

static double read(const scene_quantity *q, const quantity_state *state)
{
    return state->balance(state, q->what.of.balance);
}

const quantity_type quantity_momentum = {.key = "momentum",
                                         .summary = "momentum of the structure during a motion",
                                         .kind = SCENE_BALANCE,
                                         .field = fields,
                                         .analyses = 1u << SCENE_MOTION,
                                         .between = 1,
                                         .unit = unit,
                                         .meaning = meaning,
                                         .read = read};
