/* Dimensions of motions are those of exact axes, whatever round-off and units do to the computed
 * ones. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/test/random.h"
#include "harness/model/model.h"

/* Columns of T: `shifts` displacements along the axes, then turns about unit axes in a plane (or
 * in space) of random orientation, seen at an offset of about `length`. */
static int fill(uint64_t *state, int shifts, int turns, int in_plane, double length, double T[36])
{
    const int columns = shifts + turns;
    double normal[3], offset[3], axis[3];
    memset(T, 0, 36 * sizeof *T);
    for (int i = 0; i < 3; i++) {
        normal[i] = random_number(state);
        offset[i] = shifts == 0 ? length * random_number(state) : 0;
    }
    for (int k = 0; k < shifts; k++)
        T[k * columns + k] = 1;
    for (int k = 0; k < turns; k++) {
        double any[3] = {random_number(state), random_number(state), random_number(state)},
               moved[3];
        vec3_cross(normal, any, axis);
        const double *turn = in_plane ? axis : any, size = vec3_norm(turn);
        vec3_cross(turn, offset, moved);
        for (int i = 0; i < 3; i++) {
            T[(3 + i) * columns + shifts + k] = turn[i] / size * (1 + 2e-16 * random_number(state));
            T[i * columns + shifts + k] += moved[i] / size;
        }
    }
    return columns;
}

static double apart_from_unit(const movable *v)
{
    double worst = 0;
    for (int i = 0; i < v->count; i++)
        for (int j = 0; j < v->count; j++) {
            double sum = i == j ? -1 : 0;
            for (int k = 0; k < 6; k++)
                sum += v->dual[6 * i + k] * v->span[v->count * k + j];
            worst = fmax(worst, fabs(sum));
        }
    return worst;
}

/* What is left of a column outside the span. */
static double outside(int columns, const double *T, double length, const movable *v)
{
    double worst = 0;
    for (int k = 0; k < columns; k++)
        for (int i = 0; i < 6; i++) {
            double rest = T[i * columns + k];
            for (int j = 0; j < v->count; j++)
                for (int l = 0; l < 6; l++)
                    rest -= v->span[v->count * i + j] * v->dual[6 * j + l] * T[l * columns + k];
            worst = fmax(worst, fabs(rest) / (i < 3 ? fmax(1, length) : 1));
        }
    return worst;
}

static void dimensions(void)
{
    static const double length[] = {1e-6, 1, 1e4};
    uint64_t state = 7;
    for (int trial = 0; trial < 600; trial++) {
        const int shifts = trial % 4, turns = trial / 4 % 4, in_plane = trial / 16 % 2;
        const double size = length[trial / 32 % 3];
        const int most = in_plane ? 2 : 3, rank = shifts + (turns < most ? turns : most);
        double T[36];
        movable v;
        const int columns = fill(&state, shifts, turns, in_plane, size, T);
        movable_of(columns, T, size, &v);
        gsl_test(v.count != rank, "%d displacements and %d turns%s, size %g: %d dimensions", shifts,
                 turns, in_plane ? " in a plane" : "", size, v.count);
        gsl_test(!(apart_from_unit(&v) <= 1e-14), "dual and span: %.1e", apart_from_unit(&v));
        gsl_test(!(outside(columns, T, size, &v) <= 1e-12), "columns lie in the span: %.1e",
                 outside(columns, T, size, &v));
    }
}

/* Two turns span the plane of x and y but for round-off: whole components, the third stays exactly
 * out. */
static void whole_components(void)
{
    const double c = cos(0.35), s = sin(0.35),
                 T[12] = {0, 0, 0, 0, 0, 0, -s, c, c, s, 1e-17, -3e-17};
    movable v;
    movable_of(2, T, 0.06, &v);
    gsl_test(v.count != 2 || v.components != 0x18, "the plane of two components: %d, %x", v.count,
             v.components);
    for (int i = 0; i < 12; i++)
        gsl_test(v.span[i] != (double)(i == 6 || i == 9), "unit vectors: %g at %d", v.span[i], i);
}

/* Columns of one component each, one of them twice and one that is nothing: the same motions as
 * those of columns that are not known to be such by their zeros. */
static void components_alone(void)
{
    const double alone[24] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0,
                              0, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0};
    double beside[24];
    movable v, w;
    memcpy(beside, alone, sizeof beside);
    beside[0] = 1e-17;
    movable_of(4, alone, 0.1, &v);
    movable_of(4, beside, 0.1, &w);
    gsl_test(v.count != 2 || !v.whole || v.component[0] != 2 || v.component[1] != 4,
             "components alone: %d of them", v.count);
    gsl_test(memcmp(&v, &w, sizeof v) != 0, "the same motions");
}

/* One driver behind two opposite turns moves nothing. */
static void nothing(void)
{
    const double T[6] = {1e-19, 0, 0, 1e-17, -1e-17, 0};
    movable v;
    movable_of(1, T, 1, &v);
    gsl_test(v.count != 0 || v.components != 0, "turns that cancel: %d dimensions", v.count);
    movable_of(0, T, 1, &v);
    gsl_test(v.count != 0, "no coordinates: %d dimensions", v.count);
}

/* Free turns exert no moment: what is left is across them, and exactly nothing when they span
 * space. */
static void prescribed_moment(void)
{
    uint64_t state = 3;
    for (int turns = 0; turns < 4; turns++)
        for (int in_plane = 0; in_plane < 2; in_plane++) {
            double T[36], left[3];
            const double m[3] = {0.3, -0.2, 0.9};
            const int columns = fill(&state, 3, turns, in_plane, 1, T);
            movable_prescribed(columns, T, m, left);
            for (int k = 3; k < columns; k++) {
                double along = 0;
                for (int i = 0; i < 3; i++)
                    along += T[(3 + i) * columns + k] * left[i];
                gsl_test(!(fabs(along) <= 1e-14), "%d turns: %.1e left along one of them", turns,
                         along);
            }
            gsl_test((vec3_norm(left) == 0) != (turns == 3 && !in_plane),
                     "%d turns%s: %g is prescribed", turns, in_plane ? " in a plane" : "",
                     vec3_norm(left));
            gsl_test(turns == 0 && memcmp(left, m, sizeof left) != 0, "no turns: all of it");
        }
}

int main(void)
{
    dimensions();
    whole_components();
    components_alone();
    nothing();
    prescribed_moment();
    return gsl_test_summary();
}
