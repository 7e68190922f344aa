#include "harness/experiments/experiments_impl.h"

#include <math.h>
#include <string.h>

enum { TEXT = 64, LONG_TEXT = 128 };

typedef struct axis_row {
    char name[TEXT], unit[16], kind[8], scale[8];
    int count;
} axis_row;
typedef struct worst_row {
    long point;
    char formulation[FORMULATION_KEY];
    int mesh;
    char quantity[SCENE_NAME];
    double error;
    char status[16], scene[LONG_TEXT];
} worst_row;

static void insert_text(hid_t table, const char *name, size_t offset, size_t length)
{
    const hid_t type = record_text_type(length);
    H5Tinsert(table, name, offset, type);
    H5Tclose(type);
}

static void put_axes(record_file *r, hid_t at, const parameter_ranges *of)
{
    axis_row row[CASE_MAX_PARAMETERS];
    memset(row, 0, sizeof row);
    for (int i = 0; i < of->design.axes; i++) {
        const sweep_axis *a = &of->axis[i];
        const int range = a->value == NULL, scattered = of->design.kind != DESIGN_GRID;
        snprintf(row[i].name, sizeof row[i].name, "%s", a->of->name);
        snprintf(row[i].unit, sizeof row[i].unit, "%s", a->of->unit);
        snprintf(row[i].kind, sizeof row[i].kind, "%s",
                 range && scattered ? design_name(of->design.kind) : axis_kind_name(a->kind));
        snprintf(row[i].scale, sizeof row[i].scale, "%s", range ? axis_kind_name(a->kind) : "");
        row[i].count = range && scattered ? (int)of->design.points : a->count;
    }
    const hid_t type = H5Tcreate(H5T_COMPOUND, sizeof row[0]);
    insert_text(type, "name", offsetof(axis_row, name), sizeof row[0].name);
    insert_text(type, "unit", offsetof(axis_row, unit), sizeof row[0].unit);
    insert_text(type, "kind", offsetof(axis_row, kind), sizeof row[0].kind);
    insert_text(type, "scale", offsetof(axis_row, scale), sizeof row[0].scale);
    H5Tinsert(type, "count", offsetof(axis_row, count), H5T_NATIVE_INT);
    H5Dclose(record_table(r, at, "axes", type, of->design.axes, row));
    H5Tclose(type);
}

static void put_quantities(record_file *r, hid_t at, const parameter_ranges *of)
{
    const hid_t type = H5Tcreate(H5T_COMPOUND, sizeof of->quantity[0]);
    insert_text(type, "name", offsetof(ranges_quantity, name), sizeof of->quantity[0].name);
    insert_text(type, "unit", offsetof(ranges_quantity, unit), sizeof of->quantity[0].unit);
    H5Dclose(record_table(r, at, "quantities", type, of->quantities, of->quantity));
    H5Tclose(type);
}

static void put_formulations(record_file *r, hid_t at, const parameter_ranges *of)
{
    const hid_t type = H5Tcreate(H5T_COMPOUND, sizeof of->formulation[0]);
    insert_text(type, "key", offsetof(formulation, key), sizeof of->formulation[0].key);
    const hid_t stored = H5Tcopy(type);
    H5Tpack(stored);
    const hsize_t size = (hsize_t)of->formulations;
    const hid_t space = H5Screate_simple(1, &size, NULL),
                set = H5Dcreate2(at, "formulations", stored, space, H5P_DEFAULT, H5P_DEFAULT,
                                 H5P_DEFAULT);
    r->bad |= set < 0 || H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, of->formulation) < 0;
    H5Dclose(set);
    H5Sclose(space);
    H5Tclose(stored);
    H5Tclose(type);
}

void ranges_file_request(record_file *r, hid_t at, const parameter_ranges *of, const char *plan)
{
    const environment e = environment_now(1);
    const ranges_request *q = &of->request;
    char fixed[PARAMETERS_TEXT], noise[TEXT];
    const hsize_t meshes = (hsize_t)of->meshes;
    parameters_text(q->type, of->base, fixed, sizeof fixed);
    store_environment(r, at, &e);
    record_count(r, at, KEPT_SWEEP_MARK, RANGES_FILE_VERSION);
    record_text(r, at, q->file != NULL ? "scene" : "case",
                q->file != NULL ? scene_file_path(q->type) : q->type->name);
    record_text(r, at, "plan", plan);
    record_text(r, at, "parameters", fixed);
    record_text(r, at, "design", design_name(of->design.kind));
    if (of->design.kind == DESIGN_RANDOM)
        record_count(r, at, "seed", (long)of->design.seed);
    if (q->select != NULL)
        record_text(r, at, "selection", q->select);
    snprintf(noise, sizeof noise, "%.15g", counted_cost_noise);
    /* costs count as equal if their ratio is smaller */
    record_text(r, at, "cost_noise", noise);
    record_count(r, at, "axes", of->design.axes);
    record_number(r, at, "tolerance", q->tolerance);
    H5Dclose(record_array(r, at, "meshes", H5T_NATIVE_INT, 1, &meshes, of->mesh));
    put_axes(r, at, of);
    put_quantities(r, at, of);
    put_formulations(r, at, of);
}

