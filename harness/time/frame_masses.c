#include "harness/time/time_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/vec3.h"
#include "elements/shared/masses.h"

/* Adds the inertia of a point mass at r to the tensor: mass (r.r 1 - r r^T). */
static void add_point(double mass, const double r[3], double tensor[9])
{
    const double square = vec3_dot(r, r);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            tensor[3 * i + j] += mass * ((i == j ? square : 0) - r[i] * r[j]);
}

/* Changes the tensor as if the mass moved by r. moment: first moment of the mass before the
 * move. */
static void shift(double mass, const double moment[3], const double r[3], double tensor[9])
{
    add_point(mass, r, tensor);
    const double mixed = 2 * vec3_dot(r, moment);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            tensor[3 * i + j] += (i == j ? mixed : 0) - r[i] * moment[j] - moment[i] * r[j];
}

static void take(const model *m, int vertex, double mass, const double moment[3],
                 const double tensor[9], frame_mass of[])
{
    const mesh_vertex *v = model_vertex(m, vertex);
    const mesh_release *r = release_of(m, vertex);
    const int released = r != NULL && r->turns + r->slides > 0;
    const double none[3] = {0, 0, 0}, *offset = released ? none : v->offset;
    frame_mass *to = &of[released ? vertex : v->body];
    double moved[9];
    memcpy(moved, tensor, sizeof moved);
    shift(mass, moment, offset, moved);
    to->mass += mass;
    for (int i = 0; i < 3; i++)
        to->moment[i] += moment[i] + mass * offset[i];
    for (int i = 0; i < 9; i++)
        to->inertia[i] += moved[i];
}

static void lump(const lumped_mass *l, double share, double moment[3], double tensor[9])
{
    memset(moment, 0, 3 * sizeof *moment);
    memset(tensor, 0, 9 * sizeof *tensor);
    for (int i = 0; i < 3; i++) {
        tensor[4 * i] = share * l->rotary[i];
        moment[i] = l->vectors > 0 ? share * l->mass * l->vector[0][i] : 0;
    }
    for (int k = 0; k < l->vectors; k++)
        add_point(share * l->carried[k], l->vector[k], tensor);
}

static void turn(const double triad[9], const double moment[3], const double tensor[9],
                 double out_moment[3], double out_tensor[9])
{
    double half[9], transposed[9];
    mat3_mul_vec(triad, moment, out_moment);
    mat3_mul(triad, tensor, half);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            transposed[3 * i + j] = triad[3 * j + i];
    mat3_mul(half, transposed, out_tensor);
}

void frame_masses_share(const model *m, const mesh_element *el, int node, frame_mass *out,
                        double *warping)
{
    const mesh_kind *kind = model_kind(m, el->kind);
    const lumped_mass whole =
        lumped_of(model_section(m, kind->section), model_features(m), kind->length);
    const double share = el->share[node];
    double moment[3], tensor[9];
    lump(&whole, share, moment, tensor);
    turn(el->triad[node], moment, tensor, out->moment, out->inertia);
    out->frame = el->vertex[node];
    out->mass = share * whole.mass;
    *warping = share * whole.warping;
}

static void add_element(const model *m, const mesh_element *el, frame_mass of[], double warping[])
{
    for (int k = 0; k < el->nodes; k++) {
        frame_mass share;
        double of_warping;
        frame_masses_share(m, el, k, &share, &of_warping);
        take(m, el->vertex[k], share.mass, share.moment, share.inertia, of);
        if (el->warp[k] != NONE)
            warping[model_warp(m, el->warp[k])] += of_warping;
    }
}

static void add_body(const model *m, const mesh_discrete *d, frame_mass of[])
{
    const scene_body *b = d->body;
    const double *J = b->inertia;
    const double none[3] = {0, 0, 0};
    double tensor[9] = {J[0], J[3], J[5], J[3], J[1], J[4], J[5], J[4], J[2]}, moment[3];
    shift(b->mass, none, b->centre, tensor);
    for (int i = 0; i < 3; i++)
        moment[i] = b->mass * b->centre[i];
    take(m, d->el.vertex[0], b->mass, moment, tensor, of);
}

/* Copies the frames that have mass or moments of inertia, and computes the total mass. */
static void keep_heavy(const model *m, frame_mass of[], frame_masses *out)
{
    for (int i = 0; i < model_vertices(m); i++) {
        double size = of[i].mass;
        for (int k = 0; k < 3; k++)
            size += of[i].inertia[4 * k];
        if (size <= 0)
            continue;
        out->total += of[i].mass;
        out->mass[out->masses] = of[i];
        out->mass[out->masses++].frame = i;
    }
}

static status alloc_empty(const model *m, int spread, frame_masses *out, fault *f)
{
    memset(out, 0, sizeof *out);
    out->spread = spread;
    out->mass = calloc((size_t)model_vertices(m) + 1, sizeof *out->mass);
    out->warping = calloc((size_t)model_all_coordinates(m) + 1, sizeof *out->warping);
    if (out->mass == NULL || out->warping == NULL) {
        frame_masses_free(out);
        return fault_memory(f, "masses");
    }
    return STATUS_OK;
}

