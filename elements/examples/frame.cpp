/* The corotational beam of corotational.c in C++17, given by its strains: the elongation, the twist
 * and the rotations of both nodes relative to axes that follow the element. The type `number`
 * computes first and second derivatives (automatic differentiation), so only the strains themselves
 * are written.
 *
 *   c++ -std=c++17 -O2 -shared -fPIC -I FOLDER_OF_BEAMWORK frame.cpp -o frame.so
 *   beamwork verify --element ./frame.so -f frame */
#include <array>
#include <cmath>

#include "elements/element.h"

struct element_data {
    double length;
    double C[6][6]; /* sigma = C e [N/m] */
};

namespace
{

constexpr int STRAINS = 6, N = 12, COLUMNS = 2 * NODE_COORDINATES; /* N: without warping */

/* Column of a coordinate (displacement, rotation of both nodes) in J and H. */
constexpr int column(int i)
{
    return i + i / 6;
}

/* A number with its derivatives with respect to the N coordinates. */
struct number {
    double value, first[N] = {}, second[N][N] = {};
    number(double v) : value(v) {}
};

/* Returns f(x) from f and its derivatives at the value of x. */
number function(const number &x, double f, double df, double ddf)
{
    number y(f);
    for (int i = 0; i < N; i++) {
        y.first[i] = df * x.first[i];
        for (int j = 0; j < N; j++)
            y.second[i][j] = df * x.second[i][j] + ddf * x.first[i] * x.first[j];
    }
    return y;
}
number sqrt(const number &x)
{
    const double root = std::sqrt(x.value);
    return function(x, root, 0.5 / root, -0.25 / (root * x.value));
}
number operator+(const number &x, const number &y)
{
    number z(x.value + y.value);
    for (int i = 0; i < N; i++) {
        z.first[i] = x.first[i] + y.first[i];
        for (int j = 0; j < N; j++)
            z.second[i][j] = x.second[i][j] + y.second[i][j];
    }
    return z;
}
number operator*(const number &x, const number &y)
{
    number z(x.value * y.value);
    for (int i = 0; i < N; i++) {
        z.first[i] = x.first[i] * y.value + x.value * y.first[i];
        for (int j = 0; j < N; j++)
            z.second[i][j] = x.second[i][j] * y.value + x.first[i] * y.first[j] +
                             x.first[j] * y.first[i] + x.value * y.second[i][j];
    }
    return z;
}
number operator-(const number &x, const number &y)
{
    return x + function(y, -y.value, -1, 0);
}
number operator/(const number &x, const number &y)
{
    const double one = 1 / y.value;
    return x * function(y, one, -one * one, 2 * one * one * one);
}

struct vector {
    number x, y, z;
};
vector operator+(const vector &a, const vector &b)
{
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
vector operator-(const vector &a, const vector &b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
vector operator/(const vector &a, const number &b)
{
    return {a.x / b, a.y / b, a.z / b};
}
number dot(const vector &a, const vector &b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
vector cross(const vector &a, const vector &b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/* Position, displacement and axes of a node, whose coordinates are the variables: an axis b becomes
 * exp(dphi~) b, to second order in dphi. */
struct node {
    vector r, u, axis[3];
    node(const node_state &x, int first)
        : r{x.r[0], x.r[1], x.r[2]}, u{x.u[0], x.u[1], x.u[2]},
          axis{{x.R[0], x.R[3], x.R[6]}, {x.R[1], x.R[4], x.R[7]}, {x.R[2], x.R[5], x.R[8]}}
    {
        vector dr{0, 0, 0}, dphi{0, 0, 0};
        number *const variable[6] = {&dr.x, &dr.y, &dr.z, &dphi.x, &dphi.y, &dphi.z};
        for (int i = 0; i < 6; i++)
            variable[i]->first[first + i] = 1;
        r = r + dr;
        u = u + dr;
        for (vector &b : axis) {
            const vector turned = cross(dphi, b);
            b = b + turned + cross(dphi, turned) / 2;
        }
    }
};

std::array<number, STRAINS> strains_of(double l, const node_state x[])
{
    const node p(x[0], 0), q(x[1], 6);
    const vector chord = q.r - p.r, du = q.u - p.u;
    const number now = sqrt(dot(chord, chord));
    /* Axes: x along the chord, y in the plane of it and of the mean of the nodes' y axes. */
    const vector ex = chord / now, normal = cross(ex, p.axis[1] + q.axis[1]),
                 ez = normal / sqrt(dot(normal, normal)), E[3] = {ex, cross(ez, ex), ez};
    /* Returns l times the sine of the rotation of a node about axis i. */
    const auto turn = [&](const node &of, int i) {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        return (dot(E[b], of.axis[a]) - dot(E[a], of.axis[b])) * (l / 2);
    };
    /* Returns the elongation, without cancellation, from the change of the squared length. */
    return {dot(du, chord + chord - du) / (now + l),
            turn(q, 0) - turn(p, 0),
            turn(p, 1),
            turn(q, 1),
            turn(p, 2),
            turn(q, 2)};
}

std::size_t data_size(const element_request *)
{
    return sizeof(element_data);
}

status prepare(const element_request *request, element_data *out, fault *)
{
    const section &c = *request->section;
    const double l = request->length, shear = request->features & FEATURE_SHEAR ? 12 : 0;
    const double EI[] = {c.young * c.Iy, c.young * c.Iz}, F[] = {c.F[4], c.F[0]};
    *out = element_data{};
    out->length = l;
    out->C[0][0] = c.young * c.A / l;
    out->C[1][1] = c.shear_modulus * c.It / (l * l * l);
    for (int i = 0; i < 2; i++) { /* Timoshenko beam, or Bernoulli beam if phi = 0 */
        const int k = 2 + 2 * i;
        const double phi = shear * EI[i] * F[i] / (c.shear_modulus * l * l);
        out->C[k][k] = out->C[k + 1][k + 1] = (4 + phi) / (1 + phi) * EI[i] / (l * l * l);
        out->C[k][k + 1] = out->C[k + 1][k] = (2 - phi) / (1 + phi) * EI[i] / (l * l * l);
    }
    return STATUS_OK;
}

void strain(const element_data *d, const node_state x[], strain_output *out)
{
    const auto e = strains_of(d->length, x);
    for (int k = 0; k < STRAINS; k++) {
        if (out->e != nullptr)
            out->e[k] = e[k].value;
        for (int j = 0; j < COLUMNS && out->J != nullptr; j++)
            out->J[k * COLUMNS + j] = 0;
        for (int j = 0; j < N && out->J != nullptr; j++)
            out->J[k * COLUMNS + column(j)] = e[k].first[j];
    }
    for (int i = 0; i < COLUMNS * COLUMNS && out->H != nullptr; i++)
        out->H[i] = 0;
    for (int i = 0; i < N * N && out->H != nullptr; i++)
        for (int k = 0; k < STRAINS; k++)
            out->H[column(i / N) * COLUMNS + column(i % N)] +=
                out->s[k] * e[k].second[i / N][i % N];
}

status stress(const element_data *d, const double e[], const double *, stress_output *out)
{
    double energy = 0;
    for (int i = 0; i < STRAINS; i++) {
        double sigma = 0;
        for (int j = 0; j < STRAINS; j++) {
            sigma += d->C[i][j] * e[j];
            if (out->C != nullptr)
                out->C[i * STRAINS + j] = d->C[i][j];
        }
        if (out->sigma != nullptr)
            out->sigma[i] = sigma;
        energy += sigma * e[i] / 2;
    }
    if (out->energy != nullptr)
        *out->energy = energy;
    if (out->residual != nullptr)
        *out->residual = 0;
    return STATUS_OK;
}

element_type frame()
{
    element_type t = {};
    t.abi = ELEMENT_ABI;
    t.size = sizeof t;
    t.name = "frame";
    t.summary = "corotational, two nodes, shear-deformable, without warping, in C++";
    t.source = "Crisfield, Comput. Methods Appl. Mech. Engrg. 81 (1990), as strains";
    t.family = "example";
    t.offers =
        FEATURE_SHEAR | FEATURE_GEOMETRIC | FEATURE_LARGE | FEATURE_MASS | FEATURE_ROTARY_INERTIA;
    t.shear_theories = SHEAR_ENGESSER;
    t.limits = LIMIT_DOUBLY_SYMMETRIC | LIMIT_QUARTER_TURN;
    t.data_size = data_size;
    t.prepare = prepare;
    t.strains = [](const double *) { return STRAINS; };
    t.strain = strain;
    t.stress = stress;
    return t;
}

} // namespace

const element_type beamwork_element = frame();