void ranges_file_worst(record_file *r, hid_t at, const parameter_ranges *of, const tally *t)
{
    worst_row row[RANGES_FORMULATIONS * TALLY_WORST];
    int count = 0;
    memset(row, 0, sizeof row);
    for (int i = 0; i < of->formulations; i++)
        for (int k = 0; k < t->worsts[i]; k++) {
            const tally_worst *w = &t->worst[i][k];
            worst_row *out = &row[count++];
            out->point = w->point;
            out->mesh = of->mesh[of->meshes - 1];
            out->error = w->error;
            snprintf(out->formulation, sizeof out->formulation, "%s", of->formulation[i].key);
            snprintf(out->quantity, sizeof out->quantity, "%s",
                     w->quantity >= 0 ? of->quantity[w->quantity].name : "");
            snprintf(out->status, sizeof out->status, "%s", rows_status_name(w->status));
            snprintf(out->scene, sizeof out->scene, "%s", w->scene);
        }
    const hid_t type = H5Tcreate(H5T_COMPOUND, sizeof row[0]);
    H5Tinsert(type, "point", offsetof(worst_row, point), H5T_NATIVE_LONG);
    insert_text(type, "formulation", offsetof(worst_row, formulation), sizeof row[0].formulation);
    H5Tinsert(type, "mesh", offsetof(worst_row, mesh), H5T_NATIVE_INT);
    insert_text(type, "quantity", offsetof(worst_row, quantity), sizeof row[0].quantity);
    H5Tinsert(type, "error", offsetof(worst_row, error), H5T_NATIVE_DOUBLE);
    insert_text(type, "status", offsetof(worst_row, status), sizeof row[0].status);
    insert_text(type, "scene", offsetof(worst_row, scene), sizeof row[0].scene);
    H5Dclose(record_table(r, at, "worst", type, count, row));
    H5Tclose(type);
}

void ranges_points_values(const parameter_ranges *r, const double at[],
                          double value[CASE_MAX_PARAMETERS])
{
    memcpy(value, r->base, sizeof r->base);
    for (int i = 0; i < r->design.axes; i++)
        value[r->axis[i].index] = at[i];
}

void ranges_points_text(const parameter_ranges *r, const double at[], char *text, int size)
{
    int used = 0;
    text[0] = '\0';
    for (int i = 0; i < r->design.axes && used < size; i++) {
        char word[ASSIGNMENT_VALUE];
        axis_text(&r->axis[i], at[i], word, sizeof word);
        used += snprintf(text + used, (size_t)(size - used), "%s%s=%s", i > 0 ? ", " : "",
                         r->axis[i].of->name, word);
    }
}

enum { LAST_KNOWN = 2 };

static void describe_unmeasured(const tally *t, int q, char *text, size_t size)
{
    enum { NAMED = 3 };
    const long none = t->kind[q][ROWS_NONE] + t->kind[q][ROWS_DISPUTED];
    int count = 0;
    size_t used = 0;
    text[0] = '\0';
    for (int i = 0; i < t->of->formulations; i++) {
        const long open = tally_of(t, i, q)->open - none;
        if (open <= 0 || count++ >= NAMED)
            continue;
        used += (size_t)snprintf(text + used, size - used, "%s%s at %ld points",
                                 count > 1 ? ", " : "; not for ", t->of->formulation[i].key, open);
        used = used < size ? used : size - 1;
    }
    if (count > NAMED)
        snprintf(text + used, size - used, " and %d more", count - NAMED);
}

