/* Loads on an element that computes the motion of its sections (element_type.line): the stiffness
 * must be the derivative of the forces within 1e-9. For dead forces on an undeformed slender
 * element, the forces must be those of the displacement field that is common to all types, within
 * 1e-13. */
#include <gsl/gsl_test.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/vec3.h"
#include "elements/test/kit.h"
#include "harness/formulations/formulations.h"
#include "harness/newton/newton_impl.h"

enum { N = 14, END = 7 };
static const double L = 2;

static void add_second(int at, double c, const double n[3], const double f[3], double H[])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            H[N * (at + i) + at + j] +=
                c * ((n[i] * f[j] + f[i] * n[j]) / 2 - (i == j) * vec3_dot(n, f));
}

/* A cubic through both nodes with their slopes. Section axes are those of the nearer node. */
static void section_at(const node_state x[], line_output *out)
{
    const double s = out->at, q = s * s * (3 - 2 * s), slope = L * s * (1 - s),
                 part[2] = {1 - q, q}, lean[2] = {slope * (1 - s), -slope * s};
    const int near = s > 0.5, turns = END * near + 3;
    memset(out->r, 0, sizeof out->r);
    memcpy(out->R, x[near].R, sizeof out->R);
    memset(out->P, 0, 3 * N * sizeof *out->P);
    memset(out->T, 0, 3 * N * sizeof *out->T);
    if (out->H != NULL)
        memset(out->H, 0, N * N * sizeof *out->H);
    for (int k = 0; k < 2; k++) {
        const double n[3] = {x[k].R[0], x[k].R[3], x[k].R[6]},
                     spin[9] = {0, n[2], -n[1], -n[2], 0, n[0], n[1], -n[0], 0}; /* -n~ */
        for (int i = 0; i < 3; i++) {
            out->r[i] += part[k] * x[k].r[i] + lean[k] * n[i];
            out->P[N * i + END * k + i] = part[k];
            for (int j = 0; j < 3; j++)
                out->P[N * i + END * k + 3 + j] = lean[k] * spin[3 * i + j];
        }
        if (out->H != NULL)
            add_second(END * k + 3, lean[k], n, out->force, out->H);
    }
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        out->T[N * i + turns + i] = 1;
        if (out->H == NULL)
            continue;
        out->H[N * (turns + k) + turns + j] += out->moment[i] / 2;
        out->H[N * (turns + j) + turns + k] -= out->moment[i] / 2;
    }
}

static void line(const element_data *data, const node_state x[], int count, line_output out[])
{
    (void)data;
    for (int i = 0; i < count; i++)
        section_at(x, &out[i]);
}

typedef struct loaded {
    scene s;
    element_type type;
    formulation chosen;
    model *m;
    run_state run;
    equations eq;
} loaded;

static void begin(const scene_load *load, int own, loaded *of)
{
    const double y[3] = {0, 1, 0}, end = 1;
    section_spec spec = section_spec_rectangle(2e5, 8e4, 0.2, 0.1);
    fault f = {""};
    memset(of, 0, sizeof *of);
    scene_init(&of->s, "line");
    scene_add_member(&of->s, scene_add_node(&of->s, 0, 0, 0), scene_add_node(&of->s, L, 0, 0),
                     scene_add_section(&of->s, &spec), y);
    scene_add_static(&of->s, 1, &end, 1);
    scene_omit(&of->s, SCENE_OMITTABLE);
    scene_load *to = scene_load_at(&of->s, scene_add_load(&of->s, load->kind, 0, load->vector[0],
                                                          load->vector[1], load->vector[2]));
    memcpy(to->at, load->at, sizeof to->at);
    memcpy(to->range, load->range, sizeof to->range);
    to->follower = load->follower;
    gsl_test(formulation_parse("beamw_vlasov", &of->chosen, &f) != STATUS_OK ||
                 scene_validate(&of->s, &f) != STATUS_OK,
             "%s", f.text);
    of->type = *of->chosen.type;
    of->type.along = NULL;
    of->type.line = own ? line : NULL;
    const model_request request = {&of->s, &of->type, of->chosen.option, 1, 0, 0};
    gsl_test(model_alloc(&request, &of->m, &f) != STATUS_OK, "%s", f.text);
    run_state_begin(&of->run, of->m, 1, NULL);
    of->eq = (equations){.m = of->m, .run = &of->run};
}

