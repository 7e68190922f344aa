/* Sections given by dimensions and rolled sections given by name, represented by thin walls.
 * Dimensions refer to the centre lines of the walls. */
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases/format/format_impl.h"
#include "elements/math/scalar.h"
#include "elements/section/walls.h"

static void add_point(section_spec *spec, double y, double z)
{
    spec->point[spec->points][0] = y;
    spec->point[spec->points++][1] = z;
}

static void add_wall(section_spec *spec, int from, int to, double thickness)
{
    spec->wall[spec->walls].from = from;
    spec->wall[spec->walls].to = to;
    spec->wall[spec->walls++].thickness = thickness;
}

typedef struct flanged {
    double half, flange, flange_thickness, web_thickness;
} flanged;

static flanged flanged_of(const fields *f)
{
    return (flanged){.half = fields_number(f, "depth", 1) / 2,
                     .flange = fields_number(f, "flange", 1),
                     .flange_thickness = fields_number(f, "flange_thickness", 1),
                     .web_thickness = fields_number(f, "web_thickness", 1)};
}

static void add_line(section_spec *spec, const flanged *s, double upper, double lower)
{
    add_point(spec, upper, s->half);
    add_point(spec, 0, s->half);
    add_point(spec, 0, -s->half);
    add_point(spec, lower, -s->half);
    add_wall(spec, 0, 1, s->flange_thickness);
    add_wall(spec, 1, 2, s->web_thickness);
    add_wall(spec, 2, 3, s->flange_thickness);
}

static void channel(const fields *f, section_spec *spec)
{
    const flanged s = flanged_of(f);
    add_line(spec, &s, -s.flange, -s.flange);
}

static void zed(const fields *f, section_spec *spec)
{
    const flanged s = flanged_of(f);
    add_line(spec, &s, -s.flange, s.flange);
}

static void add_i(section_spec *spec, flanged s)
{
    for (int side = 1; side >= -1; side -= 2)
        for (int k = -1; k <= 1; k++)
            add_point(spec, k * s.flange / 2, side * s.half);
    add_wall(spec, 0, 1, s.flange_thickness);
    add_wall(spec, 1, 2, s.flange_thickness);
    add_wall(spec, 1, 4, s.web_thickness);
    add_wall(spec, 3, 4, s.flange_thickness);
    add_wall(spec, 4, 5, s.flange_thickness);
}

static void i_section(const fields *f, section_spec *spec)
{
    add_i(spec, flanged_of(f));
}

static void tee(const fields *f, section_spec *spec)
{
    const flanged s = flanged_of(f);
    for (int k = -1; k <= 1; k++)
        add_point(spec, k * s.flange / 2, 0);
    add_point(spec, 0, -2 * s.half);
    add_wall(spec, 0, 1, s.flange_thickness);
    add_wall(spec, 1, 2, s.flange_thickness);
    add_wall(spec, 1, 3, s.web_thickness);
}

static void add_box(section_spec *spec, flanged s)
{
    add_line(spec, &s, s.flange / 2, s.flange / 2);
    for (int k = 0; k < spec->points; k++)
        spec->point[k][0] += k == 1 || k == 2 ? -s.flange / 2 : 0;
    add_wall(spec, 3, 0, s.web_thickness);
    spec->cells = 1;
}

static void box(const fields *f, section_spec *spec)
{
    add_box(spec, flanged_of(f));
}

static void add_angle(section_spec *spec, double along_y, double along_z, double thickness)
{
    add_point(spec, along_y, 0);
    add_point(spec, 0, 0);
    add_point(spec, 0, along_z);
    add_wall(spec, 0, 1, thickness);
    add_wall(spec, 1, 2, thickness);
}

static void angle(const fields *f, section_spec *spec)
{
    add_angle(spec, fields_number(f, "along_y", 1), fields_number(f, "along_z", 1),
              fields_number(f, "thickness", 1));
}

/* Dimensions of rolled sections [mm]: depth, flange width, web and flange thickness, root radius
 * (EN 10365:2017: IPE, HEA, HEB, HEM, UPN). UPN sections have tapered flanges. Their constants
 * [cm^2, cm^4, cm^4, cm^4, 10^3 cm^6] and the distance [cm] from the centroid to the shear centre
 * follow. */
enum { UPN = 12 };

typedef struct rolled {
    int number;
    double h, b, tw, tf, r;
} rolled;

