#include "harness/records/records_impl.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

int schema_fields(const record_type *type, int keys, const schema_field *out[SCHEMA_MOST_FIELDS])
{
    int count = 0;
    for (int p = 0; p < RECORD_PARTS && type->part[p] != NULL; p++)
        for (const schema_field *one = type->part[p];
             one->name != NULL && count < SCHEMA_MOST_FIELDS; one++)
            if (one->key <= keys)
                out[count++] = one;
    return count;
}

void schema_set_text(field_value *out, const char *text)
{
    out->text = text != NULL ? text : "";
}

void schema_set_number(field_value *out, double number)
{
    out->number = number;
    out->numbers = &out->number;
}

static const void *base_of(const subject *s, field_base base)
{
    switch (base) {
    case BASE_RECORD:
        return s->record;
    case BASE_SUBJECT:
        return s;
    case BASE_POINT:
        return s->point;
    case BASE_CASE:
        return s->point->type;
    case BASE_SERIES:
        return s->series;
    case BASE_FORMULATION:
        return s->series->formulation.type;
    case BASE_CELL:
        return &s->series->cell[s->mesh];
    case BASE_QUANTITY:
        return &s->point->scene.quantity[s->index];
    case BASE_TRUTH:
        return s->truth;
    case BASE_MODEL_TRUTH:
        return s->model_truth;
    }
    return NULL;
}

static void read_member(const char *at, const schema_field *which, field_value *out)
{
    if (which->kind == FIELD_DOUBLE)
        out->numbers = (const double *)at;
    else if (which->kind == FIELD_TEXT)
        schema_set_text(out, which->address ? *(const char *const *)at : at);
    else
        out->whole = which->kind == FIELD_LONG ? *(const long *)at : *(const int *)at;
}

static void no_value(field_value *out)
{
    out->whole = 0;
    schema_set_text(out, "");
    schema_set_number(out, NAN);
}

void schema_read(const subject *s, const schema_field *which, field_value *out)
{
    const char *base = which->get == NULL ? base_of(s, which->base) : NULL;
    out->of = which;
    if (which->get != NULL)
        which->get(s, out);
    else if (base != NULL)
        read_member(base + which->offset, which, out);
    else
        no_value(out);
    if (which->kind == FIELD_ENUM)
        out->text =
            out->whole >= 0 && out->whole < which->words ? which->word((int)out->whole) : "?";
}

const char *schema_kind_name(field_kind kind)
{
    static const char *const name[FIELD_KINDS] = {"int", "long", "double", "flag", "text", "enum"};
    return kind < FIELD_KINDS ? name[kind] : "?";
}

enum { MOST_LINKS = 40 };

const char *place_leaf(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash != NULL ? slash + 1 : path;
}

status place_unwritable(const char *path, int why, fault *f)
{
    return fault_set(f, STATUS_FAULT,
                     "%.200s cannot be written (%s); give a path in an existing, writable folder "
                     "with free space",
                     path, strerror(why));
}

/* Replaces a path by the target of the link at this path. Returns 0 if there is no link. */
static int follow_link(char path[PATH_MAX])
{
    char text[PATH_MAX], next[2 * PATH_MAX];
    const ssize_t length = readlink(path, text, sizeof text);
    if (length <= 0)
        return 0;
    const int folder = text[0] == '/' ? 0 : (int)(place_leaf(path) - path);
    const int size = snprintf(next, sizeof next, "%.*s%.*s", folder, path, (int)length, text);
    if (size >= PATH_MAX)
        return 0;
    memcpy(path, next, (size_t)size + 1);
    return 1;
}

static int standard_descriptor(const struct stat *there)
{
    for (int i = STDOUT_FILENO; i <= STDERR_FILENO; i++) {
        struct stat own;
        if (fstat(i, &own) == 0 && own.st_dev == there->st_dev && own.st_ino == there->st_ino)
            return i;
    }
    return -1;
}

