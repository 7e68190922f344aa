#include "harness/time/time_impl.h"

#include <math.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/math/vec3.h"

static const double *inner_of(const model *m, const model_state *s, int i)
{
    static const double none[1] = {0};
    return model_inner(m) > 0 ? s->inner + (size_t)i * (size_t)model_inner(m) : none;
}

static status middle_stress_of(const equations *eq, int count, const int index[],
                               const double *const e[], const model_state *s, stress_output out[],
                               fault *f)
{
    const model *m = eq->m;
    const element_data *data[CHUNK_MOST];
    const double *inner[CHUNK_MOST];
    status outcome[CHUNK_MOST];
    for (int k = 0; k < count; k++) {
        data[k] = free_strain_data(eq, index[k], s->path);
        inner[k] = inner_of(m, s, index[k]);
    }
    eq->run->counters.stress_evaluations += count;
    if (count > 1 && model_type(m)->stress_many != NULL && eq->run->free_strain == NULL)
        model_type(m)->stress_many(count, data, e, inner, out, outcome);
    else
        for (int k = 0; k < count; k++)
            outcome[k] = model_type(m)->stress(data[k], e[k], inner[k], &out[k]);
    for (int k = 0; k < count; k++)
        if (outcome[k] != STATUS_OK)
            return fault_set(
                f, outcome[k],
                "element %d of %s: its state is outside the range that %s can evaluate; use "
                "smaller steps or more elements",
                index[k],
                scene_called(model_scene(m), SCENE_MEMBERS, model_element(m, index[k])->member)
                    .text,
                model_type(m)->name);
    return STATUS_OK;
}

static void begin_spring(conserving *s, const motion_state *from, int i)
{
    deformable of = deformable_at(s, from, from->state, i);
    node_state x[ELEMENT_MAX_NODES];
    kinematics_gather(s->of.c->model, from->state, of.el, x);
    spring_strain(of.el->nodes, x,
                  turns_of_spring(s->of.c->model, from->state, i - model_elements(s->of.c->model)),
                  &(strain_output){.e = of.e});
    spring_law(of.spring->spring, of.e, of.sigma, of.W);
    memcpy(of.sigma + SPRING_STRAINS, of.sigma, SPRING_STRAINS * sizeof *of.sigma);
    memcpy(of.first, of.e, SPRING_STRAINS * sizeof *of.first);
    s->energy[i] = spring_energy(of.spring->spring, of.e);
}

status conserving_begin(conserving *s, const motion_state *from, fault *f)
{
    const model *m = s->of.c->model;
    const double *e[CHUNK_MOST] = {NULL};
    memset(s->d, 0, (size_t)deformable_count(s) * (size_t)s->strains * sizeof *s->d);
    for (int i = 0; i < model_elements(m);) {
        const int count = deformable_together(s, i);
        stress_output out[CHUNK_MOST];
        int index[CHUNK_MOST] = {0};
        for (int k = 0; k < count; k++) {
            index[k] = i + k;
            e[k] = from->state->e + (size_t)(i + k) * (size_t)model_strains(m);
            out[k] = (stress_output){
                .energy = &s->energy[i + k],
                .sigma =
                    s->elastic != NULL ? s->elastic + (size_t)((i + k) * model_strains(m)) : NULL,
                .C = deformable_at(s, from, from->state, i + k).C_before};
        }
        TRY(middle_stress_of(&s->of.c->eq, count, index, e, from->state, out, f));
        i += count;
    }
    for (int i = model_elements(m); i < deformable_count(s); i++)
        begin_spring(s, from, i);
    return STATUS_OK;
}

/* Numerator (lacking) and denominator (square) of k, and the sum of e . W e (size) */
typedef struct scalar_parts {
    double lacking, square, size;
} scalar_parts;

static void take_energy(conserving *s, const deformable *of, double energy, scalar_parts *sum)
{
    sum->lacking += energy - s->energy[of->index];
    for (int k = 0; k < of->strains; k++) {
        sum->lacking -= (of->before[k] + of->present[k]) / 2 * of->d[k];
        s->largest = fmax(s->largest, fabs(of->present[k]));
    }
    sum->square += dense_quadratic(of->strains, of->W, of->d);
    sum->size += dense_quadratic(of->strains, of->W, of->e);
}

