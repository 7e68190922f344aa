/* Sections by their sizes, as thin walls; all sizes are of the walls' centre lines. */
#include "cases/format/build_shapes.h"

#include <stddef.h>

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

/* Two flanges along y and a web along z. */
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

/* An open line of three walls: upper flange from y = `upper` to the web, web, lower flange to y =
 * `lower`. */
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

static void i_section(const fields *f, section_spec *spec)
{
    const flanged s = flanged_of(f);
    for (int side = 1; side >= -1; side -= 2)
        for (int k = -1; k <= 1; k++)
            add_point(spec, k * s.flange / 2, side * s.half);
    add_wall(spec, 0, 1, s.flange_thickness);
    add_wall(spec, 1, 2, s.flange_thickness);
    add_wall(spec, 1, 4, s.web_thickness);
    add_wall(spec, 3, 4, s.flange_thickness);
    add_wall(spec, 4, 5, s.flange_thickness);
}

static void box(const fields *f, section_spec *spec)
{
    const flanged s = flanged_of(f);
    add_line(spec, &s, s.flange / 2, s.flange / 2);
    for (int k = 0; k < spec->points; k++) /* the web is one of two */
        spec->point[k][0] += k == 1 || k == 2 ? -s.flange / 2 : 0;
    add_wall(spec, 3, 0, s.web_thickness);
    spec->cells = 1;
}

static void angle(const fields *f, section_spec *spec)
{
    const double thickness = fields_number(f, "thickness", 1);
    add_point(spec, fields_number(f, "along_y", 1), 0);
    add_point(spec, 0, 0);
    add_point(spec, 0, fields_number(f, "along_z", 1));
    add_wall(spec, 0, 1, thickness);
    add_wall(spec, 1, 2, thickness);
}

int build_shapes_read(const fields *f, section_spec *spec)
{
    static const struct {
        const char *key;
        void (*read)(const fields *, section_spec *);
    } all[] = {
        {"i", i_section}, {"channel", channel}, {"zed", zed}, {"angle", angle}, {"box", box}};
    for (size_t k = 0; k < sizeof all / sizeof all[0]; k++)
        if (fields_have(f, all[k].key)) {
            const fields sizes = fields_below(f, all[k].key);
            spec->kind = SECTION_WALLS;
            all[k].read(&sizes, spec);
            return 1;
        }
    return 0;
}