static void describe_reference(const tally *t, int q, char text[RANGES_TABLE_LINE])
{
    const long *kind = t->kind[q];
    const int alone = t->of->formulations == 1;
    const struct {
        long count;
        const char *words;
    } part[] = {
        {kind[ROWS_STORED], "stored reference values"},
        {kind[ROWS_DERIVED], "reference values computed for each point"},
        {kind[ROWS_LIMIT], alone ? "the limit of the same meshes, which shows only convergence"
                                 : "the limit of the meshes of all formulations of one theory"},
        {kind[ROWS_NONE], "none, because no limit has an uncertainty below half of the target "
                          "error (use finer meshes with -n, or --compute-references)"},
        {kind[ROWS_DISPUTED], "none, because the limits of the formulations disagree"}};
    size_t used = 0;
    int parts = 0;
    text[0] = '\0';
    for (size_t i = 0; i < sizeof part / sizeof part[0]; i++) {
        if (part[i].count > 0)
            used += (size_t)snprintf(text + used, RANGES_TABLE_LINE - used, "%s%ld point%s: %s",
                                     parts++ > 0 ? "; " : "", part[i].count,
                                     part[i].count == 1 ? "" : "s", part[i].words);
        if (i == LAST_KNOWN && parts > 0)
            used += (size_t)snprintf(text + used, RANGES_TABLE_LINE - used,
                                     ", known to %.1g %% or better",
                                     100 * fmax(t->uncertainty[q], 1e-16));
    }
    used = used < RANGES_TABLE_LINE ? used : RANGES_TABLE_LINE - 1;
    describe_unmeasured(t, q, text + used, RANGES_TABLE_LINE - used);
}

/* Writes the kinds of references of a quantity. Later quantities with the same text share the
 * paragraph; their entries of `written` are set to 1. */
static void write_reference(FILE *to, const tally *t, int q, char written[])
{
    char text[RANGES_TABLE_LINE], other[RANGES_TABLE_LINE];
    paragraph words;
    const int begun = fprintf(to, "  %s", t->of->quantity[q].name);
    FILE *out = paragraph_begin(&words, to);
    describe_reference(t, q, text);
    for (int i = q + 1; i < t->of->quantities; i++) {
        describe_reference(t, i, other);
        if (written[i] || strcmp(text, other) != 0)
            continue;
        written[i] = 1;
        fprintf(out, ", %s", t->of->quantity[i].name);
    }
    fprintf(out, ": %s", text);
    paragraph_end(&words, begun, 6);
}

static void write_without_scene(FILE *to, const tally *t)
{
    const parameter_ranges *r = t->of;
    double at[CASE_MAX_PARAMETERS], value[CASE_MAX_PARAMETERS];
    char where[PARAMETERS_TEXT];
    scene s;
    fault why = {""};
    if (design_points(&r->design, t->first_without, 1, at, NULL) != STATUS_OK)
        return;
    ranges_points_values(r, at, value);
    ranges_points_text(r, at, where, sizeof where);
    cell_scene(r->request.type, value, NULL, &s, &why);
    scene_free(&s);
    paragraph_printf(to,
                     fprintf(to, "  no scene can be built at %ld point%s", t->without_scene,
                             t->without_scene == 1 ? "" : "s"),
                     6, "; the first is at %s: %s", where, why.text);
}

void ranges_table_known(FILE *to, const tally *t)
{
    char written[RANGES_QUANTITIES] = {0};
    fprintf(to, "errors are relative to these reference values\n");
    for (int q = 0; q < t->of->quantities; q++)
        if (!written[q])
            write_reference(to, t, q, written);
    if (t->without_scene > 0)
        write_without_scene(to, t);
}

/* Returns 1 if the row contains errors with respect to reference values and errors with respect to
 * limits. Only the former show the effect of physics that a theory omits. */
static int is_mixed(const tally *t, int which, int q)
{
    const tally_series *s = tally_of(t, which, q);
    return s->proven > 0 && s->proven < s->requested;
}

static void write_place(FILE *to, const tally_place *p, int mixed)
{
    char text[24];
    if (p->points == 0)
        snprintf(text, sizeof text, ".");
    else if (p->other == p->points)
        snprintf(text, sizeof text, "o");
    else if (p->requested == 0)
        snprintf(text, sizeof text, "?");
    else if (p->never > 0)
        snprintf(text, sizeof text, "-%s", mixed && p->proven > 0 ? "*" : "");
    else
        snprintf(text, sizeof text, "%d%s%s", p->least, mixed && p->proven > 0 ? "*" : "",
                 p->requested + p->other < p->points ? "?" : "");
    fprintf(to, "%*s", RANGES_TABLE_COLUMN, text);
}

static void edge_text(const tally *t, int index, int place, char *text, int size)
{
    const sweep_axis *a = &t->of->axis[index];
    if (a->of->choices != NULL)
        axis_text(a, tally_edge(t, index, place), text, size);
    else
        snprintf(text, (size_t)size, "%.3g", tally_edge(t, index, place));
}

