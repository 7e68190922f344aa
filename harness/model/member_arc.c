#include "harness/model/member_arc.h"
#include "cases/scene/names.h"

#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"

/* int_0^s exp(t k~) e_x dt in the triad at p. */
static void chord_of(const double k[3], double s, double c[3])
{
    const double w = vec3_norm(k), angle = w * s;
    double first[3], second[3];
    const double e[3] = {1, 0, 0};
    vec3_cross(k, e, first);
    vec3_cross(k, first, second);
    const double half = sin(angle / 2);
    const double a =
        angle < 1e-4 ? s * s / 2 * (1 - angle * angle / 12) : 2 * half * half / (w * w);
    const double b = angle < 1e-2
                         ? s * s * s / 6 * (1 - angle * angle / 20 * (1 - angle * angle / 42))
                         : (angle - sin(angle)) / (w * w * w);
    for (int i = 0; i < 3; i++)
        c[i] = s * e[i] + a * first[i] + b * second[i];
}

/* From the axes in which a section is described, about which the scene speaks, to its principal
 * ones. */
static void turn_to_principal(double angle, member_arc *a)
{
    const double c = cos(angle), d = sin(angle), ky = a->k[1];
    if (d == 0)
        return;
    for (int i = 0; i < 9; i += 3) {
        const double y = a->R[i + 1];
        a->R[i + 1] = c * y + d * a->R[i + 2];
        a->R[i + 2] = c * a->R[i + 2] - d * y;
    }
    a->k[1] = c * ky + d * a->k[2];
    a->k[2] = c * a->k[2] - d * ky;
}

/* The length of a curved arc whose ends are so far apart. */
static status find_length(const scene *s, int member, double distance, member_arc *a, fault *f)
{
    double c[3];
    for (int i = 0; i < 60; i++) {
        chord_of(a->k, a->length, c);
        const double error = distance - vec3_norm(c);
        a->length += error;
        if (!(a->length > 0) || vec3_norm(a->k) * a->length > 6.28)
            return fault_set(f, STATUS_REFUSED,
                             "%s: no arc of that curvature joins its ends; give a smaller one",
                             scene_called(s, SCENE_MEMBERS, member).text);
        if (fabs(error) <= 1e-16 * distance)
            break;
    }
    return STATUS_OK;
}

status member_arc_of(const scene *s, int member, double axes_angle, member_arc *out, fault *f)
{
    const scene_member *m = &s->member[member];
    double chord[3], c[3], B[9], local[9];
    for (int i = 0; i < 3; i++)
        chord[i] = s->node[m->q].position[i] - s->node[m->p].position[i];
    const double distance = vec3_norm(chord);
    memcpy(out->start, s->node[m->p].position, sizeof out->start);
    memcpy(out->k, m->curvature, sizeof out->k);
    out->length = distance;
    if (vec3_norm(out->k) > 0)
        TRY(find_length(s, member, distance, out, f));
    if (rotation_triad(chord, m->y_axis, B) != 0)
        return fault_set(f, STATUS_REFUSED, "%s: its y axis is parallel to it",
                         scene_called(s, SCENE_MEMBERS, member).text);
    const double ey[3] = {0, 1, 0};
    chord_of(out->k, out->length, c);
    if (rotation_triad(c, ey, local) != 0)
        return fault_set(f, STATUS_REFUSED, "%s: its arc turns into its own y axis",
                         scene_called(s, SCENE_MEMBERS, member).text);
    for (int i = 0; i < 3; i++) /* R = B local^T */
        for (int j = 0; j < 3; j++)
            out->R[3 * i + j] = vec3_dot(&B[3 * i], &local[3 * j]);
    turn_to_principal(axes_angle, out);
    return STATUS_OK;
}

void member_arc_at(const member_arc *a, double s, double position[3], double R[9])
{
    double c[3], rotation_vector[3], q[4], along[9];
    chord_of(a->k, s, c);
    mat3_mul_vec(a->R, c, position);
    for (int i = 0; i < 3; i++) {
        position[i] += a->start[i];
        rotation_vector[i] = a->k[i] * s;
    }
    rotation_exp(rotation_vector, q);
    rotation_matrix(q, along);
    mat3_mul(a->R, along, R);
}