static void set_kind(const struct stat *there, file_place *out)
{
    out->device = there->st_dev;
    out->inode = there->st_ino;
    out->mode = there->st_mode & 0777;
    out->owner = there->st_uid;
    out->group = there->st_gid;
    out->shared = S_ISCHR(there->st_mode);
    out->descriptor = S_ISREG(there->st_mode) ? standard_descriptor(there) : -1;
    if (S_ISDIR(there->st_mode))
        out->kind = PLACE_FOLDER;
    else
        out->kind = S_ISREG(there->st_mode) && out->descriptor < 0 ? PLACE_FILE : PLACE_STREAM;
}

static status find_folder(const char *given, file_place *out, fault *f)
{
    char folder[PATH_MAX] = ".";
    struct stat there;
    const size_t length = (size_t)(place_leaf(out->path) - out->path);
    if (length > 0) {
        memcpy(folder, out->path, length);
        folder[length] = '\0';
    }
    if (out->path[length] == '\0')
        return place_unwritable(given, EISDIR, f);
    if (stat(folder, &there) != 0)
        return place_unwritable(given, errno, f);
    set_kind(&there, out);
    out->kind = PLACE_FREE;
    out->descriptor = -1;
    return STATUS_OK;
}

status place_find(const char *path, file_place *out, fault *f)
{
    struct stat there;
    const size_t length = strlen(path);
    memset(out, 0, sizeof *out);
    if (length == 0)
        return fault_set(f, STATUS_REFUSED,
                         "the name of an output file is empty; give a name such as results.h5");
    if (length >= sizeof out->path)
        return place_unwritable(path, ENAMETOOLONG, f);
    memcpy(out->path, path, length + 1);
    const int found = stat(path, &there) == 0;
    if (!found && errno != ENOENT)
        return place_unwritable(path, errno, f);
    if (found) {
        set_kind(&there, out);
        if (out->kind == PLACE_STREAM)
            return STATUS_OK;
    }
    for (int i = 0; i < MOST_LINKS && follow_link(out->path); i++)
        ;
    return found ? STATUS_OK : find_folder(path, out, f);
}

int place_same(const file_place *a, const file_place *b)
{
    const int is_free = a->kind == PLACE_FREE;
    if (a->device != b->device || a->inode != b->inode || is_free != (b->kind == PLACE_FREE))
        return 0;
    return !is_free || strcmp(place_leaf(a->path), place_leaf(b->path)) == 0;
}

enum { NAME = 2048 };

int results_part_has(const char *lines, const char *text)
{
    const size_t length = strlen(text);
    for (const char *at = lines; at != NULL; at = strchr(at, '\n')) {
        at += *at == '\n';
        if (strncmp(at, text, length) == 0 && (at[length] == '\n' || at[length] == '\0'))
            return 1;
    }
    return 0;
}

static const char *formulation_of(const char *series_name)
{
    const char *slash = strrchr(series_name, '/');
    return slash != NULL ? slash + 1 : series_name;
}

int results_part_is_fresh(const results_part *p, const char *series_name)
{
    return results_part_has(p->fresh, formulation_of(series_name));
}

int results_part_is_foreign(const char *series_name)
{
    return formulation_find(formulation_of(series_name)) == NULL;
}

const char *results_part_instead(const stored_results *r, const stored_results *other,
                                 const char *series_name)
{
    const size_t point = (size_t)(formulation_of(series_name) - series_name);
    for (int i = 0; i < r->seriess; i++) {
        const char *name = r->series[i].name;
        int both = strncmp(name, series_name, point) != 0 || !results_part_is_foreign(name);
        for (int k = 0; k < other->seriess && !both; k++)
            both = strcmp(other->series[k].name, name) == 0;
        if (!both)
            return formulation_of(name);
    }
    return NULL;
}

int results_part_selects(const results_part *p, const char *series_name, const char *quantity)
{
    char text[NAME];
    snprintf(text, sizeof text, "%s/%s", series_name, quantity);
    return p->select == NULL || select_matches(p->select, text) != 0;
}

