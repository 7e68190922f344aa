/* What is asked of motions, in words. */
#include "cases/format/meaning_impl.h"

void meaning_relative(FILE *to, const scene *s, const scene_relative *what)
{
    meaning_coordinate(to, s, what->node, what->component);
    meaning_node(to, s, "as seen from", what->from);
}

void meaning_rate(FILE *to, const scene *s, const scene_component *what)
{
    const int turn = what->component >= SCENE_RX;
    fputs(turn ? "angular velocity" : "velocity", to);
    meaning_node(to, s, "of", what->node);
    fprintf(to, turn ? " about its own %c axis" : " along %c", meaning_axis(what->component));
}

void meaning_orientation(FILE *to, const scene *s, const scene_orientation *what)
{
    fprintf(to, "entry %c%c of the rotation matrix", "xyz"[what->row], "xyz"[what->column]);
    meaning_node(to, s, "of", what->node);
}

void meaning_balance(FILE *to, scene_balance what)
{
    static const char *const word[SCENE_BALANCES] = {
        [SCENE_KINETIC] = "kinetic energy",
        [SCENE_STRAIN] = "strain energy, springs included",
        [SCENE_ENERGY] = "kinetic and strain energy",
        [SCENE_WORK] = "work of loads and of what is driven, since the begin",
        [SCENE_DISSIPATED] = "energy that damping took, since the begin",
        [SCENE_DRIFT] = "energy and what damping took, less energy of the begin and work",
        [SCENE_PX] = "momentum along x",
        [SCENE_PY] = "momentum along y",
        [SCENE_PZ] = "momentum along z",
        [SCENE_LX] = "angular momentum about the x axis",
        [SCENE_LY] = "angular momentum about the y axis",
        [SCENE_LZ] = "angular momentum about the z axis"};
    fputs(word[what], to);
}
