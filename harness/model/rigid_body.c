/* A rigid body in a frame that rotates with Omega. x is the vector from a point on the axis to the
 * centre of the body, I = R I_0 R^T is the inertia about the centre, and h = I Omega. The potential
 * is -1/2 (m |Omega x x|^2 + Omega . h). Terms about the centre, for translations and for rotations
 * in the exponential chart: centrifugal force -m Omega x (Omega x x) and moment h x Omega;
 * softening m Omega~^2 and Omega~ I Omega~ - sym(h Omega^T) + (h . Omega) 1; gyroscopic matrix 2 m
 * Omega~ and I Omega~ + Omega~ I - h~, even if the body rotates in the frame. The rigid offset
 * transforms these terms to the node. */
#include "harness/model/model_impl.h"

#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"

enum { N = NODE_COORDINATES };

static void inertia_now(const double given[6], const double R[9], double I[9])
{
    const double at_rest[9] = {given[0], given[3], given[5], given[3], given[1],
                               given[4], given[5], given[4], given[2]};
    double half[9];
    mat3_mul(R, at_rest, half);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            I[3 * i + j] = vec3_dot(&half[3 * i], &R[3 * j]);
}

static void put_blocks(const double translation[9], const double rotation[9], double A[N * N])
{
    memset(A, 0, N * N * sizeof *A);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            A[N * i + j] = translation[3 * i + j];
            A[N * (3 + i) + 3 + j] = rotation[3 * i + j];
        }
}

static void mass_matrix(double mass, const double I[9], double M[N * N])
{
    const double translation[9] = {mass, 0, 0, 0, mass, 0, 0, 0, mass};
    put_blocks(translation, I, M);
}

static void cross_matrix(const double v[3], double A[9])
{
    const double all[9] = {0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0};
    memcpy(A, all, sizeof all);
}

static void gyroscopic_matrix(double mass, const double I[9], const double omega[3],
                              double G[N * N])
{
    double W[9], IW[9], WI[9], h[3], H[9], translation[9], rotation[9];
    cross_matrix(omega, W);
    mat3_mul(I, W, IW);
    mat3_mul(W, I, WI);
    mat3_mul_vec(I, omega, h);
    cross_matrix(h, H);
    for (int i = 0; i < 9; i++) {
        translation[i] = 2 * mass * W[i];
        rotation[i] = IW[i] + WI[i] - H[i];
    }
    put_blocks(translation, rotation, G);
}

static void softening_matrix(double mass, const double I[9], const double omega[3], double A[N * N])
{
    double W[9], IW[9], h[3], translation[9], rotation[9];
    cross_matrix(omega, W);
    mat3_mul(I, W, IW);
    mat3_mul_vec(I, omega, h);
    mat3_mul(W, W, translation);
    mat3_mul(W, IW, rotation);
    const double twice = vec3_dot(h, omega);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            translation[3 * i + j] *= mass;
            rotation[3 * i + j] += (i == j ? twice : 0) - (h[i] * omega[j] + omega[i] * h[j]) / 2;
        }
    put_blocks(translation, rotation, A);
}

/* Computes the centrifugal force and moment about the centre. Returns the potential [J]. */
static double centrifugal(double mass, const double I[9], const double x[3], const double omega[3],
                          double force[N])
{
    double h[3], speed[3];
    memset(force, 0, N * sizeof *force);
    mat3_mul_vec(I, omega, h);
    vec3_cross(omega, x, speed);
    vec3_cross(speed, omega, force);
    for (int i = 0; i < 3; i++)
        force[i] *= mass;
    vec3_cross(h, omega, force + 3);
    return -(mass * vec3_dot(speed, speed) + vec3_dot(omega, h)) / 2;
}

void body_inertia(const scene_body *b, const node_state *x, const element_rotating_frame *frame,
                  inertia_output *out)
{
    static const element_rotating_frame none = {{0, 0, 0}, {0, 0, 0}};
    const element_rotating_frame *s = frame != NULL ? frame : &none;
    double I[9], rho[3], from[3], outward[N], inward[N];
    inertia_now(b->inertia, x->R, I);
    mat3_mul_vec(x->R, b->centre, rho);
    for (int i = 0; i < 3; i++)
        from[i] = x->r[i] + rho[i] - s->centre[i];
    const double potential = centrifugal(b->mass, I, from, s->omega, outward);
    for (int i = 0; i < N; i++)
        inward[i] = -outward[i];
    if (out->potential != NULL)
        *out->potential = potential;
    if (out->M != NULL) {
        mass_matrix(b->mass, I, out->M);
        offset_matrix(N, 0, rho, NULL, out->M);
    }
    if (out->G != NULL) {
        gyroscopic_matrix(b->mass, I, s->omega, out->G);
        offset_matrix(N, 0, rho, NULL, out->G);
    }
    if (out->N != NULL) {
        softening_matrix(b->mass, I, s->omega, out->N);
        offset_matrix(N, 0, rho, inward, out->N);
    }
    if (out->force != NULL) {
        offset_force(rho, outward);
        memcpy(out->force, outward, sizeof outward);
    }
}
