/* K, C + G and M of small motions about a state with rates must be the derivatives of all forces,
 * by finite differences. */
#include "elements/math/rotation.h"
#include "elements/test/kit.h"
#include "harness/model/model.h"
#include "harness/time/test/masses.h"
#include "harness/time/time_impl.h"

static void add_more(scene *s)
{
    double k[36];
    for (int i = 0; i < 36; i++)
        k[i] = i % 7 == 0 ? 5 + i : 0;
    for (int i = 0; i < s->members; i++)
        s->member[i].damping = 0.02 * (i + 1);
    scene_load_at(s, scene_add_load(s, SCENE_FORCE, 3, 3, -2, 4))->follower = 1;
    scene_load_at(s, scene_add_load(s, SCENE_MOMENT, 4, 0.3, 0.2, -0.4))->follower = 1;
    scene_add_load(s, SCENE_FORCE, 1, 1, 2, -3);
    const int spring = scene_add_spring(s, 1, 3, k), d = scene_add_moving_driver(s, "d");
    for (int i = 0; i < 36; i += 7)
        s->spring[spring].damping[i] = 2 + 0.1 * i;
    scene_drive_piece(s, d, 0, "t");
    scene_drive(s, 0, SCENE_UY, d);
}

typedef struct way {
    moving_one o;
    run_state run;
    run_damping damping;
    equations eq;
    motion_state at;
    outcome_about out;
    double size;
} way;

static void relax_inner(way *w)
{
    const model *m = w->o.m;
    model_state *s = w->at.state;
    double *memory = calloc((size_t)model_memory(m) + 1, sizeof *memory);
    const double still[ELEMENT_MAX_STRAINS] = {0};
    fault f = {""};
    gsl_test(linearise_make_compatible(&w->eq, s, &f) != STATUS_OK, "%s", f.text);
    for (int i = 0; i < model_elements(m) && model_inner(m) > 0; i++)
        for (int k = 0; k < 30; k++) {
            double *inner = s->inner + (size_t)i * (size_t)model_inner(m);
            const element_data *data = model_kind_of(m, i)->data;
            model_type(m)->stress(data, s->e + (size_t)i * (size_t)model_strains(m), inner,
                                  &(stress_output){.memory = memory});
            model_type(m)->update(data, still, memory, inner);
        }
    gsl_test(linearise_make_compatible(&w->eq, s, &f) != STATUS_OK, "%s", f.text);
    free(memory);
}

static void to_rates(const way *w, const double dx[], const double more[], double out[])
{
    const model *m = w->o.m;
    memcpy(out, dx, (size_t)w->o.all * sizeof *out);
    for (int i = 0; i < model_vertices(m); i++) {
        const int *at = model_vertex(m, i)->coordinate + SCENE_RX;
        frame_rates r;
        double d[3], turned[3], own[3];
        if ((model_vertex(m, i)->body != i && i < model_first_release(m)) ||
            forms_of(m, i) != FORM_BODY)
            continue;
        inertia_rates(m, w->o.now, i, w->o.v, NULL, &r);
        for (int k = 0; k < 3; k++)
            own[k] = more != NULL ? more[at[k]] : 0;
        vec3_cross(r.w, own, turned);
        for (int k = 0; k < 3; k++)
            d[k] = dx[at[k]] - turned[k];
        mat3_transpose_mul_vec(r.R, d, own);
        for (int k = 0; k < 3; k++)
            out[at[k]] = own[k];
    }
}

/* Computes all forces for positions, rates and accelerations that differ by h times d[3 x all]. */
static void forces(way *w, double h, const double *const d[3], double out[])
{
    const moving_one *o = &w->o;
    double inc[MOST], v[MOST], a[MOST], by[MOST];
    fault f = {""};
    const model_linearisation lin = {.path = 0, .residual = out};
    model_linearisation of = lin;
    to_rates(w, d[0], NULL, inc);
    to_rates(w, d[1], NULL, v);
    to_rates(w, d[2], d[1], by);
    for (int c = 0; c < o->all; c++) {
        inc[c] *= h;
        v[c] = o->v[c] + h * v[c];
        a[c] = o->a[c] + h * by[c];
    }
    kinematics_state_copy(o->m, o->now, w->at.state);
    increment_apply(o->m, o->now, inc, 0, w->at.state);
    relax_inner(w);
    memcpy(w->at.v, v, (size_t)o->all * sizeof *v);
    gsl_test(damping_now(&w->eq, &w->at, &f) != STATUS_OK, "%s", f.text);
    feedback_take(&w->eq, w->at.state, v, 0);
    gsl_test(linearise_state(&w->eq, &w->run.memory, w->at.state, &of, &f) != STATUS_OK, "%s",
             f.text);
    inertia_subtract(o->m, &o->masses, w->at.state, v, a, out);
}

