#include "elements/section/section.h"

#include <math.h>
#include <stddef.h>

static const double same = 1e-9;

static int all_zero(const double v[9])
{
    for (int i = 0; i < 9; i++)
        if (v[i] != 0)
            return 0;
    return 1;
}

static const char *given_once(const section_spec *p, const section_spec *q)
{
    const struct {
        const char *name;
        double p, q;
    } given[] = {
#define PAIR(name) {#name, p->given.name, q->given.name},
        SECTION_GIVEN(PAIR)
#undef PAIR
    };
    for (size_t i = 0; i < sizeof given / sizeof given[0]; i++)
        if (isnan(given[i].p) != isnan(given[i].q))
            return given[i].name;
    for (int i = 0; i < 2; i++)
        if ((p->shear_factor[i] > 0) != (q->shear_factor[i] > 0))
            return "shear_factor";
    if (all_zero(p->constants.D) != all_zero(q->constants.D))
        return "D";
    return all_zero(p->constants.F) != all_zero(q->constants.F) ? "F" : NULL;
}

static status check_walls(const section_spec *p, const section_spec *q, fault *f)
{
    int differ = p->points != q->points || p->walls != q->walls || p->cells != q->cells ||
                 p->thickness_terms != q->thickness_terms;
    for (int w = 0; !differ && w < p->walls; w++)
        differ = p->wall[w].from != q->wall[w].from || p->wall[w].to != q->wall[w].to;
    if (differ)
        return fault_set(
            f, STATUS_REFUSED,
            "the section changes from %d walls to %d walls that are connected differently; give "
            "both ends the same points and walls, with different dimensions",
            p->walls, q->walls);
    return STATUS_OK;
}

/* Returns the largest distance [m] of the ends of a wall from the plane of this wall in the other
 * section. Positions are relative to the shear centre of each section. */
static double out_of_plane(const section_spec *p, const section_spec *q,
                           const section *const ends[2], int w)
{
    const section_spec *spec[2] = {p, q};
    double y[2][2], z[2][2];
    for (int k = 0; k < 2; k++) {
        const double c = cos(ends[k]->axes_angle), d = sin(ends[k]->axes_angle);
        const int at[2] = {spec[k]->wall[w].from, spec[k]->wall[w].to};
        for (int i = 0; i < 2; i++) {
            const double dy = spec[k]->point[at[i]][0] - ends[k]->centroid[0],
                         dz = spec[k]->point[at[i]][1] - ends[k]->centroid[1];
            y[k][i] = c * dy + d * dz - ends[k]->ys;
            z[k][i] = c * dz - d * dy - ends[k]->zs;
        }
    }
    const double ty = y[0][1] - y[0][0], tz = z[0][1] - z[0][0], length = hypot(ty, tz);
    double most = 0;
    for (int i = 0; i < 2; i++)
        most = fmax(most, fabs((y[1][i] - y[0][0]) * tz - (z[1][i] - z[0][0]) * ty) / length);
    return most;
}

static int walls_change(const section_spec *p, const section_spec *q)
{
    int change = 0;
    for (int w = 0; w < p->walls; w++)
        change |= p->wall[w].thickness != q->wall[w].thickness;
    for (int i = 0; i < p->points; i++)
        change |= p->point[i][0] != q->point[i][0] || p->point[i][1] != q->point[i][1];
    return change;
}

/* Checks that the sectorial coordinate of every fibre is constant along the member. */
static status check_warping(const section_spec *p, const section_spec *q,
                            const section *const ends[2], fault *f)
{
    static const char remedy[] = "omit warping with given: {Iw: 0} at both ends, or vary only "
                                 "dimensions that have no such effect";
    const double size = sqrt(ends[0]->Ip / ends[0]->A) + sqrt(ends[1]->Ip / ends[1]->A);
    if (!(ends[0]->Iw > 0) && !(ends[1]->Iw > 0))
        return STATUS_OK;
    int moves = hypot(ends[1]->ys - ends[0]->ys, ends[1]->zs - ends[0]->zs) > same * size ||
                fabs(ends[1]->axes_angle - ends[0]->axes_angle) > same;
    if (p->kind == SECTION_WALLS)
        for (int w = 0; w < p->walls; w++)
            moves |= out_of_plane(p, q, ends, w) > same * size;
    if (moves)
        return fault_set(f, STATUS_REFUSED,
                         "the section warps, and along the member the shear centre moves or walls "
                         "leave their planes, which couples warping with torsion; %s",
                         remedy);
    if (p->cells > 0 && walls_change(p, q))
        return fault_set(
            f, STATUS_REFUSED,
            "the closed cells and their sectorial coordinate change along the member, which "
            "couples warping with torsion; omit warping with given: {Iw: 0} at both ends");
    return STATUS_OK;
}

