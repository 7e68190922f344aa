#include "harness/study/study_impl.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/shared/parameter.h"

/* Opens the file. FAULT: the file is damaged, or is not a beamwork file. *file is negative if no
 * file is open. */
static status truths_file_open(const char *path, hid_t *file, fault *f);

status truths_reserve(truths *t, int more, fault *f)
{
    if (t->rows + more <= t->room)
        return STATUS_OK;
    const size_t room = (size_t)t->rows + (size_t)more;
    truth *row = realloc(t->row, (room + 1) * sizeof *row);
    if (row == NULL)
        return fault_memory(f, "reference values");
    t->row = row;
    t->room = (int)room;
    return STATUS_OK;
}

truth *truths_add(truths *t, fault *f)
{
    if (t->rows >= t->room && truths_reserve(t, t->rows / 4 + 16, f) != STATUS_OK)
        return NULL;
    memset(&t->row[t->rows], 0, sizeof *t->row);
    return &t->row[t->rows++];
}

static status read_table(table_columns *r, hid_t all, const case_type *type, truths *out)
{
    TRY(columns_open(r, all));
    TRY(truths_reserve(out, r->rows, r->f));
    for (int i = 0; i < r->rows; i++)
        truths_add(out, r->f);
    return truth_rows_read(r, type, out->row + out->rows - r->rows);
}

static status read_case(const char *path, hid_t all, const case_type *type, truths *out, fault *f)
{
    table_columns r = {.path = path, .f = f};
    snprintf(r.name, sizeof r.name, "%s", type->name);
    if (H5Lexists(all, type->name, H5P_DEFAULT) <= 0)
        return STATUS_OK;
    const status outcome = read_table(&r, all, type, out);
    columns_close(&r);
    return outcome;
}

static status read_cases(const char *path, hid_t all, const case_type *only, truths *out, fault *f)
{
    if (only != NULL)
        return read_case(path, all, only, out, f);
    for (int i = 0; registry_cases[i] != NULL; i++)
        TRY(read_case(path, all, registry_cases[i], out, f));
    return STATUS_OK;
}

static void find_unknown_cases(hid_t all, truths *out)
{
    char name[64];
    for (hsize_t i = 0; H5Lget_name_by_idx(all, ".", H5_INDEX_NAME, H5_ITER_INC, i, name,
                                           sizeof name, H5P_DEFAULT) > 0;
         i++) {
        int known = 0;
        for (int k = 0; registry_cases[k] != NULL; k++)
            known |= strcmp(registry_cases[k]->name, name) == 0;
        if (!known && out->unknown_cases++ == 0)
            snprintf(out->unknown_case, sizeof out->unknown_case, "%s", name);
    }
}

typedef struct truths_wanted {
    const char *group;
    const case_type *only;
    int rules;
} truths_wanted;

static status read_tables(const char *path, hid_t file, const truths_wanted *what, truths *out,
                          fault *f)
{
    const hid_t all = H5Gopen2(file, what->group, H5P_DEFAULT);
    if (all < 0)
        return fault_set(f, STATUS_FAULT,
                         "%s: the file has no group %s; build it again ('make all')", path,
                         what->group);
    const status outcome = read_cases(path, all, what->only, out, f);
    if (outcome == STATUS_OK && what->only == NULL)
        find_unknown_cases(all, out);
    H5Gclose(all);
    return outcome;
}

static status read_open(const char *path, const truths_wanted *what, hid_t *file, truths *out,
                        fault *f)
{
    TRY(truths_file_open(path, file, f));
    if (what->group != NULL)
        TRY(read_tables(path, *file, what, out, f));
    if (!what->rules)
        return STATUS_OK;
    TRY(accepted_read(path, *file, f));
    return rules_read(path, *file, &out->rule, &out->rules, f);
}

static status read_file(const char *path, const truths_wanted *what, truths *out, fault *f)
{
    hid_t file;
    const status outcome = read_open(path, what, &file, out, f);
    if (file >= 0)
        H5Fclose(file);
    return outcome;
}

static status read_new(const char *path, const truths_wanted *what, truths *out, fault *f)
{
    memset(out, 0, sizeof *out);
    status outcome = read_file(path, what, out, f);
    if (outcome == STATUS_OK)
        outcome = truth_index_make(out, f);
    if (outcome != STATUS_OK)
        truths_free(out);
    return outcome;
}

