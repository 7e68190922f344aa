/* Inertia forces must be the rates of change of momenta and of kinetic energy along a motion, for
 * off-centre bodies, beams at offsets from their nodes, sequences of angles, released ends and
 * warping. */
#include "elements/math/rotation.h"
#include "elements/test/kit.h"
#include "harness/model/model.h"
#include "harness/time/test/masses.h"
#include "harness/time/time_impl.h"

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

/* Returns the kinetic energy of a mass `of` whose centre is at `beside` in the frame, from the
 * velocity and angular velocity of the frame. J is about the centre of mass. */
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

static void inertia_tests(void)
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
}

static void rates_of(const moving_one *o, uint64_t seed, motion_state *at)
{
    some(o->all, 1, &seed, at->v);
    some(o->all, 3, &seed, at->a);
}

static double apart(size_t count, const double a[], const double b[])
{
    double largest = 0;
    for (size_t i = 0; i < count; i++)
        largest = worst_of(largest, fabs(a[i] - b[i]));
    return largest;
}

static double rates_apart(const model *m, const double a[], const double b[])
{
    double largest = 0;
    for (int i = 0; i < model_vertices(m); i++)
        for (int k = 0; k < 6; k++) {
            const int c = model_vertex(m, i)->coordinate[k];
            const int ball = i >= model_first_release(m) && forms_of(m, i) == FORM_BODY;
            if (c != NONE && (model_vertex(m, i)->body == i ||
                              (i >= model_first_release(m) && !(ball && k > 2))))
                largest = worst_of(largest, fabs(a[c] - b[c]));
        }
    for (int i = 0; i < model_warps(m); i++)
        largest = worst_of(largest, fabs(a[model_warp(m, i)] - b[model_warp(m, i)]));
    return largest;
}

static double places_apart(const model *m, const model_state *a, const model_state *b)
{
    const size_t n = (size_t)model_vertices(m);
    double largest = apart(3 * n, a->u, b->u);
    largest = worst_of(largest, apart(3 * n, a->angle, b->angle));
    largest = worst_of(largest, apart(3 * (size_t)model_releases(m), a->shift, b->shift));
    largest = worst_of(largest, apart((size_t)model_warps(m), a->warp, b->warp));
    for (size_t i = 0; i < n; i++) {
        double sum = 0;
        for (int k = 0; k < 4; k++)
            sum += a->q[4 * i + (size_t)k] * b->q[4 * i + (size_t)k];
        largest = worst_of(largest, sqrt(fmax(0, 1 - sum * sum)) < 2e-8 ? 0 : 1);
    }
    return largest;
}

static void run(const moving_one *o, dense_output_degree degree)
{
    const double h = 0.3;
    motion_state from, to, at;
    dense_output inside;
    run_state loaded;
    fault f = {""};
    uint64_t seed = 31;
    double inc[MOST];
    run_state_begin(&loaded, o->m, 1, NULL);
    const equations eq = {.m = o->m, .run = &loaded};
    gsl_test(motion_state_alloc(o->m, &from, &f) != STATUS_OK ||
                 motion_state_alloc(o->m, &to, &f) != STATUS_OK ||
                 motion_state_alloc(o->m, &at, &f) != STATUS_OK ||
                 dense_output_alloc(&eq, &inside, &f) != STATUS_OK,
             "%s", f.text);
    kinematics_state_copy(o->m, o->now, from.state);
    some(o->all, 0.4, &seed, inc);
    kinematics_state_copy(o->m, o->now, to.state);
    increment_apply(o->m, o->now, inc, 0, to.state);
    from.time = 1;
    to.time = 1 + h;
    rates_of(o, 5, &from);
    rates_of(o, 6, &to);
    dense_output_set(&inside, degree, &from, &to);
    for (int k = 0; k < 2; k++) {
        const motion_state *expected = k ? &to : &from;
        dense_output_at(&inside, expected->time, &at);
        const double places = places_apart(o->m, at.state, expected->state),
                     rates = rates_apart(o->m, at.v, expected->v),
                     second = rates_apart(o->m, at.a, expected->a);
        gsl_test(!(places < 1e-13), "%s: places at end %d (%g)", model_type(o->m)->name, k, places);
        gsl_test(!(rates < 1e-12), "%s: rates at end %d (%g)", model_type(o->m)->name, k, rates);
        gsl_test(!(second < 1e-10), "%s: accelerations at end %d (%g)", model_type(o->m)->name, k,
                 second);
    }
    dense_output_at(&inside, 1 + h / 2, &at);
    gsl_test(!(places_apart(o->m, at.state, from.state) > 0.01), "%s: half of the way",
             model_type(o->m)->name);
    dense_output_free(&inside);
    run_state_end(&loaded);
    motion_state_free(&from);
    motion_state_free(&to);
    motion_state_free(&at);
}

