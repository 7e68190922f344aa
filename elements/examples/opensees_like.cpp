/* Elements that were written for OpenSees, or for Kratos, as formulations. `Adapted` calls an
 * element as OpenSees does: it sets the trial displacements of the nodes, then calls update,
 * getResistingForce, getTangentStiff and commitState. The history of beamwork stores the committed
 * state, which the element sends with sendSelf. To use your element, replace Vector, Matrix,
 * Channel and Node by the headers of your program, and Beam by your class. FromKratos gives an
 * element of Kratos these functions; compile with -DELEMENT=FromKratos to try it.
 *
 *   c++ -std=c++17 -O2 -shared -fPIC -I FOLDER_OF_BEAMWORK opensees_like.cpp -o opensees_like.so
 *   beamwork element-test --element ./opensees_like.so */
#include <algorithm>
#include <array>
#include <cmath>

#include "elements/element.h"

namespace
{

constexpr int N = 12; /* degrees of freedom: displacements and rotations of two nodes */
using Triad = std::array<double, 9>;

/* --- the classes of the program that an element uses --- */
struct Vector {
    std::array<double, N> v{};
    double &operator()(int i) { return v[i]; }
};
struct Matrix {
    std::array<double, N * N> v{};
    double &operator()(int i, int j) { return v[i * N + j]; }
};
struct Channel { /* in memory */
    double *at;
    void send(const double *from, int count) { at = std::copy(from, from + count, at); }
    void receive(double *to, int count) { std::copy(at, at + count, to), at += count; }
};
struct Node {
    double crds[3], commit[6], increment[6];
    double getCrds(int i) const { return crds[i]; }
    double getTrialDisp(int i) const { return commit[i] + increment[i]; }
    double getIncrDisp(int i) const { return increment[i]; } /* since the last commit */
};

/* A B, where A = exp(t~) */
Triad rotated(const double t[3], const Triad &B)
{
    const double s = std::sqrt(t[0] * t[0] + t[1] * t[1] + t[2] * t[2]), half = std::sin(s / 2);
    const double a = s > 1e-8 ? std::sin(s) / s : 1, b = s > 1e-8 ? 2 * half * half / (s * s) : 0.5;
    const double skew[9] = {0, -t[2], t[1], t[2], 0, -t[0], -t[1], t[0], 0};
    Triad C{};
    for (int i = 0; i < 27; i++) {
        const int row = i / 9, k = i / 3 % 3;
        const double A = (row == k) * (1 - b * s * s) + a * skew[3 * row + k] + b * t[row] * t[k];
        C[3 * row + i % 3] += A * B[3 * k + i % 3];
    }
    return C;
}

/* --- an element in the form required by OpenSees: the strains are products of the chord and of the
 * axes of the nodes, which are updated by increments of rotation and committed --- */
class Beam
{
  public:
    Beam(const double stiffness[6], const Node *a, const Node *b) : C(stiffness), node{a, b} {}
    void setAxes(const Triad &axes) { state = {axes, axes}; }

    int update()
    {
        for (int k = 0; k < 2; k++) {
            const double t[3] = {node[k]->getIncrDisp(3), node[k]->getIncrDisp(4),
                                 node[k]->getIncrDisp(5)};
            trial[k] = rotated(t, state[k]);
        }
        double length = 0;
        for (int i = 0; i < 3; i++) {
            const double initial = node[1]->getCrds(i) - node[0]->getCrds(i);
            length += initial * initial;
            chord[i] = initial + node[1]->getTrialDisp(i) - node[0]->getTrialDisp(i);
        }
        P = {};
        K = {};
        for (int i = 0; i < 6; i++) {
            std::array<double, N> slope{};
            double e = i == 0 ? -std::sqrt(length) : 0;
            const int a = (i + 1) % 3, b = (i + 2) % 3;
            const Term terms[2] = {i < 3 ? Term{-1, i, 0, i, 0.5} : Term{0, a, 1, b, 0.5},
                                   i < 3 ? Term{-1, i, 1, i, 0.5} : Term{0, b, 1, a, -0.5}};
            for (const Term &t : terms)
                e += add(t, &slope, 0);
            for (const Term &t : terms)
                add(t, nullptr, C[i] * e);
            for (int j = 0; j < N * N; j++)
                K.v[j] += C[i] * slope[j / N] * slope[j % N];
            for (int j = 0; j < N; j++)
                P(j) += C[i] * e * slope[j];
        }
        return 0;
    }
    const Vector &getResistingForce() const { return P; }
    const Matrix &getTangentStiff() const { return K; }
    int commitState() { return state = trial, 0; }
    void sendSelf(Channel &to) const { to.send(state[0].data(), 9), to.send(state[1].data(), 9); }
    void recvSelf(Channel &from)
    {
        from.receive(state[0].data(), 9), from.receive(state[1].data(), 9);
    }
    [[maybe_unused]] static constexpr int values = 18;

