#include "harness/records/records_impl.h"

#include <stdlib.h>
#include <string.h>

#include "cases/format/format.h"

/* Writes a group below `at` with the centre lines, sections and bodies. The caller closes the group
 * with H5Gclose. */
static hid_t store_shapes(record_file *r, hid_t at, const char *name, const scene *sc,
                          const shapes *s);

void store_environment(record_file *r, hid_t at, const environment *e)
{
    record_text(r, at, "schema", SCHEMA_NAME);
    record_count(r, at, "schema_version", SCHEMA_VERSION);
    record_text(r, at, "program_version", e->version);
    record_text(r, at, "commit", e->commit);
    record_text(r, at, "compiler", e->compiler);
    record_text(r, at, "flags", e->flags);
    record_text(r, at, "libraries", e->libraries);
    record_text(r, at, "processor", e->processor);
    record_text(r, at, "clock", e->clock);
    record_count(r, at, "threads", e->threads);
}

static void put_noise(record_file *r, hid_t at)
{
    char noise[32];
    snprintf(noise, sizeof noise, "%.15g", counted_cost_noise);
    record_text(r, at, "cost_noise", noise); /* smaller ratios of costs count as ties */
}

/* Gives the value of a parameter. Each parameter has a separate column. The record is the point,
 * and the offset is the index of the parameter. */
static void get_choice(const subject *s, field_value *out)
{
    const size_t i = out->of->offset;
    assignment_value_text(parameter_at(s->point->type->parameters, i), s->point->parameter[i],
                          out->room, sizeof out->room);
    out->text = out->room;
}

static void get_parameter(const subject *s, field_value *out)
{
    out->numbers = &s->point->parameter[out->of->offset];
}

static int parameter_fields(const case_type *type, schema_field out[CASE_MAX_PARAMETERS])
{
    const parameter_type *p;
    int i = 0;
    for (; (p = parameter_at(type->parameters, i)) != NULL; i++) {
        out[i] = (schema_field){
            p->name, p->unit, FIELD_DOUBLE, p->summary, .offset = (size_t)i, .get = get_parameter};
        if (p->choices != NULL)
            out[i] = (schema_field){
                p->name, "", FIELD_TEXT, p->summary, .offset = (size_t)i, .get = get_choice};
    }
    return i;
}

static void put_points(record_file *r, hid_t at, const case_type *type, const subjects *list)
{
    const schema_field *fields[SCHEMA_MOST_FIELDS + CASE_MAX_PARAMETERS];
    schema_field parameter[CASE_MAX_PARAMETERS];
    int count = schema_fields(&record_point, KEY, fields);
    const int parameters = parameter_fields(type, parameter);
    for (int i = 0; i < parameters; i++)
        fields[count++] = &parameter[i];
    record_rows(r, at, record_point.table, count, fields, list->count, list->row);
}

static void put_scenes(record_file *r, hid_t at, subjects *list)
{
    char **text = calloc((size_t)list->count + 1, sizeof *text);
    r->bad |= text == NULL;
    for (int i = 0; i < list->count && !r->bad; i++) {
        const sweep_point *p = list->row[i].point;
        const write_head head = {p->type->name, p->type->summary, p->type->source};
        text[i] = write_scene_text(p->status == STATUS_OK ? &p->scene : NULL, &head);
        r->bad |= text[i] == NULL;
        list->row[i].record = &text[i];
    }
    if (!r->bad)
        record_rows_of_type(r, at, &record_scene, list->count, list->row);
    for (int i = 0; text != NULL && i < list->count; i++)
        free(text[i]);
    free(text);
}

static void put_curves(record_file *r, hid_t at, const subjects *list)
{
    size_t points = 0;
    for (int i = 0; i < list->count; i++)
        points += (size_t)((const quantity_result *)list->row[i].record)->curve.points;
    double *x = malloc((points + 1) * sizeof *x), *value = malloc((points + 1) * sizeof *value);
    r->bad |= x == NULL || value == NULL;
    for (int i = 0; i < list->count && !r->bad; i++) {
        const curve *c = &((const quantity_result *)list->row[i].record)->curve;
        memcpy(x + list->row[i].group, c->x, (size_t)c->points * sizeof *x);
        memcpy(value + list->row[i].group, c->value, (size_t)c->points * sizeof *value);
    }
    const hsize_t size = points;
    H5Dclose(record_values(r, at, "curve_x", 1, &size, x, NULL));
    H5Dclose(record_values(r, at, "curve_value", 1, &size, value, NULL));
    free(x);
    free(value);
}

