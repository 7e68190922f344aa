#include "harness/inertia/shares.h"

#include "elements/math/vec3.h"
#include "harness/inertia/forms.h"
#include "harness/inertia/inertia.h"
#include "harness/model/kinematics.h"
#include "harness/model/model_impl.h"

static void add_at(const double rho[3], const double F[6], double out[6])
{
    double moment[3];
    vec3_cross(rho, F, moment);
    for (int i = 0; i < 6; i++)
        out[i] += F[i] + (i < 3 ? 0 : moment[i - 3]);
}

status shares_node(const model *m, const model_state *s, const double v[], const double a[],
                   int node, double F[6], fault *f)
{
    carried all;
    double place[3], rho[3];
    TRY(carried_alloc(m, &all, f));
    kinematics_position(m, s, node, place);
    for (int k = 0; k < all.masses; k++) {
        const int frame = all.mass[k].frame;
        double one[6];
        if (m->vertex[frame].body != node)
            continue;
        inertia_force(m, &all.mass[k], s, v, a, one);
        kinematics_position(m, s, frame, rho);
        for (int i = 0; i < 3; i++)
            rho[i] -= place[i];
        add_at(rho, one, F);
    }
    carried_free(&all);
    return STATUS_OK;
}

/* Velocity and acceleration of any vertex, also of one that another moves. */
static void rates_of(const model *m, const model_state *s, int vertex, const double v[],
                     const double a[], frame_rates *out)
{
    const int body = m->vertex[vertex].body;
    double rho[3], moved[3], twice[3];
    inertia_rates(m, s, vertex < m->first_release ? body : vertex, v, a, out);
    if (vertex == body || vertex >= m->first_release)
        return;
    kinematics_offset(m, s, vertex, rho);
    vec3_cross(out->w, rho, moved);
    vec3_cross(out->w, moved, twice);
    for (int i = 0; i < 3; i++) {
        out->v[i] += moved[i];
        out->a[i] += twice[i];
    }
    vec3_cross(out->wd, rho, moved);
    for (int i = 0; i < 3; i++)
        out->a[i] += moved[i];
}

/* Of node k of an element; *warping: of its amplitude [kg m^4]. */
static void force_of(const model *m, const model_state *s, const double v[], const double a[],
                     const mesh_element *el, int k, double F[6], carried_mass *share,
                     double *warping)
{
    frame_rates r;
    carried_share(m, el, k, share, warping);
    rates_of(m, s, el->vertex[k], v, a, &r);
    inertia_force_at(share, &r, F);
}

/* The share of node k lies evenly along its share of the length, which is that of the mass. */
void shares_along(const model *m, const model_state *s, const double v[], const double a[],
                  int element, double density[ELEMENT_MAX_NODES][6])
{
    const mesh_element *el = &m->element[element];
    carried_mass share[ELEMENT_MAX_NODES];
    double whole = 0, warping;
    for (int k = 0; k < el->nodes; k++) {
        force_of(m, s, v, a, el, k, density[k], &share[k], &warping);
        whole += share[k].mass;
    }
    for (int k = 0; k < el->nodes; k++)
        for (int i = 0; i < 6; i++)
            density[k][i] *=
                share[k].mass > 0 ? whole / share[k].mass / m->kind[el->kind].length : 0;
}

void shares_ends(const model *m, const model_state *s, const double v[], const double a[],
                 int element, double ends[2][7])
{
    const mesh_element *el = &m->element[element];
    for (int e = 0; e < 2; e++) {
        const int k = e ? el->nodes - 1 : 0;
        carried_mass share;
        double F[6], warping;
        force_of(m, s, v, a, el, k, F, &share, &warping);
        for (int i = 0; i < 6; i++)
            ends[e][i] += F[i];
        if (el->warp[k] != NONE)
            ends[e][6] += warping * a[m->warp[el->warp[k]].coordinate];
    }
}