static void add_chart(way *w, const double dx[], double out[])
{
    static const double none[MOST];
    const model *m = w->o.m;
    double r[MOST] = {0};
    forces(w, 0, (const double *const[]){none, none, none}, r);
    for (int i = 0; i < model_vertices(m); i++) {
        const int *at = model_vertex(m, i)->coordinate + SCENE_RX;
        double M[3], d[3], moved[3];
        if ((model_vertex(m, i)->body != i && i < model_first_release(m)) ||
            forms_of(m, i) != FORM_BODY)
            continue;
        for (int k = 0; k < 3; k++) {
            M[k] = -r[at[k]] / 2;
            d[k] = dx[at[k]];
        }
        vec3_cross(M, d, moved);
        for (int k = 0; k < 3; k++)
            out[at[k]] += moved[k];
    }
}

static double largest_of(int n, const double a[], const double b[])
{
    double largest = 0;
    for (int i = 0; i < n; i++)
        largest = worst_of(largest, fabs(a[i] - (b != NULL ? b[i] : 0)));
    return largest;
}

static void check(way *w, const char *name, int part, uint64_t seed)
{
    static const double none[MOST];
    static const double weight[3] = {0.75, -0.15, 1 / 60.0};
    const double h = part == 0 ? 2e-3 : 0.5;
    const int n = w->o.all;
    double d[MOST], found[MOST] = {0}, other[MOST], expected[MOST] = {0}, out[MOST];
    some(n, 1, &seed, d);
    for (int k = 0; k < 3; k++)
        for (int sign = -1; sign < 2; sign += 2) {
            const double *const by[3] = {part == 0 ? d : none, part == 1 ? d : none,
                                         part == 2 ? d : none};
            memset(out, 0, sizeof out);
            forces(w, sign * (k + 1) * h, by, out);
            for (int i = 0; i < n; i++)
                expected[i] -= sign * weight[k] / h * out[i];
        }
    if (part == 0) {
        sparse_mul(&w->out.K, d, found);
        add_chart(w, d, expected);
    } else if (part == 1) {
        sparse_mul(&w->out.C, d, found);
        sparse_mul(&w->out.G, d, other);
        for (int i = 0; i < n; i++)
            found[i] += other[i];
    } else
        sparse_mul(&w->out.M, d, found);
    const double size = largest_of(n, expected, NULL), noise = 1e-11 * w->size / h / size,
                 off = largest_of(n, found, expected) / size;
    gsl_test(!(off <= 1e-7 + noise), "%s: %s is the derivative of the forces (%g)", name,
             (const char *[]){"K", "C + G", "M"}[part], off);
}

static void case_of(const element_type *type, int released, int spread)
{
    way w = {0};
    fault f = {""};
    char name[100];
    snprintf(name, sizeof name, "%s%s%s", type->name, released ? ", released" : "",
             spread ? ", consistent mass" : "");
    begin_with(&w.o, type, released, add_more);
    if (spread) {
        frame_masses_free(&w.o.masses);
        memset(&w.o.masses, 0, sizeof w.o.masses);
        gsl_test(frame_masses_alloc_bodies(w.o.m, &w.o.masses, &f) != STATUS_OK, "%s", f.text);
    }
    for (int c = 0; c < w.o.all && type == &element_collocation; c++)
        w.o.inc[c] *= 0.1;
    increment_apply(w.o.m, w.o.rest, w.o.inc, 0, w.o.now);
    w.o.masses.damping = 0.3;
    gsl_test(run_state_begin(&w.run, w.o.m, 1, &f) != STATUS_OK, "%s", f.text);
    w.eq = (equations){.m = w.o.m, .loading = {.in_time = 1, .held_path = 1}, .run = &w.run};
    gsl_test(damping_begin(&w.eq, &w.damping, &f) != STATUS_OK, "%s", f.text);
    gsl_test(feedback_begin(&w.eq, &f) != STATUS_OK, "%s", f.text);
    gsl_test(motion_state_alloc(w.o.m, &w.at, &f) != STATUS_OK, "%s", f.text);
    kinematics_state_copy(w.o.m, w.o.now, w.at.state);
    memcpy(w.at.v, w.o.v, (size_t)w.o.all * sizeof(double));
    memcpy(w.at.a, w.o.a, (size_t)w.o.all * sizeof(double));
    relax_inner(&w);
    gsl_test(small_motions_of(&w.eq, &w.o.masses, &w.at, &w.out, &f) != STATUS_OK, "%s: %s", name,
             f.text);
    w.size = largest_of(model_elements(w.o.m) * model_strains(w.o.m), w.at.state->sigma, NULL);
    for (int part = 0; part < 3; part++)
        check(&w, name, part, 5 + (uint64_t)part);
    sparse_free_values(&w.out.K);
    sparse_free_values(&w.out.M);
    sparse_free_values(&w.out.C);
    sparse_free_values(&w.out.G);
    motion_state_free(&w.at);
    damping_end(&w.eq, &w.damping);
    run_state_end(&w.run);
    end(&w.o);
}

int main(void)
{
    static const element_type *const type[] = {&element_collocation, &element_geometrically_exact,
                                               &element_beamw_consistent};
    for (int i = 0; i < 3; i++) {
        formulation chosen;
        formulation_default(type[i], &chosen);
        for (int released = 0; released < 2; released++) {
            case_of(type[i], released, 0);
            if (element_spreads(type[i], chosen.option))
                case_of(type[i], released, 1);
        }
    }
    return gsl_test_summary();
}