static void put_pictures(record_file *r, hid_t at, const subjects *cells)
{
    hid_t all = -1;
    for (int i = 0; i < cells->count && !r->bad; i++) {
        const subject *s = &cells->row[i];
        const cell_result *cell = s->record;
        if (cell->solve.shapes.states == 0 || cell->solve.status != STATUS_OK)
            continue;
        all = all >= 0 ? all : record_group(r, at, "shapes");
        if (H5Lexists(all, s->point->name, H5P_DEFAULT) > 0)
            continue;
        const hid_t one =
            store_shapes(r, all, s->point->name, &s->point->scene, &cell->solve.shapes);
        record_text(r, one, "formulation", s->series->formulation.key);
        record_count(r, one, "elements", s->series->mesh[s->mesh]);
        H5Gclose(one);
    }
    if (all >= 0)
        H5Gclose(all);
}

static void put_records(record_file *r, hid_t at, const gathering *g, const record_type *type,
                        const case_type *of)
{
    subjects list = {0};
    gather_case(g, type, of, &list);
    r->bad |= list.bad;
    if (type == &record_point)
        put_points(r, at, of, &list);
    else if (type == &record_scene)
        put_scenes(r, at, &list);
    else if (!r->bad && ((type != &record_motion && type != &record_assumption) || list.count > 0))
        record_rows_of_type(r, at, type, list.count, list.row);
    if (type == &record_curve)
        put_curves(r, at, &list);
    if (type == &record_cell)
        put_pictures(r, at, &list);
    gather_free(&list);
}

static void put_case(record_file *r, hid_t cases, const gathering *g, const case_type *of)
{
    if (r->bad || H5Lexists(cases, of->name, H5P_DEFAULT) > 0)
        return;
    const hid_t here = record_group(r, cases, of->name);
    record_text(r, here, "summary", of->summary);
    record_text(r, here, "source", of->source);
    for (int i = 0; record_types[i] != NULL && !r->bad; i++)
        put_records(r, here, g, record_types[i], of);
    H5Gclose(here);
}

/* Stores an attribute with names, in one line each. at(s, i) returns name i, or NULL after the last
 * name. */
static void put_names(record_file *r, hid_t group, const char *attribute, const sweep *s,
                      const char *(*at)(const sweep *s, int i))
{
    char *text = NULL;
    size_t size = 0;
    FILE *to = open_memstream(&text, &size);
    if (to == NULL) {
        r->bad = 1;
        return;
    }
    for (int i = 0; at(s, i) != NULL; i++)
        fprintf(to, "%s%s", i > 0 ? "\n" : "", at(s, i));
    r->bad |= fclose(to) != 0;
    if (!r->bad && size > 0)
        record_text(r, group, attribute, text);
    free(text);
}

static const char *case_at(const sweep *s, int i)
{
    return s->cases[i] != NULL ? s->cases[i]->name : NULL;
}

static const char *given_at(const sweep *s, int i)
{
    return i < s->givens ? s->given[i].key : NULL;
}

static void put_selection(record_file *r, hid_t at, const sweep *s)
{
    if (s->cases == NULL)
        return;
    if (s->select != NULL && s->select[0] != '\0')
        record_text(r, at, "selection", s->select);
    put_names(r, at, "selection_cases", s, case_at);
    put_names(r, at, "selection_formulations", s, given_at);
}

static void put_declarations(record_file *r, hid_t at, const gathering *g)
{
    subjects list = {0};
    gather_declarations(g, &list);
    r->bad |= list.bad;
    if (!r->bad)
        record_rows_of_type(r, at, &record_declaration, list.count, list.row);
    gather_free(&list);
}

status store_open(const char *experiment, const sweep *s, const evaluation *j, store *out, fault *f)
{
    *out = (store){.experiment = experiment, .sweep = s, .evaluated = j};
    TRY(record_open(&out->file, f));
    out->root = kept_group(&out->file, experiment);
    out->cases = record_group(&out->file, out->root, "cases");
    return STATUS_OK;
}

void store_case(store *to, const case_type *of)
{
    const gathering g = {to->sweep, to->evaluated, NULL};
    put_case(&to->file, to->cases, &g, of);
}

static void put_outcome(record_file *r, hid_t at, const sweep *s, const evaluation *j)
{
    char sentence[SENTENCE_OF_RUN];
    sentence_of_run(s, j, sentence, sizeof sentence);
    record_text(r, at, "outcome", evaluation_outcome(j));
    record_text(r, at, "sentence", sentence);
}

static void finish(store *to, const environment *e)
{
    const sweep *s = to->sweep;
    const gathering g = {s, to->evaluated, NULL};
    for (int i = 0; i < s->seriess; i++)
        store_case(to, s->point[s->series[i].point].type);
    store_environment(&to->file, to->root, e);
    put_noise(&to->file, to->root);
    put_selection(&to->file, to->root, s);
    put_declarations(&to->file, to->root, &g);
}

