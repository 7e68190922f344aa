#include "harness/inertia/shares.h"

#include <string.h>

#include "elements/math/vec3.h"
#include "harness/inertia/forms.h"
#include "harness/inertia/inertia.h"
#include "harness/inertia/spread.h"
#include "harness/inertia/vertex_rates.h"
#include "harness/model/kinematics.h"
#include "harness/model/model_impl.h"

static void add_at(const double rho[3], const double F[6], double out[6])
{
    double moment[3];
    vec3_cross(rho, F, moment);
    for (int i = 0; i < 6; i++)
        out[i] += F[i] + (i < 3 ? 0 : moment[i - 3]);
}

/* Of elements that spread their mass, at the nodes that a body moves. */
static void add_spread(const model *m, const model_state *s, const shares_motion *motion, int node,
                       const double place[3], double F[6])
{
    for (int i = 0; i < m->elements; i++) {
        const mesh_element *el = &m->element[i];
        double taken[ELEMENT_MAX_COORDINATES], rho[3];
        for (int k = 0, known = 0; k < el->nodes; k++) {
            if (m->vertex[el->vertex[k]].body != node)
                continue;
            if (!known++)
                spread_force(m, i, s, motion->v, motion->a, taken);
            kinematics_position(m, s, el->vertex[k], rho);
            for (int c = 0; c < 3; c++)
                rho[c] -= place[c];
            add_at(rho, taken + NODE_COORDINATES * k, F);
        }
    }
}

status shares_node(const model *m, const model_state *s, const shares_motion *motion, int node,
                   double F[6], fault *f)
{
    carried all;
    double place[3], rho[3];
    TRY(motion->spread ? carried_alloc_spread(m, &all, f) : carried_alloc(m, &all, f));
    kinematics_position(m, s, node, place);
    if (motion->spread)
        add_spread(m, s, motion, node, place, F);
    for (int k = 0; k < all.masses; k++) {
        const int frame = all.mass[k].frame;
        double one[6];
        if (m->vertex[frame].body != node)
            continue;
        inertia_force(m, &all.mass[k], s, motion->v, motion->a, one);
        kinematics_position(m, s, frame, rho);
        for (int i = 0; i < 3; i++)
            rho[i] -= place[i];
        add_at(rho, one, F);
    }
    carried_free(&all);
    return STATUS_OK;
}

/* Of node k of an element, with its warping; *share: of the mass. */
static void force_of(const model *m, const model_state *s, const shares_motion *motion, int element,
                     int k, double F[7], carried_mass *share)
{
    const mesh_element *el = &m->element[element];
    double taken[ELEMENT_MAX_COORDINATES], warping;
    frame_rates r;
    carried_share(m, el, k, share, &warping);
    if (motion->spread) {
        spread_force(m, element, s, motion->v, motion->a, taken);
        memcpy(F, taken + NODE_COORDINATES * k, 7 * sizeof *F);
        return;
    }
    vertex_rates(m, s, el->vertex[k], motion->v, motion->a, &r);
    inertia_force_at(share, &r, F);
    F[6] = el->warp[k] != NONE ? warping * motion->a[m->warp[el->warp[k]].coordinate] : 0;
}

/* The share of node k lies evenly along its share of the length, which is that of the mass. */
void shares_along(const model *m, const model_state *s, const shares_motion *motion, int element,
                  double density[ELEMENT_MAX_NODES][6])
{
    const mesh_element *el = &m->element[element];
    carried_mass share[ELEMENT_MAX_NODES];
    double whole = 0, F[ELEMENT_MAX_NODES][7];
    for (int k = 0; k < el->nodes; k++) {
        force_of(m, s, motion, element, k, F[k], &share[k]);
        whole += share[k].mass;
    }
    for (int k = 0; k < el->nodes; k++)
        for (int i = 0; i < 6; i++)
            density[k][i] = share[k].mass > 0
                                ? F[k][i] * (whole / share[k].mass / m->kind[el->kind].length)
                                : 0;
}

void shares_ends(const model *m, const model_state *s, const shares_motion *motion, int element,
                 double ends[2][7])
{
    for (int e = 0; e < 2; e++) {
        carried_mass share;
        double F[7];
        force_of(m, s, motion, element, e ? m->element[element].nodes - 1 : 0, F, &share);
        for (int i = 0; i < 7; i++)
            ends[e][i] += F[i];
    }
}