static void end(loaded *of)
{
    run_state_end(&of->run);
    model_free(of->m);
    scene_free(&of->s);
}

static void forces_of(const loaded *of, const node_state x[], double F[N], double K[])
{
    memset(F, 0, N * sizeof *F);
    if (K != NULL)
        memset(K, 0, N * N * sizeof *K);
    distributed_add_one(&of->eq, kinematics_rest(of->m), x, 0, &of->s.load[0], 1, F, K);
}

/* Compares K with the derivative of -F from sixth-order finite differences in the exponential
 * chart. */
static void derivative(const scene_load *load, const char *name)
{
    static const double weight[] = {0.75, -0.15, 1 / 60.0};
    loaded of;
    node_state x[2];
    double d[N], F[N], K[N * N], worst = 0, size = 0;
    begin(load, 1, &of);
    nodes_increments(2, L, 1.5, 7, d);
    nodes_place(2, L, d, x);
    forces_of(&of, x, F, K);
    for (int j = 0; j < N; j++) {
        const int k = j % END - 3, first = j - k;
        double column[N] = {0}, one[N] = {0};
        one[j] = 0.01;
        for (int step = -3; step <= 3; step++) {
            node_state moved[2] = {x[0], x[1]};
            double there[N];
            nodes_move(2, step, one, moved);
            forces_of(&of, moved, there, NULL);
            for (int i = 0; i < N && step != 0; i++)
                column[i] += weight[abs(step) - 1] * (step > 0 ? there[i] : -there[i]) / one[j];
        }
        if (k >= 0 && k < 3) {
            column[first + (k + 1) % 3] += F[first + (k + 2) % 3] / 2;
            column[first + (k + 2) % 3] -= F[first + (k + 1) % 3] / 2;
        }
        for (int i = 0; i < N; i++) {
            worst = worst_of(worst, fabs(K[N * i + j] + column[i]));
            size = fmax(size, fabs(column[i]));
        }
    }
    gsl_test(!(worst < 1e-9 * size), "%s: the stiffness is %.2g off, relative to %.2g", name, worst,
             size);
    end(&of);
}

static void same(const scene_load *load, const char *name)
{
    loaded own, common;
    node_state x[2];
    double F[2][N];
    nodes_straight(2, L, x);
    begin(load, 1, &own);
    begin(load, 0, &common);
    forces_of(&own, x, F[0], NULL);
    forces_of(&common, x, F[1], NULL);
    for (int i = 0; i < N; i++)
        gsl_test(!(fabs(F[0][i] - F[1][i]) < 1e-13), "%s: force %d is %.15g instead of %.15g", name,
                 i, F[0][i], F[1][i]);
    end(&own);
    end(&common);
}

int main(void)
{
    static const struct {
        const char *name;
        scene_load load;
    } all[] = {
        {"dead", {.kind = SCENE_DISTRIBUTED, .vector = {0.3, -1, 0.7}, .range = {0, 1}}},
        {"eccentric",
         {.kind = SCENE_DISTRIBUTED,
          .vector = {0.3, -1, 0.7},
          .range = {0, 1},
          .at = {0, 0.2, 0.1}}},
        {"moment", {.kind = SCENE_DISTRIBUTED_MOMENT, .vector = {0.3, -1, 0.7}, .range = {0, 1}}},
        {"follower",
         {.kind = SCENE_DISTRIBUTED, .vector = {0.3, -1, 0.7}, .range = {0, 1}, .follower = 1}},
        {"eccentric follower",
         {.kind = SCENE_DISTRIBUTED,
          .vector = {0.3, -1, 0.7},
          .range = {0, 1},
          .at = {0, 0.2, 0.1},
          .follower = 1}},
        {"follower moment",
         {.kind = SCENE_DISTRIBUTED_MOMENT,
          .vector = {0.3, -1, 0.7},
          .range = {0, 1},
          .follower = 1}},
    };
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        derivative(&all[i].load, all[i].name);
    same(&all[0].load, all[0].name);
    return gsl_test_summary();
}
