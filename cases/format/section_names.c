#include "cases/format/section_names.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { CONSTANTS = 19 };

const char section_names_all[] =
    "A, Iy, Iz, It, Iw, Ip, ys, zs, Dy, Dz, Dw, Fy, Fz, Fw, beta, yc, zc, ey, ez";

int section_names_index(const char *name, size_t length)
{
    const char *at = section_names_all;
    for (int i = 0; i < CONSTANTS; i++) {
        const size_t this = strcspn(at, ",");
        if (this == length && strncmp(at, name, length) == 0)
            return i;
        at += this + 2;
    }
    return -1;
}

const scope *section_names_add(const scope *names, const char *section_name, const section *c,
                               arena *a)
{
    const size_t length = strlen(section_name) + 2;
    char *name = arena_take(a, length);
    double *value = arena_take(a, CONSTANTS * sizeof *value);
    if (name == NULL || value == NULL)
        return names;
    snprintf(name, length, "%s.", section_name);
    for (int i = 0; i < CONSTANTS && c == NULL; i++)
        value[i] = NAN;
    if (c != NULL) {
        const double turn[2] = {cos(c->axes_angle), sin(c->axes_angle)};
        const double all[CONSTANTS] = {c->A,
                                       c->Iy,
                                       c->Iz,
                                       c->It,
                                       c->Iw,
                                       c->Ip,
                                       c->ys,
                                       c->zs,
                                       c->D[0],
                                       c->D[4],
                                       c->D[8],
                                       c->F[0],
                                       c->F[4],
                                       c->F[8],
                                       c->axes_angle,
                                       c->centroid[0],
                                       c->centroid[1],
                                       turn[0] * c->ys - turn[1] * c->zs,
                                       turn[1] * c->ys + turn[0] * c->zs};
        memcpy(value, all, sizeof all);
    }
    return scope_constants(names, name, value, a);
}
