#include "cases/scene/along_path.h"
#include "cases/scene/names.h"

#include <math.h>
#include <stdio.h>

#include "elements/math/dense.h"

static double interpolate(int stations, const double at[], const double value[], double path)
{
    if (path <= at[0])
        return value[0];
    for (int i = 1; i < stations; i++)
        if (path <= at[i]) {
            const double t = (path - at[i - 1]) / (at[i] - at[i - 1]);
            return t == 1 ? value[i] : value[i - 1] + t * (value[i] - value[i - 1]);
        }
    return value[stations - 1];
}

double along_path_factor(const scene_load *load, double path)
{
    return load->stations > 0 ? interpolate(load->stations, load->path, load->factor, path) : path;
}

double along_path_rate(const scene_load *load, double path)
{
    if (load->stations == 0)
        return 1;
    for (int i = 1; i < load->stations; i++)
        if (path >= load->path[i - 1] && path < load->path[i])
            return (load->factor[i] - load->factor[i - 1]) / (load->path[i] - load->path[i - 1]);
    return 0;
}

double along_path_value(const scene_driver *d, double path)
{
    return interpolate(d->stations, d->path, d->value, path);
}

/* Where something changes along the path; begin > end: nowhere. */
typedef struct changes {
    double begin, end;
    scene_words last; /* what ends there */
} changes;

static void add_changes(int stations, const double path[], const double value[], scene_words who,
                        changes *c)
{
    for (int i = 1; i < stations; i++) {
        if (value[i] == value[i - 1])
            continue;
        c->begin = fmin(c->begin, path[i - 1]);
        if (path[i] > c->end)
            c->last = who;
        c->end = fmax(c->end, path[i]);
    }
}

along_path_words along_path_end(const scene *s)
{
    along_path_words out = {""};
    changes c = {.begin = INFINITY, .end = -INFINITY};
    for (int i = 0; i < s->loads; i++) {
        const scene_load *load = &s->load[i];
        if (!scene_load_acts(load))
            continue;
        if (load->stations == 0)
            return out;
        add_changes(load->stations, load->path, load->factor, scene_called(s, SCENE_LOADS, i), &c);
    }
    for (int d = 0; d < s->drivers; d++) {
        const scene_driver *driver = &s->driver[d];
        if (driver->value == NULL)
            return out;
        add_changes(driver->stations, driver->path, driver->value,
                    scene_called(s, SCENE_DRIVERS, d), &c);
    }
    if (c.begin > c.end)
        snprintf(out.text, sizeof out.text,
                 "; no load changes along the path: give a load that grows");
    else
        snprintf(out.text, sizeof out.text,
                 "; nothing changes outside path %g to %g, where %s has its last value: give it "
                 "values further on; a load without path and factor grows with the path",
                 c.begin, c.end, c.last.text);
    return out;
}

/* Of stations between 0 and 1 all lie on the line from the value at 0 to that at 1. */
static int is_straight(int stations, const double path[], const double value[])
{
    for (int i = 0; i < stations; i++) {
        const double first = interpolate(stations, path, value, 0),
                     last = interpolate(stations, path, value, 1),
                     line = first + path[i] * (last - first);
        if (path[i] > 0 && path[i] < 1 &&
            !(fabs(value[i] - line) <= 1e-12 * (fabs(first) + fabs(last))))
            return 0;
    }
    return 1;
}

status along_path_proportional(const scene *s, fault *f)
{
    static const char words[] =
        "from path 0 to 1 its values are not on a line: the critical load of "
        "a linear prestress has no sense; follow a static path";
    for (int i = 0; i < s->loads; i++) {
        const scene_load *load = &s->load[i];
        if (load->stations > 0 && !is_straight(load->stations, load->path, load->factor))
            return fault_set(f, STATUS_REFUSED, "%s: %s", scene_called(s, SCENE_LOADS, i).text,
                             words);
    }
    for (int d = 0; d < s->drivers; d++) {
        const scene_driver *driver = &s->driver[d];
        if (driver->value != NULL && !is_straight(driver->stations, driver->path, driver->value))
            return fault_set(f, STATUS_REFUSED, "driver %s: %s", driver->name, words);
    }
    return STATUS_OK;
}