static const rolled ipe[] = {{80, 80, 46, 3.8, 5.2, 5},
                             {100, 100, 55, 4.1, 5.7, 7},
                             {120, 120, 64, 4.4, 6.3, 7},
                             {140, 140, 73, 4.7, 6.9, 7},
                             {160, 160, 82, 5, 7.4, 9},
                             {180, 180, 91, 5.3, 8, 9},
                             {200, 200, 100, 5.6, 8.5, 12},
                             {220, 220, 110, 5.9, 9.2, 12},
                             {240, 240, 120, 6.2, 9.8, 15},
                             {270, 270, 135, 6.6, 10.2, 15},
                             {300, 300, 150, 7.1, 10.7, 15},
                             {330, 330, 160, 7.5, 11.5, 18},
                             {360, 360, 170, 8, 12.7, 18},
                             {400, 400, 180, 8.6, 13.5, 21},
                             {450, 450, 190, 9.4, 14.6, 21},
                             {500, 500, 200, 10.2, 16, 21},
                             {550, 550, 210, 11.1, 17.2, 24},
                             {600, 600, 220, 12, 19, 24},
                             {0}};

static const rolled hea[] = {{100, 96, 100, 5, 8, 12},
                             {120, 114, 120, 5, 8, 12},
                             {140, 133, 140, 5.5, 8.5, 12},
                             {160, 152, 160, 6, 9, 15},
                             {180, 171, 180, 6, 9.5, 15},
                             {200, 190, 200, 6.5, 10, 18},
                             {220, 210, 220, 7, 11, 18},
                             {240, 230, 240, 7.5, 12, 21},
                             {260, 250, 260, 7.5, 12.5, 24},
                             {280, 270, 280, 8, 13, 24},
                             {300, 290, 300, 8.5, 14, 27},
                             {320, 310, 300, 9, 15.5, 27},
                             {340, 330, 300, 9.5, 16.5, 27},
                             {360, 350, 300, 10, 17.5, 27},
                             {400, 390, 300, 11, 19, 27},
                             {450, 440, 300, 11.5, 21, 27},
                             {500, 490, 300, 12, 23, 27},
                             {550, 540, 300, 12.5, 24, 27},
                             {600, 590, 300, 13, 25, 27},
                             {650, 640, 300, 13.5, 26, 27},
                             {700, 690, 300, 14.5, 27, 27},
                             {800, 790, 300, 15, 28, 30},
                             {900, 890, 300, 16, 30, 30},
                             {1000, 990, 300, 16.5, 31, 30},
                             {0}};

static const rolled heb[] = {{100, 100, 100, 6, 10, 12},
                             {120, 120, 120, 6.5, 11, 12},
                             {140, 140, 140, 7, 12, 12},
                             {160, 160, 160, 8, 13, 15},
                             {180, 180, 180, 8.5, 14, 15},
                             {200, 200, 200, 9, 15, 18},
                             {220, 220, 220, 9.5, 16, 18},
                             {240, 240, 240, 10, 17, 21},
                             {260, 260, 260, 10, 17.5, 24},
                             {280, 280, 280, 10.5, 18, 24},
                             {300, 300, 300, 11, 19, 27},
                             {320, 320, 300, 11.5, 20.5, 27},
                             {340, 340, 300, 12, 21.5, 27},
                             {360, 360, 300, 12.5, 22.5, 27},
                             {400, 400, 300, 13.5, 24, 27},
                             {450, 450, 300, 14, 26, 27},
                             {500, 500, 300, 14.5, 28, 27},
                             {550, 550, 300, 15, 29, 27},
                             {600, 600, 300, 15.5, 30, 27},
                             {650, 650, 300, 16, 31, 27},
                             {700, 700, 300, 17, 32, 27},
                             {800, 800, 300, 17.5, 33, 30},
                             {900, 900, 300, 18.5, 35, 30},
                             {1000, 1000, 300, 19, 36, 30},
                             {0}};