static void write_columns(FILE *to, const tally *t)
{
    char edge[ASSIGNMENT_VALUE];
    fprintf(to, "  %-*.*s", RANGES_TABLE_NAME, RANGES_TABLE_NAME, t->of->axis[0].of->name);
    for (int i = 0; i < t->columns; i++) {
        edge_text(t, 0, i, edge, sizeof edge);
        fprintf(to, "%*.*s", RANGES_TABLE_COLUMN, RANGES_TABLE_COLUMN - 1, edge);
    }
    fputc('\n', to);
}

static void write_fields(FILE *to, const tally *t, const char *label, int which, int q, int at)
{
    fprintf(to, "  %-*.*s", RANGES_TABLE_NAME, RANGES_TABLE_NAME, label);
    for (int i = 0; i < t->columns; i++)
        write_place(to, tally_at(t, which, q, at, i), is_mixed(t, which, q));
    fputc('\n', to);
}

static void write_maps_of(FILE *to, const tally *t, int q)
{
    const parameter_ranges *r = t->of;
    if (r->design.axes == 1) {
        fprintf(to, "%s\n", ranges_table_name(r, q));
        write_columns(to, t);
        for (int i = 0; i < r->formulations; i++)
            write_fields(to, t, r->formulation[i].key, i, q, 0);
        return;
    }
    for (int i = 0; i < r->formulations; i++) {
        fprintf(to, "%s, %s\n", r->formulation[i].key, ranges_table_name(r, q));
        write_columns(to, t);
        for (int k = 0; k < t->lines; k++) {
            char edge[ASSIGNMENT_VALUE], label[2 * ASSIGNMENT_VALUE];
            edge_text(t, 1, k, edge, sizeof edge);
            snprintf(label, sizeof label, "%.*s %s", RANGES_TABLE_NAME - 10, r->axis[1].of->name,
                     edge);
            write_fields(to, t, label, i, q, k);
        }
    }
}

static int has_mixed(const tally *t)
{
    int mixed = 0;
    for (int i = 0; i < t->of->formulations; i++)
        for (int q = 0; q <= t->of->quantities; q++)
            mixed |= is_mixed(t, i, q);
    return mixed;
}

static int has_other(const tally *t)
{
    long others = 0;
    for (int i = 0; i < t->of->formulations; i++)
        others += t->others[i];
    return others > 0;
}

/* Returns 1 if a field of the map contains a point without a reference and, with parts 1, also a
 * point with a reference or, with parts 0, no such point. */
static int has_unknown(const tally *t, int parts)
{
    const parameter_ranges *r = t->of;
    int unknown = 0;
    for (int i = 0; i < r->formulations * (r->quantities + 1) * t->lines * t->columns; i++) {
        const tally_place *p = &t->map[i];
        unknown |=
            p->requested + p->other < p->points && (parts ? p->requested > 0 : p->requested == 0);
    }
    return unknown;
}

static int is_coarse(const tally *t)
{
    const int shown[] = {t->columns, t->lines};
    int coarse = 0;
    for (int i = 0; i < t->of->design.axes; i++)
        coarse |= t->of->axis[i].count != shown[i];
    return coarse;
}

void ranges_table_map(FILE *to, const tally *t, int every)
{
    const parameter_ranges *r = t->of;
    if (t->columns == 0) {
        fprintf(to,
                "\nno map, because %d parameters vary; the report page of the sweep shows slices\n",
                r->design.axes);
        return;
    }
    fprintf(to, "\n");
    paragraph_printf(
        to, fprintf(to, "smallest n "), 2,
        "at and above which every mesh is within %g %%; -: not even with n = %d%s%s%s%s%s",
        100 * r->request.tolerance, r->mesh[r->meshes - 1],
        has_other(t) ? "; o: another model" : "",
        has_unknown(t, 0) ? "; ?: no reference value" : "",
        has_unknown(t, 1) ? "; a number with ?: some of its points have no reference value" : "",
        has_mixed(t)
            ? "; *: errors relative to reference values; other numbers: errors relative to limits "
              "of meshes, which do not show the effect of physics that a theory omits"
            : "",
        is_coarse(t) ? "; each field shows the number of elements that suffices for all "
                       "its points; column and row give the lower bounds of the field"
                     : "");
    for (int q = 0; q < r->quantities && every && r->quantities > 1; q++)
        write_maps_of(to, t, q);
    write_maps_of(to, t, r->quantities > 1 ? r->quantities : 0);
}