static void dense_output_tests(void)
{
    static const element_type *const type[] = {&element_collocation, &element_beamw_consistent};
    moving_one o;
    for (int i = 0; i < 4; i++) {
        begin(&o, type[i % 2], i / 2);
        run(&o, DENSE_OUTPUT_CUBIC);
        run(&o, DENSE_OUTPUT_QUINTIC);
        end(&o);
    }
}

/* Factors of the increments in the rates: v = g inc, a = b inc. The tangent of inertia forces is
 * their derivative in the exponential chart. */
static const double b = 7, g = 3;

static void force_at(const moving_one *o, const double inc[], const double from[], double out[])
{
    fault f = {""};
    model_state *s;
    double v[MOST], a[MOST];
    gsl_test(kinematics_state_alloc(o->m, &s, &f) != STATUS_OK, "%s", f.text);
    for (int c = 0; c < o->all; c++) {
        v[c] = o->v[c] + g * (inc[c] - from[c]);
        a[c] = o->a[c] + b * (inc[c] - from[c]);
    }
    increment_apply(o->m, o->rest, inc, 0, s);
    memset(out, 0, (size_t)o->all * sizeof *out);
    inertia_subtract(o->m, &o->masses, s, v, a, out);
    kinematics_state_free(s);
}

static void add_chart(const moving_one *o, const double out[], int column, double slope[])
{
    for (int i = 0; i < model_first_release(o->m); i++) {
        const int *at = model_vertex(o->m, i)->coordinate + SCENE_RX;
        if (model_vertex(o->m, i)->body != i)
            continue;
        for (int k = 0; k < 3; k++) {
            if (at[k] != column)
                continue;
            const int j = (k + 1) % 3, l = (k + 2) % 3;
            slope[at[j]] += out[at[l]] / 2; /* (M x e_k)/2 */
            slope[at[l]] -= out[at[j]] / 2;
        }
    }
}

static double entry(const sparse *S, int row, int column)
{
    for (int p = S->column[column]; p < S->column[column + 1]; p++)
        if (S->row[p] == row)
            return S->value[p];
    return 0;
}

static void tangent(const moving_one *o)
{
    const double small = 1e-5;
    const inertia_relation with = {b, g, o->inc};
    const sparse *pattern;
    sparse S;
    fault f = {""};
    double largest = 0, here[MOST];
    run_state run;
    run_state_begin(&run, o->m, 1, NULL);
    const equations eq = {.m = o->m, .run = &run};
    gsl_test(assemble_pattern_in_time(o->m, run.patterns, &pattern, &f) != STATUS_OK ||
                 sparse_alloc_like(pattern, &S, &f) != STATUS_OK,
             "%s", f.text);
    inertia_add_tangent(&eq, &o->masses, o->now, o->v, o->a, &with, &S);
    force_at(o, o->inc, o->inc, here);
    for (int c = 0; c < model_unknowns(o->m); c++) {
        double side[2][MOST], slope[MOST];
        for (int k = 0; k < 2; k++) {
            double dx[MOST] = {0}, inc[MOST];
            dx[c] = k ? small : -small;
            memcpy(inc, o->inc, sizeof inc);
            increment_add(o->m, o->now, dx, inc);
            force_at(o, inc, o->inc, side[k]);
        }
        for (int r = 0; r < model_unknowns(o->m); r++)
            slope[r] = (side[1][r] - side[0][r]) / (2 * small);
        add_chart(o, here, c, slope);
        for (int r = 0; r < model_unknowns(o->m); r++)
            largest = worst_of(largest, fabs(entry(&S, r, c) + slope[r]));
    }
    gsl_test(!(largest < 1e-8), "the tangent is the derivative (%g)", largest);
    sparse_free_values(&S);
    run_state_end(&run);
}

static void tangent_tests(void)
{
    static const element_type *const type[] = {&element_collocation, &element_geometrically_exact,
                                               &element_beamw_consistent};
    moving_one o;
    for (int i = 0; i < 3; i++) {
        begin(&o, type[i], 0);
        tangent(&o);
        end(&o);
    }
}

