/* Forces of inertia of everything that carries mass (off-centre bodies, beams beside their nodes,
 * sequences of angles, released ends, warping) are the change of momenta and of kinetic energy
 * along a motion; kinetic energy is that of all masses one by one. */
#include "harness/model/model.h"
#include "harness/time/time_impl.h"

#include "elements/math/rotation.h"
#include "harness/time/test/masses.h"

/* Rates of the coordinates as increments in fixed axes. */
static void in_space(const moving_one *o, const double v[], double out[])
{
    memcpy(out, v, (size_t)o->all * sizeof *out);
    for (int i = 0; i < model_vertices(o->m); i++) {
        const int *at = model_vertex(o->m, i)->coordinate + SCENE_RX;
        double R[9], own[3], turned[3];
        if ((model_vertex(o->m, i)->body != i && i < model_first_release(o->m)) ||
            forms_of(o->m, i) != FORM_BODY)
            continue;
        rotation_matrix(&o->now->q[4 * i], R);
        for (int k = 0; k < 3; k++)
            own[k] = v[at[k]];
        mat3_mul_vec(R, own, turned);
        for (int k = 0; k < 3; k++)
            out[at[k]] = turned[k];
    }
}

/* Momenta and kinetic energy a moment later; the third derivatives do not matter. */
static void later(const moving_one *o, double dt, inertia_balance *out)
{
    fault f = {""};
    model_state *s;
    double inc[MOST], v[MOST];
    gsl_test(kinematics_state_alloc(o->m, &s, &f) != STATUS_OK, "%s", f.text);
    for (int c = 0; c < o->all; c++) {
        inc[c] = dt * o->v[c] + dt * dt / 2 * o->a[c];
        v[c] = o->v[c] + dt * o->a[c];
    }
    increment_apply(o->m, o->now, inc, 0, s);
    inertia_of(o->m, &o->masses, s, v, NULL, out);
    kinematics_state_free(s);
}

static void near(const char *what, double found, double expected, double tolerance)
{
    gsl_test(!(fabs(found - expected) <= tolerance), "%s: %.12g, expected %.12g", what, found,
             expected);
}

static void forces(const moving_one *o)
{
    const double dt = 1e-5;
    inertia_balance before, after;
    double P[3] = {0}, L[3] = {0}, out[MOST] = {0}, spatial[MOST], power = 0;
    later(o, -dt, &before);
    later(o, dt, &after);
    for (int k = 0; k < o->masses.masses; k++) {
        double F[6], r[3], moment[3];
        inertia_force(o->m, &o->masses.mass[k], o->now, o->v, o->a, F);
        kinematics_position(o->m, o->now, o->masses.mass[k].frame, r);
        vec3_cross(r, F, moment);
        for (int i = 0; i < 3; i++) {
            P[i] += F[i];
            L[i] += F[3 + i] + moment[i];
        }
    }
    for (int i = 0; i < 3; i++) {
        near("force", P[i], (after.momentum[i] - before.momentum[i]) / (2 * dt), 2e-7);
        near("moment", L[i], (after.angular[i] - before.angular[i]) / (2 * dt), 2e-7);
    }
    inertia_subtract(o->m, &o->masses, o->now, o->v, o->a, out);
    in_space(o, o->v, spatial);
    for (int c = 0; c < o->all; c++)
        power -= out[c] * spatial[c];
    near("power", power, (after.kinetic - before.kinetic) / (2 * dt), 4e-7);
}

/* What moves the coordinates of a virtual velocity works on the frames as on the coordinates. */
static void virtual_work(const moving_one *o)
{
    double other[MOST], spatial[MOST], out[MOST] = {0}, given = 0, found = 0;
    uint64_t seed = 99;
    some(o->all, 1, &seed, other);
    inertia_subtract(o->m, &o->masses, o->now, o->v, o->a, out);
    in_space(o, other, spatial);
    for (int c = 0; c < o->all; c++)
        given -= out[c] * spatial[c];
    for (int k = 0; k < o->masses.masses; k++) {
        frame_rates r;
        double F[6];
        inertia_force(o->m, &o->masses.mass[k], o->now, o->v, o->a, F);
        inertia_rates(o->m, o->now, o->masses.mass[k].frame, other, NULL, &r);
        found += vec3_dot(F, r.v) + vec3_dot(F + 3, r.w);
    }
    for (int i = 0; i < model_warps(o->m); i++) {
        const int c = model_warp(o->m, i);
        found += o->masses.warping[c] * o->a[c] * other[c];
    }
    near("virtual work", given, found, 1e-11);
}

