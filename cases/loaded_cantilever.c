/* A cantilever in the plane under loads of every kind: dead and following, at its tip, on an arm
 * beyond it and along it. L = 1 m, EI = 1 N m^2; EA large and finite. */
#include "cases/shared/cantilever.h"

#include <stddef.h>

enum { LOAD, SIZE, ARM, AXIAL };
enum { FOLLOWER, DEAD, PRESSURE, LINE, COUPLES, WEIGHT };

static const parameter_type parameters[] = {
    [LOAD] =
        {"load", "", FOLLOWER, 0, 0, "follower|dead|pressure|line|couples|weight",
         "transverse: force that turns with the tip; dead force; line load that turns with the "
         "sections; dead one in the member's axes; moments along it; gravity"},
    [SIZE] = {"size", "1", 3.0, -1e3, 1e3, NULL,
              "P L^2/EI; of loads along it, q L^3/EI or m L^2/EI"},
    [ARM] = {"arm", "1", 0.0, -1, 1, NULL, "of a force at the tip: how far beyond it, of L"},
    [AXIAL] = {"axial", "1", 1e8, 1e2, 1e14, NULL, "EA L^2/EI"},
    {0},
};

static status build(const double value[], scene *s, fault *f)
{
    const int load = (int)value[LOAD], member = 0;
    static const scene_load_kind kind[] = {[FOLLOWER] = SCENE_FORCE,
                                           [DEAD] = SCENE_FORCE,
                                           [PRESSURE] = SCENE_DISTRIBUTED,
                                           [LINE] = SCENE_DISTRIBUTED,
                                           [COUPLES] = SCENE_DISTRIBUTED_MOMENT,
                                           [WEIGHT] = SCENE_GRAVITY};
    const cantilever_stiffness k = {
        .EA = value[AXIAL], .GJ = 1, .EI = 1, .density = 1 / value[AXIAL]}; /* 1 kg/m */
    int root, tip;
    if (value[ARM] != 0 && kind[load] != SCENE_FORCE)
        return fault_set(
            f, STATUS_REFUSED,
            "loaded_cantilever: arm = %g of a load along the beam; only a force at the "
            "tip has one: choose load=follower or load=dead",
            value[ARM]);
    cantilever_build(1, &k, s, &root, &tip);
    scene_load *l = scene_load_at(s, kind[load] == SCENE_FORCE
                                         ? scene_add_load(s, SCENE_FORCE, tip, 0, value[SIZE], 0)
                                         : scene_add_load(s, kind[load], member, 0,
                                                          load == COUPLES ? 0 : value[SIZE],
                                                          load == COUPLES ? value[SIZE] : 0));
    l->at[0] = value[ARM];
    l->follower = load == FOLLOWER || load == PRESSURE;
    l->axes =
        load == PRESSURE || load == LINE || load == COUPLES ? SCENE_AXES_MEMBER : SCENE_AXES_FIXED;
    cantilever_bent(s, tip);
    return STATUS_OK;
}

const case_type case_loaded_cantilever = {
    .name = "loaded_cantilever",
    .summary = "cantilever under dead and following loads, at its tip and along it",
    .source = "equations of the elastica, integrated from the tip",
    .parameters = {parameters, case_omit},
    .build = build,
};
