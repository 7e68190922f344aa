#include "cases/shared/thrown.h"

thrown thrown_add(scene *s, const thrown_rod *of)
{
    const double k = 1e4 * of->stiffening, *F = of->force, *M = of->moment;
    const section_spec spec = timed_profile(&(timed_section){.EA = k,
                                                             .GA = k,
                                                             .GJ = of->bending,
                                                             .EI = of->bending,
                                                             .mass = 1,
                                                             .polar = 20,
                                                             .rotary = 10});
    thrown out;
    const int profile = scene_add_section(s, &spec);
    out.A = scene_add_node(s, of->A[0], of->A[1], of->A[2]);
    out.B = scene_add_node(s, 6, 0, 0);
    scene_add_member(s, out.A, out.B, profile, of->y);
    out.load[0] = scene_add_load(s, SCENE_FORCE, out.B, F[0], F[1], F[2]);
    out.load[1] = scene_add_load(s, SCENE_MOMENT, out.B, M[0], M[1], M[2]);
    return out;
}