static status alloc(const model *m, int spread, frame_masses *out, fault *f)
{
    TRY(alloc_empty(m, spread, out, f));
    for (int i = 0; i < model_elements(m) && !spread; i++)
        add_element(m, model_element(m, i), out->mass, out->warping);
    for (int i = 0; i < model_discretes(m) - model_springs(m); i++)
        add_body(m, model_discrete(m, i), out->mass);
    keep_heavy(m, out->mass, out);
    return STATUS_OK;
}

status frame_masses_alloc(const model *m, frame_masses *out, fault *f)
{
    return alloc(m, 0, out, f);
}

status frame_masses_alloc_bodies(const model *m, frame_masses *out, fault *f)
{
    return alloc(m, 1, out, f);
}

static void lead(const model *m, const frame_mass *one, frame_mass of[])
{
    const mesh_vertex *v = model_vertex(m, one->frame);
    frame_mass *to = &of[v->leader], *own = &of[one->frame];
    double moved[9];
    memcpy(moved, one->inertia, sizeof moved);
    shift(one->mass, one->moment, v->arm, moved);
    to->mass += one->mass;
    *own = (frame_mass){.mass = one->mass};
    for (int i = 0; i < 3; i++) {
        const double normal = fabs(v->axis[0][i]) > 0.5 ? one->mass : 0;
        to->moment[i] += one->moment[i] + one->mass * v->arm[i];
        to->less[i] += normal;
        own->less[i] = one->mass - normal;
    }
    for (int i = 0; i < 9; i++)
        to->inertia[i] += moved[i];
}

status frame_masses_diaphragms(const model *m, const frame_masses *all, frame_masses *out, fault *f)
{
    TRY(alloc_empty(m, all->spread, out, f));
    out->damping = all->damping;
    memcpy(out->warping, all->warping, (size_t)model_all_coordinates(m) * sizeof *out->warping);
    for (int k = 0; k < all->masses; k++)
        out->mass[all->mass[k].frame] = all->mass[k];
    for (int k = 0; k < all->masses; k++)
        if (all->mass[k].frame < model_scene(m)->nodes &&
            model_vertex(m, all->mass[k].frame)->leader != NONE)
            lead(m, &all->mass[k], out->mass);
    keep_heavy(m, out->mass, out);
    out->total = all->total;
    return STATUS_OK;
}

void frame_masses_free(frame_masses *c)
{
    free(c->mass);
    free(c->warping);
    memset(c, 0, sizeof *c);
}

/* Treats frames with both fixed and free translations. Along the fixed ones, the velocity v_c of
 * the centre, at s from the frame, follows from the rotation: it is w x s at both ends of the step.
 * The displacement dr_c of the centre then differs from that of the mean velocity: h (v_c + v_c1)/2
 * - dr_c = h/4 c x g with g = (R_n + R_1)/2 [(W1 - W) x s], where s is in the axes of the frame.
 * The moment g x m (v_c1 - v_c)/4 of the fixed components compensates the work of this difference,
 * so the gain of kinetic energy equals the work. */

static void hold_rows(const frame_mass_step *p, int n, const double from[], double to[])
{
    for (int k = 0; k < n; k++) {
        const double x[3] = {to[k], to[n + k], to[2 * n + k]};
        for (int i = 0; i < 3; i++) {
            to[i * n + k] = 0;
            for (int j = 0; j < 3; j++)
                to[i * n + k] +=
                    ((i == j) - p->held[3 * i + j]) * x[j] + p->held[3 * i + j] * from[j * n + k];
        }
    }
}

void frame_mass_step_follow(const frame_mass *one, frame_mass_step *p)
{
    double w1[3], swept[3], change[3], crossed[3], before[3], apart[3];
    if (!p->partly_fixed)
        return;
    mat3_mul_vec(p->R1, p->W1, w1);
    vec3_cross(w1, p->after, swept);
    hold_rows(p, 1, swept, p->v1);
    for (int i = 0; i < 3; i++) {
        apart[i] = one->mass * (p->v1[i] - p->v0[i]) / 4;
        p->behind[i] = 0;
    }
    hold_rows(p, 1, apart, p->behind);
    for (int i = 0; i < 3; i++) {
        change[i] = p->W1[i] - p->W0[i];
    }
    vec3_cross(change, p->centre, crossed);
    mat3_mul_vec(p->Rn, crossed, before);
    mat3_mul_vec(p->R1, crossed, p->turned);
    for (int i = 0; i < 3; i++)
        p->g[i] = (before[i] + p->turned[i]) / 2;
    vec3_cross(p->g, p->behind, p->late);
}

/* Computes out = d(w1 x after)/dc. */
static void riding(const frame_mass_step *p, double h, const double T[9], const double swept[9],
                   double out[9])
{
    double w1[3], W[9], A[9], turn[9], spin[9], arm[9], moved[9];
    mat3_mul_vec(p->R1, p->W1, w1);
    cayley_skew(w1, W);
    mat3_mul(W, T, turn);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            spin[3 * i + j] = 2 / h * vec3_dot(&p->R1[3 * i], &p->Rn[3 * j]) - turn[3 * i + j];
    cayley_skew(p->after, A);
    mat3_mul(A, spin, arm);
    mat3_mul(W, swept, moved);
    for (int k = 0; k < 9; k++)
        out[k] = -arm[k] - moved[k];
}