static const rolled hem[] = {{100, 120, 106, 12, 20, 12},
                             {120, 140, 126, 12.5, 21, 12},
                             {140, 160, 146, 13, 22, 12},
                             {160, 180, 166, 14, 23, 15},
                             {180, 200, 186, 14.5, 24, 15},
                             {200, 220, 206, 15, 25, 18},
                             {220, 240, 226, 15.5, 26, 18},
                             {240, 270, 248, 18, 32, 21},
                             {260, 290, 268, 18, 32.5, 24},
                             {280, 310, 288, 18.5, 33, 24},
                             {300, 340, 310, 21, 39, 27},
                             {320, 359, 309, 21, 40, 27},
                             {340, 377, 309, 21, 40, 27},
                             {360, 395, 308, 21, 40, 27},
                             {400, 432, 307, 21, 40, 27},
                             {450, 478, 307, 21, 40, 27},
                             {500, 524, 306, 21, 40, 27},
                             {550, 572, 306, 21, 40, 27},
                             {600, 620, 305, 21, 40, 27},
                             {650, 668, 305, 21, 40, 27},
                             {700, 716, 304, 21, 40, 27},
                             {800, 814, 303, 21, 40, 30},
                             {900, 910, 302, 21, 40, 30},
                             {1000, 1008, 302, 21, 40, 30},
                             {0}};

static const struct {
    rolled size;
    double A, Iy, Iz, It, Iw, ym;
} upn[UPN] = {{{80, 80, 45, 6, 8, 8}, 11.0, 106, 19.4, 2.16, 0.17, 2.67},
              {{100, 100, 50, 6, 8.5, 8.5}, 13.5, 206, 29.3, 2.81, 0.41, 2.93},
              {{120, 120, 55, 7, 9, 9}, 17.0, 364, 43.2, 4.15, 0.90, 3.03},
              {{140, 140, 60, 7, 10, 10}, 20.4, 605, 62.7, 5.68, 1.80, 3.37},
              {{160, 160, 65, 7.5, 10.5, 10.5}, 24.0, 925, 85.3, 7.39, 3.26, 3.56},
              {{180, 180, 70, 8, 11, 11}, 28.0, 1350, 114, 9.55, 5.57, 3.75},
              {{200, 200, 75, 8.5, 11.5, 11.5}, 32.2, 1910, 148, 11.9, 9.07, 3.94},
              {{220, 220, 80, 9, 12.5, 12.5}, 37.4, 2690, 197, 16.0, 14.6, 4.20},
              {{240, 240, 85, 9.5, 13, 13}, 42.3, 3600, 248, 19.7, 22.1, 4.39},
              {{260, 260, 90, 10, 14, 14}, 48.3, 4820, 317, 25.5, 33.3, 4.66},
              {{280, 280, 95, 10, 15, 15}, 53.3, 6280, 399, 31.0, 48.5, 5.02},
              {{300, 300, 100, 10, 16, 16}, 58.8, 8030, 495, 37.4, 69.1, 5.41}};

/* Leg lengths and root radius of angles [mm] (EN 10056-1:2017). The radius of the toes is half the
 * root radius. */
static const double angle_root[][3] = {
    {20, 20, 3.5},  {25, 25, 3.5},  {30, 20, 4},    {30, 30, 5},    {35, 35, 5},    {40, 20, 4},
    {40, 25, 4},    {40, 40, 6},    {45, 30, 4.5},  {45, 45, 7},    {50, 30, 5},    {50, 50, 7},
    {60, 30, 5},    {60, 40, 6},    {60, 60, 8},    {65, 50, 6},    {65, 65, 9},    {70, 50, 7},
    {70, 70, 9},    {75, 50, 7},    {75, 75, 9},    {80, 40, 7},    {80, 60, 8},    {80, 80, 10},
    {90, 90, 11},   {100, 50, 8},   {100, 65, 10},  {100, 75, 10},  {100, 100, 12}, {120, 80, 11},
    {120, 120, 13}, {125, 75, 11},  {130, 130, 14}, {150, 75, 12},  {150, 90, 12},  {150, 100, 12},
    {150, 150, 16}, {160, 160, 17}, {180, 180, 18}, {200, 100, 15}, {200, 150, 15}, {200, 200, 18},
    {250, 250, 18}};

/* Area between a corner of a square of side r and its inscribed quarter circle, divided by r^2.
 * Distance of its centroid from the sides, divided by r. Second moment about an axis through the
 * centroid parallel to a side, divided by r^4. */
static const double spandrel_area = 1 - PI / 4, spandrel_at = (10 - 3 * PI) / (12 - 3 * PI),
                    spandrel_moment = 1. / 3 - PI / 16 - 1 / (36 - 9 * PI);

static void give(double *to, double value)
{
    if (isnan(*to))
        *to = value;
}

/* Adds constants that include fillets. They are exact, except It (El Darwish and Johnston, J.
 * Struct. Div. ASCE 91, 1965, as in tables of manufacturers). */