status truths_read(const char *path, truths *out, fault *f)
{
    return truths_read_case(path, NULL, out, f);
}

status truths_read_case(const char *path, const case_type *type, truths *out, fault *f)
{
    return read_new(path, &(truths_wanted){.group = "truths", .only = type, .rules = 1}, out, f);
}

status truths_read_rules(const char *path, truths *out, fault *f)
{
    return read_new(path, &(truths_wanted){.rules = 1}, out, f);
}

status truths_read_extremes(const char *path, truths *out, fault *f)
{
    return read_file(path, &(truths_wanted){.group = "extremes"}, out, f);
}

void truths_free(truths *t)
{
    for (int i = 0; i < t->rows; i++) {
        truth *r = &t->row[i];
        char *const all[] = {r->formulation, r->theory, r->quantity,   r->unit,
                             r->kind,        r->model,  r->convention, r->source};
        for (size_t k = 0; k < sizeof all / sizeof all[0]; k++)
            free(all[k]);
    }
    rules_free(t->rule, t->rules);
    truth_index_free(t);
    free(t->row);
    memset(t, 0, sizeof *t);
}

static status check_schema(hid_t file, const char *path, fault *f)
{
    char name[64] = "";
    int version = 0;
    const hid_t schema = H5Aexists(file, "schema") > 0 ? H5Aopen(file, "schema", H5P_DEFAULT) : -1;
    const hid_t type = schema >= 0 ? H5Aget_type(schema) : -1;
    if (type >= 0 && H5Tget_class(type) == H5T_STRING && !H5Tis_variable_str(type) &&
        H5Tget_size(type) < sizeof name)
        H5Aread(schema, type, name);
    const hid_t number =
        H5Aexists(file, "version") > 0 ? H5Aopen(file, "version", H5P_DEFAULT) : -1;
    if (number >= 0)
        H5Aread(number, H5T_NATIVE_INT, &version);
    handles_close(3, (const hid_t[]){number, type, schema});
    if (strcmp(name, "beamwork-truths") != 0)
        return fault_set(f, STATUS_FAULT,
                         "%s: the file does not contain reference values; build it with 'make all'",
                         path);
    if (version != TRUTHS_VERSION)
        return fault_set(f, STATUS_FAULT,
                         "%s: the reference values have version %d, but this program reads version "
                         "%d; build the file again ('make all')",
                         path, version, TRUTHS_VERSION);
    return STATUS_OK;
}

static status truths_file_open(const char *path, hid_t *file, fault *f)
{
    *file = -1;
    TRY(checksum_check(path, f));
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    *file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    if (*file < 0)
        return fault_set(f, STATUS_FAULT, "%s: cannot be read as HDF5; build it with 'make all'",
                         path);
    return check_schema(*file, path, f);
}

typedef struct taker {
    const case_type *type;
    truths *truths;
} taker;

static int same_point(const case_type *type, const double a[], const double b[])
{
    for (int i = 0; i < parameter_count(type->parameters); i++)
        if (a[i] != b[i])
            return 0;
    return 1;
}

static int is_same(const truth *row, const scene_truth *one)
{
    return strcmp(row->quantity, one->quantity) == 0 && strcmp(row->kind, one->kind) == 0 &&
           strcmp(row->formulation, one->formulation) == 0 &&
           strcmp(row->theory, one->theory) == 0 && strcmp(row->model, one->model) == 0 &&
           (isnan(one->at) ? !row->on_curve : row->at == one->at);
}

static int is_known_row(const truths *t, const case_type *type, const scene_truth *one)
{
    for (int i = 0; i < t->rows; i++)
        if (t->row[i].type == type && is_same(&t->row[i], one) &&
            same_point(type, t->row[i].parameter, one->parameter))
            return 1;
    return 0;
}

static status add_row(truths *t, const case_type *type, const scene_truth *one, fault *f)
{
    truth *row = truths_add(t, f);
    if (row == NULL)
        return STATUS_FAULT;
    row->type = type;
    memcpy(row->parameter, one->parameter, sizeof row->parameter);
    row->value = one->value;
    row->uncertainty = one->uncertainty;
    row->on_curve = !isnan(one->at);
    row->at = one->at;
    char **const to[] = {&row->formulation, &row->theory, &row->quantity,   &row->unit,
                         &row->kind,        &row->model,  &row->convention, &row->source};
    const char *const from[] = {one->formulation, one->theory, one->quantity,   one->unit,
                                one->kind,        one->model,  one->convention, one->source};
    for (size_t i = 0; i < sizeof to / sizeof to[0]; i++)
        if ((*to[i] = strdup(from[i])) == NULL)
            return fault_memory(f, "reference values");
    return STATUS_OK;
}