status section_taper_check(const section_spec *p, const section_spec *q,
                           const section *const ends[2], fault *f)
{
    static const char *const form[] = {"walls", "a rectangle", "a tube", "constants", "matrices"};
    if (p->kind != q->kind)
        return fault_set(
            f, STATUS_REFUSED,
            "the section changes from %s to %s; give both ends the same kind of section",
            form[p->kind], form[q->kind]);
    if (p->sheet_warping != q->sheet_warping || given_once(p, q) != NULL)
        return fault_set(f, STATUS_REFUSED,
                         "'%s' is given for the section at one end only; give it at both ends, or "
                         "at neither end",
                         given_once(p, q) != NULL ? given_once(p, q) : "sheet_warping");
    if (p->given.A != q->given.A && !isnan(p->given.A))
        return fault_set(
            f, STATUS_REFUSED,
            "the section changes from one rolled profile or given A to another, and the constants "
            "in between are not known; describe both sections by their dimensions");
    if (p->kind == SECTION_WALLS)
        TRY(check_walls(p, q, f));
    return check_warping(p, q, ends, f);
}

static void blend(int count, double x, const double q[], double p[])
{
    for (int i = 0; i < count; i++)
        if (p[i] != q[i])
            p[i] += x * (q[i] - p[i]);
}

static void blend_given(const section_spec *q, double x, section_spec *out)
{
#define BLEND(name) blend(1, x, &q->given.name, &out->given.name);
    SECTION_GIVEN(BLEND)
#undef BLEND
}

static void blend_constants(const section *q, double x, section *out)
{
    const struct {
        double *p;
        const double *q;
    } number[] = {{&out->A, &q->A},
                  {&out->Iy, &q->Iy},
                  {&out->Iz, &q->Iz},
                  {&out->It, &q->It},
                  {&out->Iw, &q->Iw},
                  {&out->ys, &q->ys},
                  {&out->zs, &q->zs},
                  {&out->Ip, &q->Ip},
                  {&out->wagner_y, &q->wagner_y},
                  {&out->wagner_z, &q->wagner_z},
                  {&out->wagner_torque, &q->wagner_torque}};
    for (size_t i = 0; i < sizeof number / sizeof number[0]; i++)
        blend(1, x, number[i].q, number[i].p);
    blend(36, x, q->stiffness, out->stiffness);
    blend(36, x, q->mass, out->mass);
    blend(9, x, q->D, out->D);
    blend(9, x, q->F, out->F);
}

void section_taper_at(const section_spec *p, const section_spec *q, double x, section_spec *out)
{
    *out = *p;
    blend(1, x, &q->young, &out->young);
    blend(1, x, &q->shear_modulus, &out->shear_modulus);
    blend(1, x, &q->density, &out->density);
    blend(1, x, &q->expansion, &out->expansion);
    blend(2 * p->points, x, &q->point[0][0], &out->point[0][0]);
    for (int w = 0; w < p->walls; w++)
        blend(1, x, &q->wall[w].thickness, &out->wall[w].thickness);
    blend(1, x, &q->width, &out->width);
    blend(1, x, &q->height, &out->height);
    blend(2, x, q->shear_factor, out->shear_factor);
    blend(1, x, &q->diameter, &out->diameter);
    blend(1, x, &q->wall_thickness, &out->wall_thickness);
    blend_given(q, x, out);
    blend_constants(&q->constants, x, &out->constants);
}
