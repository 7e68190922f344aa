/* Family of a mode by the share of its kinetic-like measure: translations along the member, across it, and twist times the
 * radius of gyration; half-waves by the sign changes of the leading component along the first member. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/rotation.h"
#include "harness/solve/analysis.h"

enum { AXIAL, ALONG_Y, ALONG_Z, TWIST, MEASURES };

/* Components of vertex motion in the member's axes: x, y, z and twist times r. */
static void components(const double R[9], double radius, const double u[7], double out[MEASURES])
{
    for (int k = 0; k < 3; k++)
        out[k] = R[k] * u[0] + R[3 + k] * u[1] + R[6 + k] * u[2];
    out[TWIST] = radius * (R[0] * u[3] + R[3] * u[4] + R[6] * u[5]);
}

static int count_half_waves(int vertices, const double *value)
{
    double largest = 0, last = 0;
    int waves = 0;
    for (int i = 0; i < vertices; i++)
        largest = fmax(largest, fabs(value[i]));
    for (int i = 0; i < vertices; i++) {
        if (fabs(value[i]) <= 1e-6 * largest)
            continue;
        if (waves == 0 || value[i] * last < 0)
            waves++;
        last = value[i];
    }
    return waves;
}

status mode_identify(const model *m, const scene *s, const double mode[], mode_shape *out, fault *f)
{
    static const scene_family family[MEASURES] = {SCENE_AXIAL, SCENE_BENDING_Y, SCENE_BENDING_Z, SCENE_TORSION};
    const int vertices = model_shape(m, NULL, NULL, NULL);
    double *u = malloc((size_t)vertices * 7 * sizeof *u), *line = malloc((size_t)vertices * MEASURES * sizeof *line);
    int *index = malloc((size_t)vertices * sizeof *index);
    if (u == NULL || line == NULL || index == NULL) {
        free(u);
        free(line);
        free(index);
        return fault_set(f, STATUS_FAULT, "out of memory for a mode");
    }
    model_shape(m, mode, u, NULL);
    double sum[MEASURES] = {0};
    int leading = 0, along = 0;
    for (int member = 0; member < s->members; member++) {
        const scene_member *sm = &s->member[member];
        const section *c = model_section(m, sm->section);
        double d[3], R[9];
        for (int i = 0; i < 3; i++)
            d[i] = s->node[sm->q].position[i] - s->node[sm->p].position[i];
        rotation_triad(d, sm->y_axis, R);
        const int count = model_member_vertices(m, member, index);
        for (int i = 0; i < count; i++) {
            double part[MEASURES];
            components(R, sqrt(c->Ip / c->A), &u[7 * index[i]], part);
            for (int k = 0; k < MEASURES; k++) {
                sum[k] += part[k] * part[k];
                if (member == 0)
                    line[k * count + i] = part[k];
            }
        }
        along = member == 0 ? count : along;
    }
    for (int k = 1; k < MEASURES; k++)
        leading = sum[k] > sum[leading] ? k : leading;
    out->family = family[leading];
    out->half_waves = count_half_waves(along, &line[leading * along]);
    free(u);
    free(line);
    free(index);
    return STATUS_OK;
}