void frame_mass_step_sway(const frame_mass_step *p, double h, const double T[9],
                          const double swept[9], double sway[9])
{
    double speed[9];
    memcpy(sway, swept, 9 * sizeof *sway);
    if (!p->partly_fixed)
        return;
    riding(p, h, T, swept, speed);
    for (int k = 0; k < 9; k++)
        speed[k] *= -h / 2;
    hold_rows(p, 3, speed, sway);
}

/* out = dg/dc */
static void change_of(const frame_mass_step *p, double h, const double T[9], double out[9])
{
    double A[9], both[9], by[9], turn[9];
    cayley_skew(p->centre, A);
    for (int i = 0; i < 9; i++)
        both[i] = (p->Rn[i] + p->R1[i]) / 2;
    mat3_mul(both, A, by);
    cayley_skew(p->turned, A);
    mat3_mul(A, T, turn);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            out[3 * i + j] = -2 / h * vec3_dot(&by[3 * i], &p->Rn[3 * j]) - turn[3 * i + j] / 2;
}

void frame_mass_step_late(const frame_mass *one, const frame_mass_step *p, double h,
                          const double T[9], const double sway[9], double K[36])
{
    double dg[9], behind[9] = {0}, by_mass[9], A[9], first[9], then[9];
    if (!p->partly_fixed)
        return;
    change_of(p, h, T, dg);
    for (int k = 0; k < 9; k++)
        by_mass[k] = -one->mass / (2 * h) * sway[k];
    hold_rows(p, 3, by_mass, behind);
    cayley_skew(p->behind, A);
    mat3_mul(A, dg, first);
    cayley_skew(p->g, A);
    mat3_mul(A, behind, then);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            K[6 * (3 + i) + 3 + j] += then[3 * i + j] - first[3 * i + j];
}

const double account_gained = 0.01, account_stated = 0.01, account_lost = 0.1;

void account_take(account *a, int steps, const double balance[SCENE_BALANCES])
{
    if (steps > 0)
        a->turned += fabs(balance[SCENE_WORK] - a->work);
    a->work = balance[SCENE_WORK];
    a->largest = fmax(a->largest, balance[SCENE_ENERGY]);
}

double account_size(const account *a)
{
    return fmax(a->largest, a->turned);
}

/* Returns 1 if the requested scheme may lose energy: fixed steps, or generalized-alpha with more
 * damping than rho = 0.9. If 3 alpha_f - alpha_m <= 1, as for all values of `rho`, alpha_f -
 * alpha_m = (1 - rho)/(1 + rho), where rho is the spectral radius at infinite frequency. */
static int account_loses(const scene_motion *how)
{
    const double usual = 0.9, most = (1 - usual) / (1 + usual) * (1 + 1e-9);
    return how->tolerance <= 0 ||
           (how->scheme == SCENE_ALPHA && how->alpha.force - how->alpha.mass > most);
}

static const char *remedy(const scene_motion *how)
{
    const int equal_steps = how->tolerance <= 0;
    if (how->scheme == SCENE_CONSERVING)
        return equal_steps ? "give a smaller step, a tolerance, or the integrator radau"
                           : "give a smaller tolerance, or the integrator radau";
    if (how->scheme == SCENE_RADAU)
        return equal_steps ? "give a smaller step, a tolerance, or the integrator conserving"
                           : "give a smaller tolerance, or the integrator conserving, which "
                             "conserves energy";
    return equal_steps
               ? "give a smaller step, a tolerance, or the integrator radau or conserving"
               : "give a smaller tolerance, or the integrator conserving, which conserves energy";
}

double account_most(const account *a, double part, double rounding)
{
    return part * account_size(a) + rounding;
}

status account_check(const account *a, const scene_motion *how, double time,
                     const double balance[SCENE_BALANCES], double rounding, fault *f)
{
    const double size = account_size(a), drift = balance[SCENE_DRIFT];
    if (!(drift <= account_most(a, account_gained, rounding)))
        return fault_set(f, STATUS_NOT_CONVERGED,
                         "at %g s the energy exceeds the initial energy plus the work by %.3g J, "
                         "which is %.2g %% of the largest energy or work so far, %.3g J; the "
                         "limit is %g %%; %s",
                         time, drift, 100 * drift / size, size, 100 * account_gained, remedy(how));
    if (-drift > account_most(a, account_lost, rounding) && !account_loses(how))
        return fault_set(f, STATUS_NOT_CONVERGED,
                         "at %g s the integrator has lost %.3g J of energy, which is %.2g %% of "
                         "the largest energy or work so far, %.3g J; the limit is %g %%; %s",
                         time, -drift, -100 * drift / size, size, 100 * account_lost, remedy(how));
    return STATUS_OK;
}