  private:
    /* A strain: weight times the product of an axis, or the chord (node -1), with another axis. */
    struct Term {
        int node, axis, other, second;
        double weight;
    };

    /* Returns the term. Adds its first derivative to `slope`, or, without it, stress times its
     * second derivative to K. Rotations are spatial increments. */
    double add(const Term &t, std::array<double, N> *slope, double stress)
    {
        double a[3], b[3], dot = 0;
        for (int i = 0; i < 3; i++) {
            a[i] = t.node < 0 ? chord[i] : trial[t.node][3 * i + t.axis];
            b[i] = trial[t.other][3 * i + t.second];
            dot += a[i] * b[i];
        }
        const int A = t.node < 0 ? 6 : 3 + 6 * t.node, B = 3 + 6 * t.other;
        const double w = t.weight * stress;
        const bool turns = t.node >= 0;
        for (int i = 0; i < 3; i++) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            const double cross = t.weight * (a[j] * b[k] - a[k] * b[j]);
            if (slope != nullptr) {
                (*slope)[B + i] -= cross;
                (*slope)[A + i] += turns ? cross : t.weight * b[i];
                (*slope)[i] -= turns ? 0 : t.weight * b[i];
                continue;
            }
            for (int c = 0; c < 3; c++) { /* d(b x a) = (phi_b x b) x a + b x da */
                K(B + i, B + c) += w * (b[i] * a[c] - (i == c) * dot);
                if (turns) {
                    K(A + i, A + c) += w * (a[i] * b[c] - (i == c) * dot);
                    K(A + i, B + c) += w * ((i == c) * dot - b[i] * a[c]);
                    K(B + i, A + c) += w * ((i == c) * dot - a[i] * b[c]);
                }
            }
            for (int c = 0; c < 2 && !turns; c++) { /* the chord: u of node 1 minus u of node 0 */
                const double sign = c == 0 ? -w : w;
                K(B + i, 6 * c + k) += sign * b[j];
                K(B + i, 6 * c + j) -= sign * b[k];
                K(6 * c + k, B + i) += sign * b[j];
                K(6 * c + j, B + i) -= sign * b[k];
            }
        }
        return t.weight * dot;
    }

    const double *C; /* [6] stiffness [N/m] of the elongations and [N m] of the rotations */
    const Node *node[2];
    double chord[3] = {};
    std::array<Triad, 2> state{}, trial{};
    Vector P;
    Matrix K;
};

/* --- the same element in the form required by Kratos, and its conversion to OpenSees --- */
class KratosBeam : Beam
{
  public:
    using Beam::Beam, Beam::setAxes, Beam::values;
    void FinalizeNonLinearIteration() { update(); }
    void CalculateLocalSystem(Matrix &lhs, Vector &rhs)
    {
        lhs = getTangentStiff();
        for (int i = 0; i < N; i++)
            rhs(i) = -getResistingForce().v[i];
    }
    void FinalizeSolutionStep() { commitState(); }
    void save(Channel &to) const { sendSelf(to); }
    void load(Channel &from) { recvSelf(from); }
};
class FromKratos
{
  public:
    FromKratos(const double stiffness[6], const Node *a, const Node *b) : element(stiffness, a, b)
    {
    }
    void setAxes(const Triad &axes) { element.setAxes(axes); }
    int update()
    {
        element.FinalizeNonLinearIteration();
        element.CalculateLocalSystem(K, P);
        for (double &p : P.v)
            p = -p;
        return 0;
    }
    const Vector &getResistingForce() const { return P; }
    const Matrix &getTangentStiff() const { return K; }
    int commitState() { return element.FinalizeSolutionStep(), 0; }
    void sendSelf(Channel &to) const { element.save(to); }
    void recvSelf(Channel &from) { element.load(from); }
    [[maybe_unused]] static constexpr int values = KratosBeam::values;

  private:
    KratosBeam element;
    Vector P;
    Matrix K;
};

#ifndef ELEMENT
#define ELEMENT Beam
#endif

/* --- the adapter --- */

/* The history: rotations and accumulated rotation increments of the nodes, state of the element. */
struct Memory {
    double R[2][9], turned[2][3], element[ELEMENT::values];
};

/* Computes the rotation vector of R S^T, with a magnitude below pi. */
void increment(const double R[9], const double S[9], double t[3])
{
    double A[9] = {};
    for (int i = 0; i < 27; i++)
        A[i / 9 * 3 + i % 3] += R[i / 9 * 3 + i / 3 % 3] * S[i % 3 * 3 + i / 3 % 3];
    const double axis[3] = {(A[7] - A[5]) / 2, (A[2] - A[6]) / 2, (A[3] - A[1]) / 2};
    const double sine = std::sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    const double angle = std::atan2(sine, (A[0] + A[4] + A[8] - 1) / 2);
    for (int i = 0; i < 3; i++)
        t[i] = axis[i] * (sine > 0 ? angle / sine : 1);
}