static void add_rolled_i(section_spec *spec, const rolled *p, double mm)
{
    const double h = p->h * mm, b = p->b * mm, tw = p->tw * mm, tf = p->tf * mm, r = p->r * mm,
                 web = h - 2 * tf, fillet = spandrel_area * r * r, at = spandrel_at * r,
                 own = spandrel_moment * pow(r, 4), middle = h - tf,
                 circle = (pow(r + tw / 2, 2) + pow(r + tf, 2) - r * r) / (2 * r + tf);
    add_i(spec,
          (flanged){.half = middle / 2, .flange = b, .flange_thickness = tf, .web_thickness = tw});
    give(&spec->given.A, 2 * b * tf + web * tw + 4 * fillet);
    give(&spec->given.Iy, (b * tf * tf * tf / 6 + b * tf * middle * middle / 2) +
                              tw * web * web * web / 12 +
                              4 * (own + fillet * pow(web / 2 - at, 2)));
    give(&spec->given.Iz,
         tf * b * b * b / 6 + web * tw * tw * tw / 12 + 4 * (own + fillet * pow(tw / 2 + at, 2)));
    give(&spec->given.It, 2. / 3 * (b - 0.63 * tf) * tf * tf * tf + web * tw * tw * tw / 3 +
                              2 * tw / tf * (0.145 + 0.1 * r / tf) * pow(circle, 4));
    give(&spec->given.Iw, tf * b * b * b * middle * middle / 24);
}

typedef struct patch {
    double area, y, z, Iy, Iz, Iyz;
} patch;

static patch rectangle_patch(double y0, double y1, double z0, double z1)
{
    const double w = y1 - y0, h = z1 - z0;
    return (patch){w * h, (y0 + y1) / 2, (z0 + z1) / 2, w * h * h * h / 12, h * w * w * w / 12, 0};
}

/* Returns the area between a corner and its inscribed quarter circle. With ky = kz = 1, the area
 * extends from the corner (y, z) towards +y and +z. `sign` is -1 if the area is cut off. */
static patch spandrel_patch(double y, double z, double r, int ky, int kz, int sign)
{
    const double area = spandrel_area * r * r, at = spandrel_at * r,
                 own = spandrel_moment * pow(r, 4),
                 product = (19. / 24 - PI / 4) * pow(r, 4) - area * at * at;
    return (patch){sign * area, y + ky * at, z + kz * at,
                   sign * own,  sign * own,  sign * ky * kz * product};
}

static patch sum_of(int count, const patch p[])
{
    patch all = {0};
    for (int i = 0; i < count; i++) {
        all.area += p[i].area;
        all.y += p[i].area * p[i].y;
        all.z += p[i].area * p[i].z;
    }
    all.y /= all.area;
    all.z /= all.area;
    for (int i = 0; i < count; i++) {
        const double y = p[i].y - all.y, z = p[i].z - all.z;
        all.Iy += p[i].Iy + p[i].area * z * z;
        all.Iz += p[i].Iz + p[i].area * y * y;
        all.Iyz += p[i].Iyz + p[i].area * y * z;
    }
    return all;
}

/* Adds an angle with legs of outer lengths b along y and h along z. Its constants include fillets.
 * They are exact, except It (Roark's Formulas for Stress and Strain, 7th ed., table 10.7, case 26,
 * legs of equal thickness). The origin is the intersection of the centre lines, which is the shear
 * centre. */
static void add_rolled_angle(section_spec *spec, double h, double b, double t, double root)
{
    const double o = -t / 2, toe = root / 2,
                 circle = 2 * (2 * t + 3 * root - sqrt(2) * (2 * root + t)), in = h - t;
    const patch all = sum_of(5, (const patch[]){rectangle_patch(o, o + b, o, o + t),
                                                rectangle_patch(o, o + t, o + t, o + h),
                                                spandrel_patch(o + t, o + t, root, 1, 1, 1),
                                                spandrel_patch(o + b, o + t, toe, -1, -1, -1),
                                                spandrel_patch(o + t, o + h, toe, -1, -1, -1)});
    const double beta = h == b ? -PI / 4 : section_principal_angle(all.Iy, all.Iz, all.Iyz),
                 c = cos(beta), d = sin(beta), mixed = 2 * c * d * all.Iyz;
    add_angle(spec, b - t / 2, h - t / 2, t);
    give(&spec->given.A, all.area);
    give(&spec->given.beta, beta);
    give(&spec->given.Iy, c * c * all.Iy - mixed + d * d * all.Iz);
    give(&spec->given.Iz, c * c * all.Iz + mixed + d * d * all.Iy);
    give(&spec->given.ys, -(c * all.y + d * all.z));
    give(&spec->given.zs, d * all.y - c * all.z);
    give(&spec->given.It,
         b * pow(t, 3) * (1. / 3 - 0.21 * t / b * (1 - pow(t / b, 4) / 12)) +
             in * pow(t, 3) * (1. / 3 - 0.105 * t / in * (1 - pow(t / in, 4) / 192)) +
             (0.07 + 0.076 * root / t) * pow(circle, 4));
}