static status stress_together(conserving *s, const motion_state *from, model_state *now, int first,
                              int count, scalar_parts *sum, fault *f)
{
    const model *m = s->of.c->model;
    deformable of[CHUNK_MOST];
    const double *e[CHUNK_MOST] = {NULL};
    stress_output out[CHUNK_MOST];
    double energy[CHUNK_MOST];
    int index[CHUNK_MOST] = {0};
    for (int k = 0; k < count; k++) {
        of[k] = deformable_at(s, from, now, first + k);
        index[k] = first + k;
        e[k] = of[k].e;
        out[k] = (stress_output){.energy = &energy[k],
                                 .sigma = of[k].present,
                                 .C = of[k].C,
                                 .memory = model_memory(m) > 0 ? of[k].memory : NULL};
    }
    TRY(middle_stress_of(&s->of.c->eq, count, index, e, now, out, f));
    for (int k = 0; k < count; k++) {
        for (int c = 0; c < model_strains(m) * model_strains(m); c++)
            of[k].W[c] = (of[k].C_before[c] + of[k].C[c]) / 2;
        take_energy(s, &of[k], energy[k], sum);
    }
    return STATUS_OK;
}

static void stress_spring(conserving *s, const motion_state *from, model_state *now, int i,
                          scalar_parts *sum)
{
    const deformable of = deformable_at(s, from, now, i);
    double mean[SPRING_STRAINS];
    spring_mean(of.spring->spring, of.first, of.e, mean, of.C);
    for (int k = 0; k < SPRING_STRAINS; k++)
        of.present[k] = 2 * mean[k] - of.before[k];
    for (int k = 0; k < SPRING_STRAINS * SPRING_STRAINS; k++)
        of.C[k] *= 2;
    take_energy(s, &of, spring_energy(of.spring->spring, of.e), sum);
}

/* Returns the kinetic energy plus the absolute strain energies [J] at the start of the step. */
static double size_of_energy(const conserving *s, const motion_state *from)
{
    inertia_balance moving;
    inertia_of(s->of.c->model, s->of.masses, from->state, from->v,
               from->ends_known ? from->ends : NULL, &moving);
    double sum = moving.kinetic;
    for (int i = 0; i < deformable_count(s); i++)
        sum += fabs(s->energy[i]);
    return sum;
}

status conserving_stresses(conserving *s, const motion_state *from, model_state *now, int iteration,
                           fault *f)
{
    const model *m = s->of.c->model;
    const double wild = 0.3, nothing = 1e-16, rounding = 1e-12;
    scalar_parts sum = {0, 0, 0};
    s->largest = 0;
    for (int i = 0; i < model_elements(m);) {
        const int count = deformable_together(s, i);
        TRY(stress_together(s, from, now, i, count, &sum, f));
        i += count;
    }
    for (int i = model_elements(m); i < deformable_count(s); i++)
        stress_spring(s, from, now, i, &sum);
    s->denominator = sum.square;
    const int moves = fabs(sum.square) > nothing * fabs(sum.size);
    s->k = moves && iteration > 2 ? sum.lacking / sum.square : 0;
    s->wild = 0;
    if (fabs(s->k) > wild) {
        s->wild = fabs(sum.lacking) > rounding * size_of_energy(s, from);
        s->k = 0;
    }
    return STATUS_OK;
}

/* Centres of mass move by dr_c = h (v_c + v_c1)/2, and masses rotate by the Cayley vector c with
 * R_n^T c = h (W + W1)/2, where W are angular velocities in the axes of the frame. Forces act at
 * the mean positions of the centres. If a frame can only rotate, the tensor of the mass about the
 * origin of the frame is constant in the axes of the frame. */

/* Returns the number of fixed translations of a frame that has free translations too; otherwise
 * 0. */
static int held_of(const model *m, int frame, int held[3])
{
    int count = 0;
    for (int i = 0; i < 3 && frame < model_first_release(m); i++)
        count += held[i] = model_vertex(m, frame)->coordinate[i] == NONE;
    return count < 3 ? count : 0;
}

static int only_turns(const model *m, int frame)
{
    int held[3] = {0};
    return held_of(m, frame, held) == 0 && held[0];
}

void frame_mass_step_centre(const model *m, const frame_mass *one, double centre[3], double J[9])
{
    if (only_turns(m, one->frame)) {
        memset(centre, 0, 3 * sizeof *centre);
        memcpy(J, one->inertia, 9 * sizeof *J);
        return;
    }
    const double mass = one->mass > 0 ? one->mass : 1;
    for (int i = 0; i < 3; i++)
        centre[i] = one->moment[i] / mass;
    const double square = vec3_dot(one->moment, centre);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            J[3 * i + j] =
                one->inertia[3 * i + j] - ((i == j ? square : 0) - one->moment[i] * centre[j]);
}