/* Of a mass whose centre is beside the frame, by the motion of that; J about the centre. */
static double energy_of(double of, const double beside[3], const double J[9], const double W[3],
                        const double v[3])
{
    double at[3], JW[3];
    vec3_cross(W, beside, at);
    for (int i = 0; i < 3; i++)
        at[i] += v[i];
    mat3_mul_vec(J, W, JW);
    return (of * vec3_dot(at, at) + vec3_dot(W, JW)) / 2;
}

/* Velocity of any vertex in its own axes. */
static void own_rates(const moving_one *o, int vertex, double v[3], double W[3])
{
    const mesh_vertex *at = model_vertex(o->m, vertex);
    frame_rates r;
    double rho[3], moved[3];
    inertia_rates(o->m, o->now, vertex < model_first_release(o->m) ? at->body : vertex, o->v, NULL,
                  &r);
    if (vertex < model_first_release(o->m) && at->body != vertex) {
        kinematics_offset(o->m, o->now, vertex, rho);
        vec3_cross(r.w, rho, moved);
        for (int i = 0; i < 3; i++)
            r.v[i] += moved[i];
    }
    mat3_transpose_mul_vec(r.R, r.v, v);
    mat3_transpose_mul_vec(r.R, r.w, W);
}

/* The sum over bodies and the shares of elements, each by itself. */
static void kinetic_energy(const moving_one *o)
{
    inertia_balance all;
    double sum = 0, v[3], W[3];
    for (int i = 0; i < model_elements(o->m); i++)
        for (int k = 0; k < model_element(o->m, i)->nodes; k++) {
            const mesh_element *el = model_element(o->m, i);
            const section *c = model_section(o->m, model_kind(o->m, el->kind)->section);
            const double l = model_kind(o->m, el->kind)->length * el->share[k],
                         m = c->matrices ? l : l * c->density, none[3] = {0, 0, 0},
                         J[9] = {m * (c->matrices ? about[0] : c->Ip), 0, 0, 0,
                                 m * (c->matrices ? about[1] : c->Iy), 0, 0, 0,
                                 m * (c->matrices ? about[2] : c->Iz)};
            double along[3], turn[3];
            own_rates(o, el->vertex[k], v, W);
            mat3_transpose_mul_vec(el->triad[k], v, along);
            mat3_transpose_mul_vec(el->triad[k], W, turn);
            sum += energy_of(m * (c->matrices ? mass : c->A), c->matrices ? centre : none, J, turn,
                             along);
            if (el->warp[k] != NONE) {
                const double rate = o->v[model_warp(o->m, el->warp[k])];
                sum += m * c->Iw * rate * rate / 2;
            }
        }
    for (int i = 0; i < model_discretes(o->m) - model_springs(o->m); i++) {
        const scene_body *b = model_discrete(o->m, i)->body;
        const double *I = b->inertia, J[9] = {I[0], I[3], I[5], I[3], I[1], I[4], I[5], I[4], I[2]};
        own_rates(o, model_discrete(o->m, i)->el.vertex[0], v, W);
        sum += energy_of(b->mass, b->centre, J, W, v);
    }
    inertia_of(o->m, &o->masses, o->now, o->v, NULL, &all);
    near("kinetic energy", all.kinetic, sum, 1e-13 * sum);
}

int main(void)
{
    static const element_type *const type[] = {&element_collocation, &element_geometrically_exact,
                                               &element_beamw_consistent};
    moving_one o;
    for (int i = 0; i < 6; i++) {
        const int released = i / 3;
        begin(&o, type[i % 3], released);
        forces(&o);
        virtual_work(&o);
        kinetic_energy(&o);
        end(&o);
    }
    return gsl_test_summary();
}