/* Adds a hot finished hollow section (EN 10210-2:2019, outer radius 1.5 t, inner radius t) with the
 * formulas of that standard. */
static void add_hollow(section_spec *spec, double h, double b, double t)
{
    const double outer = 1.5 * t, inner = t, round = (outer + inner) / 2 * (outer + inner) / 2,
                 line = 2 * (b - t + h - t) - (outer + inner) * (4 - PI),
                 enclosed = (b - t) * (h - t) - round * (4 - PI);
    const double side[2] = {h, b}, other[2] = {b, h};
    double I[2];
    add_box(
        spec,
        (flanged){.half = (h - t) / 2, .flange = b - t, .flange_thickness = t, .web_thickness = t});
    for (int k = 0; k < 2; k++) {
        const double in = side[k] - 2 * t;
        I[k] = (other[k] * pow(side[k], 3) - (other[k] - 2 * t) * pow(in, 3)) / 12 -
               4 * (spandrel_moment * pow(outer, 4) +
                    spandrel_area * outer * outer * pow(side[k] / 2 - spandrel_at * outer, 2)) +
               4 * (spandrel_moment * pow(inner, 4) +
                    spandrel_area * inner * inner * pow(in / 2 - spandrel_at * inner, 2));
    }
    give(&spec->given.A, 2 * t * (b + h - 2 * t) - (4 - PI) * (outer * outer - inner * inner));
    give(&spec->given.Iy, I[0]);
    give(&spec->given.Iz, I[1]);
    give(&spec->given.It, t * t * t * line / 3 + 4 * enclosed * enclosed * t / line);
}

/* Reads the dimensions after the letters of a name, such as "200x100x5". Returns the number of
 * dimensions, or -1 if other text follows. */
static int sizes_of(const char *text, double size[3])
{
    int count = 0;
    for (char *end; count < 3; text = end + 1) {
        size[count] = strtod(text, &end);
        if (end == text || !(size[count] > 0) || !isfinite(size[count]))
            return -1;
        count++;
        if (*end == '\0')
            return count;
        if (tolower((unsigned char)*end) != 'x')
            return -1;
    }
    return -1;
}

/* Adds the rolled section with this name, in capitals without blanks. `mm` is a millimetre in the
 * length unit of the scene. Returns 0 if there is no section of this name. */