static status close_file(store *to, const char *path, fault *f)
{
    H5Gclose(to->cases);
    H5Gclose(to->root);
    return kept_close(&to->file, to->experiment, path, f);
}

status store_close(store *to, const char *path, const environment *e, fault *f)
{
    if (path != NULL) {
        record_count(&to->file, to->root, "unfinished_cells", to->sweep->unfinished);
        finish(to, e);
        if (to->evaluated != NULL)
            put_outcome(&to->file, to->root, to->sweep, to->evaluated);
    }
    return close_file(to, path, f);
}

status store_write(const char *path, const char *experiment, const sweep *s, const evaluation *j,
                   const environment *e, fault *f)
{
    store to;
    TRY(store_open(experiment, s, j, &to, f));
    return store_close(&to, path, e, f);
}

status store_write_solution(const char *path, const sweep *s, const environment *e, fault *f)
{
    store to;
    TRY(store_open(NULL, s, NULL, &to, f));
    finish(&to, e);
    if (s->series[0].cell[0].solve.shapes.states > 0)
        vtkhdf_write(&to.file, &s->point[s->series[0].point].scene,
                     &s->series[0].cell[0].solve.shapes);
    return close_file(&to, path, f);
}

/* Stores columns [first, first + count) of the points of every state: [states x points x count]. */
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

static void put_state_numbers(record_file *r, hid_t at, const scene *sc, const shapes *s)
{
    const hsize_t size = (hsize_t)s->states;
    const char **kind = calloc(2 * (size_t)s->states + 1, sizeof(const char *)),
               **acting = kind + s->states;
    scene_words *called = calloc((size_t)s->states + 1, sizeof *called);
    double *column = calloc(3 * (size_t)s->states + 1, sizeof *column);
    r->bad |= kind == NULL || column == NULL || called == NULL;
    for (int i = 0; i < s->states && !r->bad; i++) {
        if (s->state[i].kind == SHAPE_LINEAR && sc->cases > 0)
            called[i] = scene_acting_called(sc, (int)s->state[i].value);
        acting[i] = called[i].text;
        kind[i] = shapes_kind_name(s->state[i].kind);
        column[i] = s->state[i].analysis;
        column[s->states + i] = s->state[i].value;
        column[2 * s->states + i] = s->state[i].scale;
    }
    if (!r->bad) {
        record_texts(r, at, "kind", s->states, kind);
        record_texts(r, at, "acting", s->states, acting);
        static const char *const name[] = {"analysis", "value", "scale"};
        for (int k = 0; k < 3; k++)
            H5Dclose(record_values(r, at, name[k], 1, &size, column + k * s->states, "1"));
    }
    free(kind);
    free(called);
    free(column);
}

static void put_integers(record_file *r, hid_t at, const char *name, int rows, int columns,
                         const int value[])
{
    const hsize_t size[2] = {(hsize_t)rows, (hsize_t)columns};
    H5Dclose(record_array(r, at, name, H5T_NATIVE_INT, columns > 1 ? 2 : 1, size, value));
}

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
            continue;
        outline_of(&sc->section[i], &c, &o);
        const hsize_t size[3] = {(hsize_t)o.walls, 4, 2};
        snprintf(name, sizeof name, "%d", i);
        const hid_t set = record_values(r, all, name, 3, size, &o.corner[0][0][0], "m");
        record_count(r, set, "equivalent", o.equivalent);
        H5Dclose(set);
    }
    H5Gclose(all);
}

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

static hid_t store_shapes(record_file *r, hid_t at, const char *name, const scene *sc,
                          const shapes *s)
{
    const hid_t here = record_group(r, at, name);
    const hsize_t size[3] = {(hsize_t)s->states, (hsize_t)s->nodes, 3};
    put_structure(r, here, sc);
    put_sections(r, here, sc);
    put_far_ends(r, here, sc);
    put_integers(r, here, "first_point", s->members + 1, 1, s->first);
    put_state_numbers(r, here, sc, s);
    put_columns(r, here, "position", s, 0, 3, "m", "x y z");
    put_columns(r, here, "orientation", s, 3, 4, "1", "w x y z");
    put_columns(r, here, "force", s, 7, 3, "N", "N Qy Qz");
    put_columns(r, here, "moment", s, 10, 3, "N m", "Mx My Mz");
    put_columns(r, here, "bimoment", s, 13, 1, "N m^2", "B");
    H5Dclose(record_values(r, here, "nodes", 3, size, s->node, "m"));
    return here;
}
