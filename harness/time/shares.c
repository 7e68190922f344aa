#include "harness/time/shares.h"

#include <string.h>

#include "elements/math/vec3.h"
#include "elements/shared/lumped.h"
#include "harness/model/model.h"
#include "harness/time/forms.h"
#include "harness/time/inertia.h"
#include "harness/time/spread.h"
#include "harness/time/vertex_rates.h"

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
    for (int i = 0; i < model_elements(m); i++) {
        const mesh_element *el = model_element(m, i);
        double taken[ELEMENT_MAX_COORDINATES], rho[3];
        for (int k = 0, known = 0; k < el->nodes; k++) {
            if (model_vertex(m, el->vertex[k])->body != node)
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
    carried_masses all;
    double place[3], rho[3];
    TRY(motion->spread ? carried_alloc_spread(m, &all, f) : carried_alloc(m, &all, f));
    kinematics_position(m, s, node, place);
    if (motion->spread)
        add_spread(m, s, motion, node, place, F);
    for (int k = 0; k < all.masses; k++) {
        const int frame = all.mass[k].frame;
        double one[6];
        if (model_vertex(m, frame)->body != node)
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
    const mesh_element *el = model_element(m, element);
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
    F[6] = el->warp[k] != NONE ? warping * motion->a[model_warp(m, el->warp[k])] : 0;
}

/* Forces per length at the nodes, interpolated between them. */
void shares_along(const model *m, const model_state *s, const shares_motion *motion, int element,
                  double density[ELEMENT_MAX_NODES][6])
{
    const mesh_element *el = model_element(m, element);
    const double *part = motion->spread ? lumped_shares(el->nodes) : el->share;
    for (int k = 0; k < el->nodes; k++) {
        carried_mass share;
        double F[7];
        force_of(m, s, motion, element, k, F, &share);
        for (int i = 0; i < 6; i++)
            density[k][i] = share.mass > 0 ? F[i] / (part[k] * model_kind(m, el->kind)->length) : 0;
    }
}

/* Nodes that carry what lies along a member have its shifts right, and its resultants but for what
 * is within an element: F of the whole element's mass at both its nodes. */
static void add_couple(const model *m, const model_state *s, int element, double F[2][7],
                       double ends[2][7])
{
    const mesh_element *el = model_element(m, element);
    double place[2][3], moment[3];
    for (int e = 0; e < 2; e++)
        kinematics_position(m, s, el->vertex[e], place[e]);
    for (int e = 0; e < 2; e++) {
        const double c = el->couple[e],
                     other[3] = {place[!e][0] - place[e][0], place[!e][1] - place[e][1],
                                 place[!e][2] - place[e][2]};
        vec3_cross(other, F[e], moment);
        for (int i = 0; i < 3; i++) {
            ends[e][i] += c * (F[!e][i] - F[e][i]);
            ends[e][3 + i] += c * moment[i];
        }
    }
}

void shares_ends(const model *m, const model_state *s, const shares_motion *motion, int element,
                 double ends[2][7])
{
    const mesh_element *el = model_element(m, element);
    double whole[2][7];
    for (int e = 0; e < 2; e++) {
        const int k = e ? el->nodes - 1 : 0;
        carried_mass share;
        double F[7];
        force_of(m, s, motion, element, k, F, &share);
        for (int i = 0; i < 7; i++) {
            ends[e][i] += F[i];
            whole[e][i] = F[i] / el->share[k];
        }
    }
    if (el->nodes == 2 && !motion->spread)
        add_couple(m, s, element, whole, ends);
}