static int add_profile(section_spec *spec, const char *name, double mm)
{
    static const struct {
        const char *family;
        const rolled *list;
    } i_shapes[] = {{"IPE", ipe}, {"HEA", hea}, {"HEB", heb}, {"HEM", hem}};
    const double cm = 10 * mm;
    double size[3];
    const size_t letters = strspn(name, "ABCDEFGHIJKLMNOPQRSTUVWXYZ");
    const int count = sizes_of(name + letters, size);
    spec->kind = SECTION_WALLS;
    spec->thickness_terms = 1;
    for (size_t k = 0; k < sizeof i_shapes / sizeof i_shapes[0]; k++)
        for (const rolled *p = i_shapes[k].list; p->number > 0; p++)
            if (count == 1 && letters == 3 && strncmp(name, i_shapes[k].family, 3) == 0 &&
                size[0] == p->number) {
                add_rolled_i(spec, p, mm);
                return 1;
            }
    for (size_t k = 0; k < sizeof upn / sizeof upn[0]; k++)
        if (count == 1 && letters == 3 && strncmp(name, "UPN", 3) == 0 &&
            size[0] == upn[k].size.number) {
            const rolled *p = &upn[k].size;
            add_line(spec,
                     &(flanged){.half = (p->h - p->tf) / 2 * mm,
                                .flange_thickness = p->tf * mm,
                                .web_thickness = p->tw * mm},
                     -(p->b - p->tw / 2) * mm, -(p->b - p->tw / 2) * mm);
            give(&spec->given.A, upn[k].A * cm * cm);
            give(&spec->given.Iy, upn[k].Iy * pow(cm, 4));
            give(&spec->given.Iz, upn[k].Iz * pow(cm, 4));
            give(&spec->given.It, upn[k].It * pow(cm, 4));
            give(&spec->given.Iw, upn[k].Iw * 1e3 * pow(cm, 6));
            give(&spec->given.ys, upn[k].ym * cm);
            return 1;
        }
    if (letters == 3 && strncmp(name, "CHS", 3) == 0 && count == 2 && 2 * size[1] <= size[0]) {
        spec->kind = SECTION_TUBE;
        spec->thickness_terms = 0;
        spec->diameter = size[0] * mm;
        spec->wall_thickness = size[1] * mm;
        return 1;
    }
    const int square = letters == 3 && strncmp(name, "SHS", 3) == 0 && count == 2,
              oblong = letters == 3 && strncmp(name, "RHS", 3) == 0 && count == 3;
    const double t = size[square ? 1 : 2], width = size[square ? 0 : 1];
    if ((square || oblong) && 3 * t <= fmin(size[0], width)) {
        add_hollow(spec, size[0] * mm, width * mm, t * mm);
        return 1;
    }
    if (letters == 1 && *name == 'L' && (count == 2 || count == 3)) {
        const double leg = size[count == 3 ? 1 : 0], thick = size[count - 1];
        if (2 * thick > fmin(leg, size[0]))
            return 0;
        for (size_t k = 0; k < sizeof angle_root / sizeof angle_root[0]; k++)
            if (angle_root[k][0] == fmax(leg, size[0]) && angle_root[k][1] == fmin(leg, size[0])) {
                add_rolled_angle(spec, size[0] * mm, leg * mm, thick * mm, angle_root[k][2] * mm);
                return 1;
            }
        add_angle(spec, (leg - thick / 2) * mm, (size[0] - thick / 2) * mm, thick * mm);
        return 1;
    }
    return 0;
}

static void known_profiles(const char *name, char *text, size_t size)
{
    static const struct {
        const char *family;
        const rolled *list;
    } all[] = {{"IPE", ipe}, {"HEA", hea}, {"HEB", heb}, {"HEM", hem}, {"UPN", NULL}};
    size_t used = 0;
    for (size_t k = 0; k < sizeof all / sizeof all[0]; k++) {
        if (strncmp(name, all[k].family, 3) != 0)
            continue;
        used = (size_t)snprintf(text, size, "the sizes of %s are ", all[k].family);
        for (int i = 0; used < size && (all[k].list != NULL ? all[k].list[i].number > 0 : i < UPN);
             i++)
            used +=
                (size_t)snprintf(text + used, size - used, "%s%d", i > 0 ? ", " : "",
                                 all[k].list != NULL ? all[k].list[i].number : upn[i].size.number);
        return;
    }
    snprintf(text, size,
             "write IPE200, HEA200 (HEB, HEM), UPN200, L100x75x8 (legs, "
             "thickness), SHS100x5, RHS200x100x5 or CHS114.3x5 (outer "
             "sizes, thickness) in mm, or give dimensions");
}

static void profile(const fields *f, section_spec *spec)
{
    char name[40] = "", known[FAULT_TEXT / 2 + 40];
    const char *text = fields_text(f, "profile", "");
    size_t used = 0;
    for (const char *c = text; *c != '\0' && used + 1 < sizeof name; c++)
        if (!isspace((unsigned char)*c))
            name[used++] = (char)toupper((unsigned char)*c);
    if (add_profile(spec, name, f->b->units.given ? 1e-3 / f->b->units.length : 1e-3))
        return;
    known_profiles(name, known, sizeof known);
    document_mistake(f->b->mistakes, document_find(f->map, "profile"), 0,
                     "unknown profile '%.40s'; %s", text, known);
}

int build_shapes_read(const fields *f, section_spec *spec)
{
    static const struct {
        const char *key;
        void (*read)(const fields *, section_spec *);
    } all[] = {{"i", i_section}, {"channel", channel}, {"zed", zed},
               {"angle", angle}, {"box", box},         {"t", tee}};
    for (size_t k = 0; k < sizeof all / sizeof all[0]; k++)
        if (fields_have(f, all[k].key)) {
            const fields sizes = fields_below(f, all[k].key);
            spec->kind = SECTION_WALLS;
            all[k].read(&sizes, spec);
            return 1;
        }
    if (fields_have(f, "profile")) {
        profile(f, spec);
        return 1;
    }
    return 0;
}
