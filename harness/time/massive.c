#include "harness/time/massive.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/rotation.h"
#include "elements/math/vec3.h"
#include "harness/model/model.h"
#include "harness/time/forms.h"
#include "harness/time/massless.h"

enum { BLOCK = 9, BLOCKS = 2 };

/* All three of a block are free coordinates of a body's own. */
static int is_whole(const model *m, int i, int block)
{
    const int *at = model_vertex(m, i)->coordinate + 3 * block;
    int whole = model_vertex(m, i)->body == i;
    for (int k = 0; k < 3; k++)
        whole &= at[k] != NONE && at[k] < model_unknowns(m);
    return whole;
}

/* Column k of the projections of all bodies at once: they do not depend on each other. */
static status column(const model *m, const carried_masses *masses, const model_state *s, int block,
                     int k, double dx[], massive *h, fault *f)
{
    memset(dx, 0, (size_t)model_unknowns(m) * sizeof *dx);
    for (int i = 0; i < model_first_release(m); i++)
        if (is_whole(m, i, block))
            dx[model_vertex(m, i)->coordinate[3 * block + k]] = 1;
    TRY(massless_motion(m, masses, s, dx, f));
    for (int i = 0; i < model_first_release(m); i++)
        for (int r = 0; r < 3 && is_whole(m, i, block); r++)
            h->light[BLOCK * (BLOCKS * i + block) + 3 * r + k] =
                dx[model_vertex(m, i)->coordinate[3 * block + r]];
    return STATUS_OK;
}

/* R^T P R: turns of what is not a sequence of angles. */
static void own_axes(const model *m, const model_state *s, massive *h)
{
    for (int i = 0; i < model_first_release(m); i++) {
        double R[9], PR[9], *P = h->light + BLOCK * (BLOCKS * i + 1);
        if (!is_whole(m, i, 1) || forms_of(m, i) != FORM_BODY)
            continue;
        rotation_matrix(&s->q[4 * i], R);
        mat3_mul(P, R, PR);
        mat3_transpose_mul(R, PR, P);
    }
}

status massive_of(const model *m, const carried_masses *masses, const model_state *s, massive *h,
                  fault *f)
{
    int count;
    TRY(massless_count(m, masses, s, &count, f));
    h->ready = 1;
    if (count == 0)
        return STATUS_OK;
    double *dx = calloc((size_t)model_unknowns(m) + 1, sizeof *dx);
    h->light = calloc((size_t)model_first_release(m) * BLOCKS * BLOCK + 1, sizeof *h->light);
    status outcome = dx != NULL && h->light != NULL
                         ? STATUS_OK
                         : fault_set(f, STATUS_FAULT, "out of memory for a motion in time");
    for (int c = 0; c < 3 * BLOCKS && outcome == STATUS_OK; c++)
        outcome = column(m, masses, s, c / 3, c % 3, dx, h, f);
    free(dx);
    if (outcome == STATUS_OK)
        own_axes(m, s, h);
    return outcome;
}

void massive_free(massive *h)
{
    free(h->light);
}

double massive_norm(const massive *h, const model *m, const double weight[], double e[])
{
    double square = 0;
    for (int i = 0; i < model_first_release(m) && h->light != NULL; i++)
        for (int block = 0; block < BLOCKS; block++) {
            const int *at = model_vertex(m, i)->coordinate + 3 * block;
            double of[3], light[3];
            if (!is_whole(m, i, block))
                continue;
            for (int k = 0; k < 3; k++)
                of[k] = e[at[k]];
            mat3_mul_vec(h->light + BLOCK * (BLOCKS * i + block), of, light);
            for (int k = 0; k < 3; k++)
                e[at[k]] -= light[k];
        }
    for (int c = 0; c < model_unknowns(m); c++)
        square += weight[c] * e[c] * e[c];
    return sqrt(square);
}
