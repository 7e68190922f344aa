/* Centre lines of a cell in the result file: docs/reference/result_files.md. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/records/outline.h"
#include "harness/records/store_shapes.h"

/* Columns [first, first + count) of the points of every state: [states x points x count]. */
static void put_columns(record_file *r, hid_t at, const char *name, const shapes *s, int first,
                        int count, const char *unit, const char *columns)
{
    enum { NUMBERS = sizeof(centreline_point) / sizeof(double) };
    const size_t rows = (size_t)s->states * (size_t)s->points;
    const hsize_t size[3] = {(hsize_t)s->states, (hsize_t)s->points, (hsize_t)count};
    double *table = malloc((rows + 1) * (size_t)count * sizeof *table);
    r->bad |= table == NULL;
    if (table != NULL)
        for (size_t i = 0; i < rows; i++)
            memcpy(table + i * (size_t)count, (const double *)s->point + i * NUMBERS + first,
                   (size_t)count * sizeof *table);
    const hid_t set = record_values(r, at, name, 3, size, table, unit);
    record_text(r, set, "columns", columns);
    H5Dclose(set);
    free(table);
}

/* One number of every state. */
static void put_state_numbers(record_file *r, hid_t at, const shapes *s)
{
    const hsize_t size = (hsize_t)s->states;
    const char **kind = calloc((size_t)s->states + 1, sizeof(const char *));
    double *column = calloc(3 * (size_t)s->states + 1, sizeof *column);
    r->bad |= kind == NULL || column == NULL;
    for (int i = 0; i < s->states && !r->bad; i++) {
        kind[i] = shapes_kind_name(s->state[i].kind);
        column[i] = s->state[i].analysis;
        column[s->states + i] = s->state[i].value;
        column[2 * s->states + i] = s->state[i].scale;
    }
    if (!r->bad) {
        record_texts(r, at, "kind", s->states, kind);
        static const char *const name[] = {"analysis", "value", "scale"};
        for (int k = 0; k < 3; k++)
            H5Dclose(record_values(r, at, name[k], 1, &size, column + k * s->states, "1"));
    }
    free(kind);
    free(column);
}

static void put_integers(record_file *r, hid_t at, const char *name, int rows, int columns,
                         const int value[])
{
    const hsize_t size[2] = {(hsize_t)rows, (hsize_t)columns};
    H5Dclose(record_array(r, at, name, H5T_NATIVE_INT, columns > 1 ? 2 : 1, size, value));
}

/* What connects the points: sections and ends of the members, bodies and supports of the nodes. */
static void put_structure(record_file *r, hid_t at, const scene *sc)
{
    int *member = calloc((size_t)sc->members * 3 + 1, sizeof *member),
        *attached = calloc((size_t)sc->nodes * 2 + 1, sizeof *attached),
        *released = calloc((size_t)sc->members * 2 + 1, sizeof *released);
    r->bad |= member == NULL || attached == NULL || released == NULL;
    for (int i = 0; i < sc->members && !r->bad; i++) {
        const scene_member *m = &sc->member[i];
        memcpy(member + 3 * i, (const int[3]){m->p, m->q, m->section}, 3 * sizeof *member);
        for (int k = 0; k < m->release[0].count; k++)
            released[2 * i] |= 1 << m->release[0].component[k];
        for (int k = 0; k < m->release[1].count; k++)
            released[2 * i + 1] |= 1 << m->release[1].component[k];
    }
    for (int i = 0; i < sc->nodes && !r->bad; i++) {
        const scene_node *n = &sc->node[i];
        attached[2 * i] = n->attached;
        for (int k = 0; k < 3; k++)
            attached[2 * i + 1] |=
                (n->translation[k] == SCENE_HELD) << k | (n->angle[k] == SCENE_HELD) << (3 + k);
    }
    if (!r->bad) {
        put_integers(r, at, "members", sc->members, 3, member);
        put_integers(r, at, "bodies", sc->nodes, 2, attached);
        put_integers(r, at, "released", sc->members, 2, released);
    }
    free(member);
    free(attached);
    free(released);
}

static void put_sections(record_file *r, hid_t at, const scene *sc)
{
    const hid_t all = record_group(r, at, "sections");
    for (int i = 0; i < sc->sections; i++) {
        outline o;
        char name[16];
        section c;
        if (scene_constants(sc, i, &c, NULL) != STATUS_OK)
            continue; /* the cell could not have been solved */
        outline_of(&sc->section[i], &c, &o);
        const hsize_t size[3] = {(hsize_t)o.walls, 4, 2};
        snprintf(name, sizeof name, "%d", i);
        const hid_t set = record_values(r, all, name, 3, size, &o.corner[0][0][0], "m");
        record_count(r, set, "equivalent", o.equivalent);
        H5Dclose(set);
    }
    H5Gclose(all);
}

/* Of the far ends of members along which the section changes, by the member's number. */
static void put_far_ends(record_file *r, hid_t at, const scene *sc)
{
    if (!scene_tapers(sc))
        return;
    const hid_t all = record_group(r, at, "far_ends");
    for (int i = 0; i < sc->members; i++) {
        const scene_member *m = &sc->member[i];
        outline o;
        char name[16];
        section near, far;
        if (!scene_member_tapers(m) || scene_constants(sc, m->section, &near, NULL) != STATUS_OK ||
            scene_constants(sc, m->section_q, &far, NULL) != STATUS_OK)
            continue;
        outline_of_far_end(&sc->section[m->section_q], &far, &near, &o);
        const hsize_t size[3] = {(hsize_t)o.walls, 4, 2};
        snprintf(name, sizeof name, "%d", i);
        H5Dclose(record_values(r, all, name, 3, size, &o.corner[0][0][0], "m"));
    }
    H5Gclose(all);
}

hid_t store_shapes(record_file *r, hid_t at, const char *name, const scene *sc, const shapes *s)
{
    const hid_t here = record_group(r, at, name);
    const hsize_t size[3] = {(hsize_t)s->states, (hsize_t)s->nodes, 3};
    put_structure(r, here, sc);
    put_sections(r, here, sc);
    put_far_ends(r, here, sc);
    put_integers(r, here, "first_point", s->members + 1, 1, s->first);
    put_state_numbers(r, here, s);
    put_columns(r, here, "position", s, 0, 3, "m", "x y z");
    put_columns(r, here, "orientation", s, 3, 4, "1", "w x y z");
    put_columns(r, here, "force", s, 7, 3, "N", "N Qy Qz");
    put_columns(r, here, "moment", s, 10, 3, "N m", "Mx My Mz");
    put_columns(r, here, "bimoment", s, 13, 1, "N m^2", "B");
    H5Dclose(record_values(r, here, "nodes", 3, size, s->node, "m"));
    return here;
}