void frame_mass_step_of(const conserving *s, const motion_state *from, const model_state *now,
                        double h, const frame_mass *one, frame_mass_step *out)
{
    const model *m = s->of.c->model;
    double dr[3], swept[3], body[3], turned[3];
    int held[3] = {0};
    frame_rates r;
    frame_mass_step_centre(m, one, out->centre, out->J);
    out->partly_fixed = held_of(m, one->frame, held);
    for (int k = 0; k < 9; k++)
        out->held[k] = k % 4 == 0 && held[k / 3];
    kinematics_turn_back(model_vertex(m, one->frame), out->held);
    inertia_rates(m, from->state, one->frame, from->v, NULL, &r);
    memcpy(out->Rn, r.R, sizeof r.R);
    rotation_matrix(&now->q[4 * one->frame], out->R1);
    mat3_mul_vec(out->Rn, out->centre, out->before);
    mat3_mul_vec(out->R1, out->centre, out->after);
    frame_motion_step(s, from->state, now, one->frame, dr, out->c);
    for (int i = 0; i < 3; i++)
        out->mean[i] = (out->before[i] + out->after[i]) / 2;
    vec3_cross(r.w, out->before, turned);
    vec3_cross(out->c, out->mean, swept);
    mat3_transpose_mul_vec(out->Rn, r.w, out->W0);
    mat3_transpose_mul_vec(out->Rn, out->c, body);
    for (int i = 0; i < 3; i++)
        out->v0[i] = r.v[i] + turned[i];
    if (one->frame >= model_first_release(m) && from->ends_known) {
        const double *own = from->ends + 6 * (one->frame - model_first_release(m));
        memcpy(out->v0, own, sizeof out->v0);
        memcpy(out->W0, own + 3, sizeof out->W0);
    }
    for (int i = 0; i < 3; i++) {
        out->v1[i] = 2 * (dr[i] + swept[i]) / h - out->v0[i];
        out->W1[i] = 2 * body[i] / h - out->W0[i];
    }
    frame_mass_step_follow(one, out);
}

static void forces_of(const frame_mass *one, const frame_mass_step *p, double h, double F[6])
{
    double H0[3], H1[3], spun0[3], spun1[3], lever[3];
    mat3_mul_vec(p->J, p->W0, H0);
    mat3_mul_vec(p->J, p->W1, H1);
    mat3_mul_vec(p->Rn, H0, spun0);
    mat3_mul_vec(p->R1, H1, spun1);
    for (int i = 0; i < 3; i++)
        F[i] = (one->mass - one->less[i]) * (p->v1[i] - p->v0[i]) / h;
    vec3_cross(p->mean, F, lever);
    for (int i = 0; i < 3; i++)
        F[3 + i] = (spun1[i] - spun0[i]) / h + lever[i] + (p->partly_fixed ? p->late[i] : 0);
}

/* Computes K[6 x 6], the derivative of F with respect to dr and c. */
static void tangent_of(const frame_mass *one, const frame_mass_step *p, double h, const double F[6],
                       double K[36])
{
    const double b = 2 / (h * h);
    double T[9], A[9], swept[9], sway[9], RJ[9], RJR[9], H1[3], spun[3], turn[9], mean[9], lever[9],
        force[9], more[9], heavy[9];
    cayley_tangent(p->c, T);
    cayley_skew(p->after, A);
    mat3_mul(A, T, swept); /* -d(centre)/dc */
    mat3_mul(p->R1, p->J, RJ);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            RJR[3 * i + j] = vec3_dot(&RJ[3 * i], &p->Rn[3 * j]);
    mat3_mul_vec(p->J, p->W1, H1);
    mat3_mul_vec(p->R1, H1, spun);
    cayley_skew(spun, A);
    mat3_mul(A, T, turn);
    cayley_skew(p->mean, mean);
    frame_mass_step_sway(p, h, T, swept, sway);
    for (int k = 0; k < 9; k++)
        heavy[k] = (one->mass - one->less[k / 3]) * sway[k];
    mat3_mul(mean, heavy, lever);
    cayley_skew(F, force);
    mat3_mul(force, swept, more);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int k = 3 * i + j;
            K[6 * i + j] = i == j ? (one->mass - one->less[i]) * b : 0;
            K[6 * i + 3 + j] = -b * heavy[k];
            K[6 * (3 + i) + j] = (one->mass - one->less[j]) * b * mean[k];
            K[6 * (3 + i) + 3 + j] = b * RJR[k] - turn[k] / h - b * lever[k] + more[k] / 2;
        }
    frame_mass_step_late(one, p, h, T, sway, K);
}

void conserving_inertia(conserving *s, const motion_state *from, const model_state *now, double h)
{
    const model *m = s->of.c->model;
    const frame_masses *all = s->of.masses;
    s->of.c->run->counters.inertia_evaluations += all->masses;
    for (int k = 0; k < all->masses; k++) {
        const frame_mass *one = &all->mass[k];
        frame_mass_step p;
        double F[6], K[36];
        frame_mass_step_of(s, from, now, h, one, &p);
        forces_of(one, &p, h, F);
        tangent_of(one, &p, h, F, K);
        for (int i = 0; i < 6; i++)
            F[i] = -F[i];
        frame_motion_add(s, from->state, now, one->frame, F, K, s->residual);
    }
    for (int i = 0; i < model_warps(m); i++) {
        const int c = model_warp(m, i);
        const double mass = all->warping[c];
        s->residual[c] -= mass * (2 * s->step[c] / h - 2 * from->v[c]) / h;
        assemble_subtract(&s->S, c, c, -2 * mass / (h * h));
    }
}

