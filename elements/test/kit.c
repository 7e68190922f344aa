#include "elements/test/kit.h"

#include <gsl/gsl_test.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"

uint64_t random_bits(uint64_t *seed)
{
    uint64_t z = *seed += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

double random_number(uint64_t *seed)
{
    return (double)(random_bits(seed) >> 11) / 4503599627370496.0 - 1;
}

int random_below(uint64_t *seed, int count)
{
    return (int)(random_bits(seed) % (uint64_t)count);
}

section sections_computed(const section_spec *spec)
{
    section c = {0};
    fault f = {""};
    gsl_test(section_compute(spec, &c, &f) != STATUS_OK, "a section is accepted: %s", f.text);
    return c;
}

section_spec sections_steel(section_kind kind)
{
    section_spec spec;
    section_spec_init(&spec);
    spec.kind = kind;
    spec.young = 2e11;
    spec.shear_modulus = 8e10;
    return spec;
}

section_spec sections_of(double A, double Iy, double Iz, double It)
{
    section_spec spec = section_spec_constants(1, 1);
    spec.constants = (section){
        .young = 1, .shear_modulus = 1, .A = A, .Iy = Iy, .Iz = Iz, .It = It, .Ip = Iy + Iz};
    return spec;
}

enum { COORDINATES = ELEMENT_MAX_COORDINATES, STRAINS = ELEMENT_MAX_STRAINS };

void nodes_straight(int nodes, double length, node_state x[])
{
    for (int k = 0; k < nodes; k++)
        x[k] = (node_state){.r = {length * k / (nodes - 1)}, .R = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
}

void nodes_turn(double R[9], const double turn[3])
{
    double q[4], T[9], old[9];
    memcpy(old, R, sizeof old);
    rotation_exp(turn, q);
    rotation_matrix(q, T);
    mat3_mul(T, old, R);
}

void nodes_move(int nodes, double times, const double d[], node_state x[])
{
    for (int k = 0; k < nodes; k++) {
        const double *step = d + NODE_COORDINATES * k;
        const double turn[3] = {times * step[3], times * step[4], times * step[5]};
        for (int i = 0; i < 3; i++) {
            x[k].r[i] += times * step[i];
            x[k].u[i] += times * step[i];
        }
        nodes_turn(x[k].R, turn);
        x[k].a += times * step[6];
    }
}

void nodes_place(int nodes, double length, const double d[], node_state x[])
{
    nodes_straight(nodes, length, x);
    nodes_move(nodes, 1, d, x);
}

void nodes_increments(int nodes, double length, double size, unsigned seed, double d[])
{
    uint64_t state = seed;
    const double unit[NODE_COORDINATES] = {length, length, length, 1, 1, 1, 1 / length};
    for (int i = 0; i < NODE_COORDINATES * nodes; i++)
        d[i] = size / 2 * random_number(&state) * unit[i % NODE_COORDINATES];
}

static double largest(int n, const double a[])
{
    double out = 0;
    for (int i = 0; i < n; i++)
        out = worst_of(out, fabs(a[i]));
    return out;
}

/* Converts the change dm of the spatial gradient m = J^T s to the expected value of H d. In the
 * exponential chart of x, the gradient of s . e changes by dm - theta x m/2. */
static void into_chart(int nodes, const double d[], const double m[], double dm[])
{
    for (int k = 0; k < nodes; k++) {
        const int first = NODE_COORDINATES * k + 3;
        double moment[3];
        vec3_cross(d + first, m + first, moment);
        for (int i = 0; i < 3; i++)
            dm[first + i] -= moment[i] / 2;
    }
}

static double apart(int n, const double a[], const double b[])
{
    double worst = 0;
    for (int i = 0; i < n; i++)
        worst = worst_of(worst, fabs(a[i] - b[i]));
    return worst / largest(n, b);
}

static void rates(const element_type *type, const element_data *data, int nodes, int strains,
                  const node_state x[], const double d[], const double s[], double de[],
                  double dm[])
{
    static const double at[4] = {-2, -1, 1, 2}, factor[4] = {1, -8, 8, -1}, h = 1e-3;
    const int n = NODE_COORDINATES * nodes;
    memset(de, 0, (size_t)strains * sizeof *de);
    memset(dm, 0, (size_t)n * sizeof *dm);
    for (int t = 0; t < 4; t++) {
        double e[STRAINS], J[STRAINS * COORDINATES], m[COORDINATES] = {0};
        node_state moved[ELEMENT_MAX_NODES];
        memcpy(moved, x, (size_t)nodes * sizeof *x);
        nodes_move(nodes, at[t] * h, d, moved);
        type->strain(data, moved, &(strain_output){.e = e, .J = J});
        for (int i = 0; i < strains; i++)
            de[i] += factor[t] * e[i] / (12 * h);
        dense_add_transpose_mul(n, strains, 1, J, s, m);
        for (int i = 0; i < n; i++)
            dm[i] += factor[t] * m[i] / (12 * h);
    }
}

nodes_departure nodes_differences(const element_type *type, const element_data *data, int nodes,
                                  int strains, const node_state x[], const double d[],
                                  const double s[])
{
    const int n = NODE_COORDINATES * nodes;
    double J[STRAINS * COORDINATES], H[COORDINATES * COORDINATES], de[STRAINS], along[STRAINS];
    double dm[COORDINATES], m[COORDINATES] = {0}, Hd[COORDINATES];
    type->strain(data, x, &(strain_output){.J = J, .s = s, .H = H});
    dense_mul_vec(strains, n, J, d, along);
    dense_mul_vec(n, n, H, d, Hd);
    dense_add_transpose_mul(n, strains, 1, J, s, m);
    rates(type, data, nodes, strains, x, d, s, de, dm);
    into_chart(nodes, d, m, dm);
    return (nodes_departure){apart(strains, de, along), apart(n, Hd, dm), nodes_asymmetry(n, H)};
}

double nodes_asymmetry(int n, const double A[])
{
    double worst = 0;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < i; j++)
            worst = worst_of(worst, fabs(A[n * i + j] - A[n * j + i]));
    return worst / largest(n * n, A);
}