/* An element and its nodes, in the state x that is reached from the history. */
struct Adapted {
    Node node[2];
    ELEMENT element;
    Adapted(const double stiffness[6], const node_state x[], Memory memory)
        : element(stiffness, &node[0], &node[1])
    {
        for (int k = 0; k < 2; k++) {
            double t[3];
            increment(x[k].R, memory.R[k], t);
            for (int i = 0; i < 3; i++) {
                node[k].crds[i] = x[k].r[i] - x[k].u[i];
                node[k].commit[i] = 0;
                node[k].increment[i] = x[k].u[i];
                node[k].commit[3 + i] = memory.turned[k][i];
                node[k].increment[3 + i] = t[i];
            }
        }
        Channel from{memory.element};
        element.recvSelf(from);
        element.update();
    }
};

} // namespace

struct element_data {
    double stiffness[6];
};

static size_t data_size(const element_request *)
{
    return sizeof(element_data);
}

static status prepare(const element_request *request, element_data *out, fault *)
{
    const section &c = *request->section;
    const double l = request->length;
    /* transverse stiffness: shear if requested, and bending that a uniform curvature omits */
    const double shear = request->features & FEATURE_SHEAR ? l / c.shear_modulus : 0;
    *out = {{c.young * c.A / l, 1 / (shear * c.F[0] + l * l * l / (12 * c.young * c.Iz)),
             1 / (shear * c.F[4] + l * l * l / (12 * c.young * c.Iy)), c.shear_modulus * c.It / l,
             c.young * c.Iy / l, c.young * c.Iz / l}};
    return STATUS_OK;
}

static void begin(const element_data *d, const node_state x[], double history[])
{
    Memory memory{};
    Triad axes{};
    Node none[2]{};
    ELEMENT element(d->stiffness, &none[0], &none[1]);
    std::copy(x[0].R, x[0].R + 9, axes.begin());
    element.setAxes(axes);
    for (int k = 0; k < 2; k++)
        std::copy(x[k].R, x[k].R + 9, memory.R[k]);
    Channel to{memory.element};
    element.sendSelf(to);
    *reinterpret_cast<Memory *>(history) = memory;
}

static status force(const element_data *d, const node_state x[], force_output *out)
{
    Adapted now(d->stiffness, x, *reinterpret_cast<const Memory *>(out->history));
    constexpr int all = 2 * NODE_COORDINATES;
    if (out->F != nullptr)
        std::fill(out->F, out->F + all, 0);
    if (out->K != nullptr)
        std::fill(out->K, out->K + all * all, 0);
    for (int i = 0; i < N; i++) {
        const int row = i + i / 6; /* the seventh coordinate of a node is its warping amplitude */
        if (out->F != nullptr)
            out->F[row] = now.element.getResistingForce().v[i];
        for (int j = 0; j < N && out->K != nullptr; j++)
            out->K[row * all + j + j / 6] = now.element.getTangentStiff().v[i * N + j];
    }
    return STATUS_OK;
}

static void commit(const element_data *d, const node_state x[], double history[])
{
    Memory &memory = *reinterpret_cast<Memory *>(history);
    Adapted now(d->stiffness, x, memory);
    now.element.commitState();
    for (int k = 0; k < 2; k++) {
        std::copy(x[k].R, x[k].R + 9, memory.R[k]);
        for (int i = 0; i < 3; i++)
            memory.turned[k][i] = now.node[k].getTrialDisp(3 + i);
    }
    Channel to{memory.element};
    now.element.sendSelf(to);
}

static int history(const double *)
{
    return sizeof(Memory) / sizeof(double);
}

static element_type described()
{
    element_type t{};
    t.abi = ELEMENT_ABI;
    t.size = sizeof t;
    t.name = "opensees_like";
    t.summary = "an element with the functions of OpenSees: two nodes, one point, committed axes";
    t.source = "class Beam in opensees_like.cpp";
    t.family = "example";
    t.offers =
        FEATURE_SHEAR | FEATURE_GEOMETRIC | FEATURE_LARGE | FEATURE_MASS | FEATURE_ROTARY_INERTIA;
    t.shear_theories = SHEAR_HARINGX;
    t.limits = LIMIT_DOUBLY_SYMMETRIC | LIMIT_QUARTER_TURN;
    t.data_size = data_size;
    t.prepare = prepare;
    t.force = force;
    t.history = history;
    t.begin = begin;
    t.commit = commit;
    return t;
}

extern const element_type beamwork_element = described();