static int turns_freely(const model *m, int vertex)
{
    return model_vertex(m, vertex)->body == vertex && model_vertex(m, vertex)->angles == 0;
}

static void vector_of(const double of[], const int at[3], double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = at[k] != NONE ? of[at[k]] : 0;
}

static void put_vector(const double v[3], const int at[3], double of[])
{
    for (int k = 0; k < 3; k++)
        if (at[k] != NONE)
            of[at[k]] = v[k];
}

void conserving_increment(const conserving *s, const model_state *from, double inc[])
{
    const model *m = s->of.c->model;
    double c[3], t[3], body[3];
    memcpy(inc, s->step, (size_t)s->all * sizeof *inc);
    for (int i = 0; i < model_first_release(m); i++) {
        const int *at = model_vertex(m, i)->coordinate + SCENE_RX;
        frame_rates r;
        if (!turns_freely(m, i))
            continue;
        vector_of(s->step, at, c);
        cayley_to_vector(c, t);
        forms_rates(m, from, i, inc, NULL, &r);
        mat3_transpose_mul_vec(r.R, t, body);
        put_vector(body, at, inc);
    }
    for (int i = model_first_release(m); i < model_vertices(m); i++) {
        const int *at = model_vertex(m, i)->coordinate + SCENE_RX;
        double R[9];
        if (release_of(m, i)->turns < 3)
            continue;
        vector_of(s->step, at, c);
        cayley_to_vector(c, t);
        rotation_matrix(&from->q[4 * i], R);
        mat3_transpose_mul_vec(R, t, body);
        put_vector(body, at, inc);
    }
}

static void predict_turn(conserving *s, const frame_rates *r, const int at[3], double h,
                         double c[3])
{
    double t[3], spatial[3], driven[3];
    for (int k = 0; k < 3; k++)
        t[k] = at[k] != NONE && at[k] >= s->free ? s->dx[at[k]] : 0;
    mat3_mul_vec(r->R, t, spatial);
    cayley_of_vector(spatial, driven);
    for (int k = 0; k < 3; k++)
        c[k] = at[k] == NONE ? 0 : at[k] < s->free ? h * r->w[k] : driven[k];
    put_vector(c, at, s->step);
}

/* For a node that rotates freely, computes dr = h/2 (v + cay(c) v): the velocity rotates with the
 * node. cay(c) v - v = (c x v + c x (c x v)/2)/(1 + c.c/4). Increments of other free coordinates
 * are h v, for three released rotations along fixed axes. */
void conserving_predict(conserving *s, const motion_state *from, double h)
{
    const model *m = s->of.c->model;
    for (int c = 0; c < s->free; c++)
        s->step[c] = h * from->v[c];
    drive_at(&s->of.c->eq, from->state, from->time + h, s->step, NULL, NULL);
    memcpy(s->dx, s->step, (size_t)s->all * sizeof *s->dx);
    for (int i = model_first_release(m); i < model_vertices(m); i++) {
        const int *at = model_vertex(m, i)->coordinate + SCENE_RX;
        double R[9], own[3], c[3];
        if (release_of(m, i)->turns < 3)
            continue;
        rotation_matrix(&from->state->q[4 * i], R);
        vector_of(s->step, at, own);
        mat3_mul_vec(R, own, c);
        put_vector(c, at, s->step);
    }
    for (int i = 0; i < model_first_release(m); i++) {
        const int *at = model_vertex(m, i)->coordinate;
        frame_rates r;
        double c[3], crossed[3], twice[3];
        if (!turns_freely(m, i))
            continue;
        forms_rates(m, from->state, i, from->v, NULL, &r);
        predict_turn(s, &r, at + SCENE_RX, h, c);
        vec3_cross(c, r.v, crossed);
        vec3_cross(c, crossed, twice);
        double moved[3];
        for (int k = 0; k < 3; k++)
            moved[k] = h * (r.v[k] + (crossed[k] + twice[k] / 2) / (1 + vec3_dot(c, c) / 4) / 2);
        kinematics_to_own(model_vertex(m, i), moved);
        for (int k = 0; k < 3; k++)
            if (at[k] != NONE && at[k] < s->free && model_owns(m, i, k))
                s->step[at[k]] = moved[k];
    }
}