/* Returns 1 if the run has a quantity of the series that this selection excludes. */
static int omits_series(const results_part *p, const stored_results *known, const char *series_name)
{
    for (int i = 0; p->select != NULL && i < known->cells; i++)
        for (int k = 0; strcmp(known->cell[i].name, series_name) == 0 && k < known->cell[i].values;
             k++)
            if (!results_part_selects(p, series_name, known->cell[i].value[k].quantity))
                return 1;
    for (int i = 0; p->select != NULL && i < known->seriess; i++)
        for (int k = 0;
             strcmp(known->series[i].name, series_name) == 0 && k < known->series[i].limits; k++)
            if (!results_part_selects(p, series_name, known->series[i].limit[k].quantity))
                return 1;
    return 0;
}

int results_part_differ(const stored_results *a, const stored_results *b, const char *series_name)
{
    if (a->part.select != NULL && b->part.select != NULL &&
        strcmp(a->part.select, b->part.select) == 0)
        return 0;
    return omits_series(&a->part, a, series_name) || omits_series(&a->part, b, series_name) ||
           omits_series(&b->part, a, series_name) || omits_series(&b->part, b, series_name);
}

/* Returns 1 if `name` is the series or, if the series has no options, a series of its case. */
static int is_of_series(const char *name, const char *series_name)
{
    return strchr(formulation_of(series_name), ':') != NULL
               ? strcmp(name, series_name) == 0
               : strncmp(name, series_name, strcspn(series_name, "/") + 1) == 0;
}

static int selects_any(const results_part *p, const stored_results *known, const char *series_name)
{
    const int evaluated = strchr(formulation_of(series_name), ':') != NULL;
    for (int i = 0; i < known->cells; i++) {
        const result_cell *cell = &known->cell[i];
        for (int k = 0; is_of_series(cell->name, series_name) && k < cell->values; k++)
            if ((!evaluated || isfinite(cell->value[k].limit)) &&
                results_part_selects(p, series_name, cell->value[k].quantity))
                return 1;
    }
    for (int i = 0; i < known->seriess; i++) {
        const result_series *one = &known->series[i];
        for (int k = 0; is_of_series(one->name, series_name) && k < one->limits; k++)
            if (results_part_selects(p, series_name, one->limit[k].quantity))
                return 1;
    }
    return 0;
}

static int has_formulation(const stored_results *r, const char *key)
{
    for (int i = 0; i < r->seriess; i++)
        if (strcmp(formulation_of(r->series[i].name), key) == 0)
            return 1;
    return 0;
}

static int is_run(const stored_results *r, const char *series_name)
{
    const size_t point = (size_t)(formulation_of(series_name) - series_name);
    for (int i = 0; i < r->seriess; i++)
        if (strncmp(r->series[i].name, series_name, point) == 0 &&
            strchr(r->series[i].name + point, '/') == NULL)
            return 1;
    return 0;
}

int results_part_needs(const stored_results *r, const stored_results *other,
                       const char *series_name)
{
    const results_part *p = &r->part;
    const char *key = formulation_of(series_name);
    char of[NAME];
    if (results_part_is_foreign(series_name))
        return is_run(r, series_name);
    snprintf(of, sizeof of, "%.*s", (int)strcspn(series_name, "/"), series_name);
    if (p->cases != NULL && !results_part_has(p->cases, of))
        return 0;
    if (p->formulations != NULL && !results_part_has(p->formulations, key))
        return 0;
    if (strchr(key, ':') != NULL && results_part_has(other->part.formulations, key) &&
        !has_formulation(r, key))
        return 0;
    return p->select == NULL || selects_any(p, r, series_name) ||
           selects_any(p, other, series_name);
}

void results_part_free(results_part *p)
{
    free(p->select);
    free(p->cases);
    free(p->formulations);
    free(p->fresh);
    memset(p, 0, sizeof *p);
}