static status take(void *to, const scene_truth *one, fault *f)
{
    const taker *t = to;
    return is_known_row(t->truths, t->type, one) ? STATUS_OK : add_row(t->truths, t->type, one, f);
}

status scene_truths_add(const scene_file *file, const double value[], truths *t, fault *f)
{
    taker to = {scene_file_case(file), t};
    return scene_file_truths(file, value, take, &to, f);
}

status scene_truths_add_all(const scene_file *file, truths *t, fault *f)
{
    taker to = {scene_file_case(file), t};
    return scene_file_truths_all(file, take, &to, f);
}

static status read_all(table_columns *c, hid_t file, glossary_entry **out)
{
    static const columns_field field[] = {
        {"term", COLUMN_TEXT, offsetof(glossary_entry, term)},
        {"also", COLUMN_TEXT, offsetof(glossary_entry, also)},
        {"group", COLUMN_TEXT, offsetof(glossary_entry, group)},
        {"meaning", COLUMN_TEXT, offsetof(glossary_entry, meaning)},
        {"see", COLUMN_TEXT, offsetof(glossary_entry, see)},
    };
    TRY(columns_open(c, file));
    glossary_entry *all = *out = calloc((size_t)c->rows + 1, sizeof *all);
    if (all == NULL)
        return fault_memory(c->f, "the glossary");
    for (size_t k = 0; k < sizeof field / sizeof field[0]; k++)
        TRY(columns_read(c, &field[k], all, sizeof *all));
    return STATUS_OK;
}

static status glossary_read_open(const char *path, hid_t *file, glossary *out, fault *f)
{
    table_columns c = {.path = path, .name = "glossary", .f = f};
    TRY(truths_file_open(path, file, f));
    const status outcome = read_all(&c, *file, &out->entry);
    columns_close(&c);
    out->entries = out->entry != NULL ? c.rows : 0;
    return outcome;
}

status glossary_read(const char *path, glossary *out, fault *f)
{
    hid_t file = -1;
    memset(out, 0, sizeof *out);
    const status outcome = glossary_read_open(path, &file, out, f);
    if (file >= 0)
        H5Fclose(file);
    if (outcome != STATUS_OK)
        glossary_free(out);
    return outcome;
}

void glossary_free(glossary *g)
{
    for (int i = 0; i < g->entries; i++) {
        free(g->entry[i].term);
        free(g->entry[i].also);
        free(g->entry[i].group);
        free(g->entry[i].meaning);
        free(g->entry[i].see);
    }
    free(g->entry);
    memset(g, 0, sizeof *g);
}

int glossary_part(const char *list, int index, char word[GLOSSARY_WORD])
{
    for (int i = 0; i < index && list != NULL; i++) {
        list = strchr(list, '|');
        list = list != NULL ? list + 1 : NULL;
    }
    if (list == NULL || list[0] == '\0')
        return 0;
    snprintf(word, GLOSSARY_WORD, "%.*s", (int)strcspn(list, "|"), list);
    return 1;
}

static int blank(char c)
{
    return c == ' ' || c == '_' || c == '-';
}

int glossary_same(const char *a, const char *b)
{
    for (;; a++, b++) {
        while (blank(a[0]) && blank(a[1]))
            a++;
        while (blank(b[0]) && blank(b[1]))
            b++;
        if (!(blank(*a) && blank(*b)) && tolower((unsigned char)*a) != tolower((unsigned char)*b))
            return 0;
        if (*a == '\0')
            return 1;
    }
}

static int is_named(const glossary_entry *e, const char *word)
{
    char other[GLOSSARY_WORD];
    if (glossary_same(e->term, word))
        return 1;
    for (int i = 0; glossary_part(e->also, i, other); i++)
        if (glossary_same(other, word))
            return 1;
    return 0;
}

const glossary_entry *glossary_find(const glossary *g, const char *word)
{
    for (int i = 0; i < g->entries; i++)
        if (is_named(&g->entry[i], word))
            return &g->entry[i];
    return NULL;
}