static void build_driven(scene *s)
{
    static const double y[3] = {0, 1, 0};
    static const char *const way[] = {"0.3 + sin(2*t)", "0.5*t^2 - 0.2", "cos(3*t)"};
    const section_spec spec = heavy();
    scene_init(s, "driven");
    const int profile = scene_add_section(s, &spec), A = scene_add_node(s, 0, 0, 0),
              B = scene_add_node(s, 1, 0.1, 0.2);
    scene_add_member(s, A, B, profile, y);
    scene_node_at(s, A)->rotation = SCENE_ROTATION_VECTOR;
    for (int k = 0; k < 3; k++) {
        const int d = scene_add_moving_driver(s, (const char *const[]){"a", "b", "c"}[k]);
        scene_drive_piece(s, d, 0, way[k]);
        scene_drive(s, A, SCENE_RX + k, d);
    }
    const int lift = scene_add_moving_driver(s, "lift");
    scene_drive_piece(s, lift, 0, "t^3 + t");
    scene_drive(s, A, SCENE_UZ, lift);
    scene_omit(s, FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE);
}

static void go(const equations *eq, const model_state *from, double time, model_state *to,
               frame_rates *r)
{
    const model *m = eq->m;
    double inc[MOST] = {0}, v[MOST] = {0}, a[MOST] = {0};
    drive_at(eq, from, time, inc, v, a);
    increment_apply(m, from, inc, time, to);
    forms_rates(m, to, 0, v, a, r);
}

static void check(const equations *eq, const model_state *from, double t, model_state *to)
{
    const double dt = 1e-4;
    frame_rates at, before, after;
    double q[2][4], turn[3], expected[4];
    go(eq, from, t - dt, to, &before);
    memcpy(q[0], to->q, sizeof q[0]);
    go(eq, from, t + dt, to, &after);
    memcpy(q[1], to->q, sizeof q[1]);
    go(eq, from, t, to, &at);
    rotation_exp((const double[]){0.3 + sin(2 * t), 0.5 * t * t - 0.2, cos(3 * t)}, expected);
    rotation_between(expected, to->q, turn);
    gsl_test(!(vec3_norm(turn) < 1e-13), "turned otherwise by %g rad", vec3_norm(turn));
    gsl_test(!(fabs(to->u[2] - t * t * t - t) < 1e-13), "lifted by %g m", to->u[2]);
    gsl_test(!(fabs(at.v[2] - 3 * t * t - 1) < 1e-12), "lifted at %g m/s", at.v[2]);
    gsl_test(!(fabs(at.a[2] - 6 * t) < 1e-12), "lifted with %g m/s^2", at.a[2]);
    rotation_between(q[0], q[1], turn);
    for (int k = 0; k < 3; k++) {
        const double w = turn[k] / (2 * dt), wd = (after.w[k] - before.w[k]) / (2 * dt);
        gsl_test(!(fabs(w - at.w[k]) < 1e-6), "angular velocity %.9g, not %.9g", at.w[k], w);
        gsl_test(!(fabs(wd - at.wd[k]) < 1e-6), "its derivative %.9g, not %.9g", at.wd[k], wd);
    }
}

static void drive_tests(void)
{
    scene s;
    model *m;
    run_state run;
    model_state *now = NULL, *to = NULL;
    formulation chosen;
    frame_rates at;
    fault f = {""};
    build_driven(&s);
    formulation_default(&element_collocation, &chosen);
    const model_request request = {
        .scene = &s, .type = &element_collocation, .options = chosen.option, .elements = 1};
    gsl_test(model_alloc(&request, &m, &f) != STATUS_OK, "%s", f.text);
    gsl_test(run_state_begin(&run, m, 1, &f) != STATUS_OK, "%s", f.text);
    const equations eq = {.m = m, .loading = {.in_time = 1}, .run = &run};
    gsl_test(kinematics_state_alloc(m, &now, &f) != STATUS_OK ||
                 kinematics_state_alloc(m, &to, &f) != STATUS_OK,
             "%s", f.text);
    go(&eq, kinematics_rest(m), 0.4, now, &at);
    check(&eq, kinematics_rest(m), 0.7, to);
    check(&eq, now, 0.7, to);
    kinematics_state_free(now);
    kinematics_state_free(to);
    run_state_end(&run);
    model_free(m);
    scene_free(&s);
}

int main(void)
{
    inertia_tests();
    dense_output_tests();
    tangent_tests();
    drive_tests();
    return gsl_test_summary();
}
