#include "harness/model/model_impl.h"

#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"

const scene *imperfect_lines(const model *m)
{
    return m->imperfect != NULL ? &m->imperfect->lines : m->scene;
}

/* Interpolates value[points x 3] of a member linearly at a position. */
static void between_points(const model_imperfect *p, int member, double (*value)[3], double place,
                           double out[3])
{
    int low = p->first[member], high = p->first[member + 1] - 1;
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        *(p->place[middle] <= place ? &low : &high) = middle;
    }
    const double part = (place - p->place[low]) / (p->place[high] - p->place[low]);
    for (int i = 0; i < 3; i++)
        out[i] = (1 - part) * value[low][i] + part * value[high][i];
}

void imperfect_move(const model *m, int member, double place, double position[3], double R[9])
{
    double shift[3], turn[3], q[4], along[9], before[9];
    if (m->imperfect == NULL)
        return;
    between_points(m->imperfect, member, m->imperfect->shift, place, shift);
    between_points(m->imperfect, member, m->imperfect->turn, place, turn);
    for (int i = 0; i < 3; i++)
        position[i] += shift[i];
    rotation_exp(turn, q);
    rotation_matrix(q, along);
    memcpy(before, R, sizeof before);
    mat3_mul(along, before, R);
}

void imperfect_turn(const model *m, int member, const double place[2], double turn[3])
{
    double first[3];
    between_points(m->imperfect, member, m->imperfect->turn, place[0], first);
    between_points(m->imperfect, member, m->imperfect->turn, place[1], turn);
    for (int i = 0; i < 3; i++)
        turn[i] -= first[i];
}
