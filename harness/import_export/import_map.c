#include "harness/import_export/import_export_impl.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases/format/format.h"
#include "elements/shared/choice.h"

static void map_keys_check(const document_node *map, const char *const known[], mistakes *m);
/* Returns the value of an entry, a whole number of at least 0, or `otherwise` if the entry is
 * missing. Another value is added to m as an error. */
static int map_keys_count(mistakes *m, const document_node *map, const char *key, int otherwise);

enum { WORDS = 128, LAST = -1, ALL = 0 };

static const char *const map_keys[] = {"beamwork_map", "program",  "case",     "model",   "version",
                                       "convention",   "elements", "unknowns", "seconds", "columns",
                                       "values",       "axes",     NULL};
static const char *const value_keys[] = {"file",  "under", "where", "column",   "minus",
                                         "times", "unit",  "rows",  "abscissa", NULL};

typedef struct map_reader {
    const document_node *root;
    mistakes *m;
    import_block block;
    int elements, unknowns;
    double seconds;
} map_reader;

typedef struct wanted {
    const document_node *key, *of, *where;
    const char *file, *under;
    int column, abscissa; /* indices from 0; abscissa -1: there is none */
    int rows;
    double minus, times;
    int seen;
    imported_row row;
} wanted;

/* Returns the index of a column, which is given by its number or by its name in `columns`; -1: an
 * error. */
static int column_named(const map_reader *r, const document_node *at, const char *name)
{
    const document_node *columns = document_find(r->root, "columns");
    const document_node *n = columns != NULL ? document_find(columns, name) : NULL;
    double value = NAN;
    if (line_number(n != NULL && n->kind == DOCUMENT_TEXT ? n->text : name, &value) && value >= 1 &&
        value <= WORDS && value == floor(value))
        return (int)value - 1;
    document_mistake(r->m, at, 0,
                     "'%.40s' is not a column; give the number of a column, such as 2, or a name "
                     "that 'columns' lists",
                     name);
    return -1;
}

static int rows_of(const map_reader *r, const document_node *map)
{
    const char *text = map_keys_text(r->m, map, "rows", "last");
    if (strcmp(text, "last") == 0)
        return LAST;
    if (strcmp(text, "all") == 0)
        return ALL;
    return strcmp(text, "first") == 0 ? 1 : map_keys_count(r->m, map, "rows", 1);
}

static wanted read_value(const map_reader *r, const document_node *key, const document_node *of)
{
    wanted w = {.key = key, .of = of, .column = -1, .abscissa = -1};
    if (of->kind != DOCUMENT_MAP) {
        document_mistake(r->m, of, 0,
                         "%s: the value must be a map; write, for example, {column: 2, unit: mm}",
                         key->text);
        return w;
    }
    map_keys_check(of, value_keys, r->m);
    w.where = document_find(of, "where");
    w.file = map_keys_text(r->m, of, "file", "");
    w.under = map_keys_text(r->m, of, "under", "");
    w.minus = map_keys_number(r->m, of, "minus", 0);
    w.times = map_keys_number(r->m, of, "times", 1);
    w.rows = rows_of(r, of);
    const char *column = map_keys_text(r->m, of, "column", NULL),
               *x = map_keys_text(r->m, of, "abscissa", NULL);
    if (column == NULL || map_keys_text(r->m, of, "unit", NULL) == NULL)
        document_mistake(
            r->m, key, 0,
            "%s: column and unit are required; give, for example, {column: 2, unit: mm}",
            key->text);
    else
        w.column = column_named(r, of, column);
    if (x != NULL)
        w.abscissa = column_named(r, of, x);
    if (w.where != NULL && w.where->kind == DOCUMENT_MAP)
        for (int i = 0; i < w.where->count; i++)
            column_named(r, w.where->key[i], w.where->key[i]->text);
    return w;
}

static int ends_in(const char *name, const char *ending)
{
    const size_t length = strlen(name), size = strlen(ending);
    return length >= size && strcmp(name + length - size, ending) == 0;
}

static int holds(const map_reader *r, const wanted *w, const double number[], int count)
{
    if (w->where == NULL || w->where->kind != DOCUMENT_MAP)
        return 1;
    for (int i = 0; i < w->where->count; i++) {
        const int column = column_named(r, w->where->key[i], w->where->key[i]->text);
        double value;
        if (column < 0 || column >= count || w->where->item[i]->kind != DOCUMENT_TEXT ||
            !line_number(w->where->item[i]->text, &value) || number[column] != value)
            return 0;
    }
    return 1;
}

static void take_row(map_reader *r, wanted *w, const double number[], int count, int line)
{
    if (w->column < 0 || w->column >= count || w->abscissa >= count ||
        !holds(r, w, number, count) || (w->rows > 0 && w->seen >= w->rows))
        return;
    w->seen++;
    w->row = (imported_row){.line = line,
                            .elements = r->elements,
                            .unknowns = r->unknowns,
                            .seconds = r->seconds,
                            .x = w->abscissa >= 0 ? number[w->abscissa] : NAN,
                            .value = w->times * (number[w->column] - w->minus),
                            .uncertainty = NAN};
    snprintf(w->row.unit, sizeof w->row.unit, "%s", map_keys_text(r->m, w->of, "unit", ""));
    snprintf(w->row.quantity, sizeof w->row.quantity, "%s", w->key->text);
    r->block.at = w->key->line;
    if (w->rows == ALL)
        import_block_add(&r->block, &w->row);
}

/* Reads the numbers of a line. Returns their number, or 0 for a line that does not consist of at
 * most WORDS numbers. */
static int numbers_of(char *line, double number[WORDS])
{
    char *word[WORDS];
    const int count = line_words(line, word, WORDS);
    for (int i = 0; i < count && i < WORDS; i++)
        if (!line_number(word[i], &number[i]))
            return 0;
    return count <= WORDS ? count : 0;
}

static void read_lines(map_reader *r, FILE *from, const char *path, wanted list[], int count)
{
    char *line = NULL, heading[256] = "";
    size_t room = 0;
    for (int at = 1; getline(&line, &room, from) >= 0; at++) {
        double number[WORDS];
        char begin[sizeof heading];
        snprintf(begin, sizeof begin, "%s", line_trim(line));
        const int numbers = numbers_of(line, number);
        if (numbers == 0 && begin[0] != '\0')
            memcpy(heading, begin, sizeof heading);
        if (numbers > 0)
            for (int i = 0; i < count; i++)
                if (ends_in(path, list[i].file) &&
                    strncmp(heading, list[i].under, strlen(list[i].under)) == 0)
                    take_row(r, &list[i], number, numbers, at);
    }
    free(line);
}

static status read_files(map_reader *r, const char *const file[], int files, wanted list[],
                         int count, fault *f)
{
    for (int i = 0; i < files; i++) {
        FILE *from = line_open(file[i]);
        if (from == NULL)
            return fault_unreadable(f, file[i], errno);
        read_lines(r, from, file[i], list, count);
        const int failed = ferror(from);
        fclose(from);
        if (failed)
            return fault_unreadable(f, file[i], EIO);
    }
    for (int i = 0; i < count; i++) {
        r->block.at = list[i].key->line;
        if (list[i].seen == 0 || list[i].seen < list[i].rows)
            document_mistake(r->m, list[i].key, 0,
                             "%.60s: no line of the files matches, or fewer lines than 'rows' "
                             "requires; correct 'file', 'where', 'under' or 'rows'",
                             list[i].key->text);
        else if (list[i].rows != ALL)
            import_block_add(&r->block, &list[i].row);
    }
    return STATUS_OK;
}

static int line_of(const map_reader *r, const char *key)
{
    const document_node *n = document_find(r->root, key);
    return n != NULL ? n->line : 0;
}

static import_header header_of(const map_reader *r)
{
    import_header h = {.axes = axes_same};
    snprintf(h.program, sizeof h.program, "%s", map_keys_text(r->m, r->root, "program", ""));
    snprintf(h.of, sizeof h.of, "%s", map_keys_text(r->m, r->root, "case", ""));
    snprintf(h.model, sizeof h.model, "%s", map_keys_text(r->m, r->root, "model", ""));
    snprintf(h.convention, sizeof h.convention, "%s",
             map_keys_text(r->m, r->root, "convention", ""));
    snprintf(h.version, sizeof h.version, "%s", map_keys_text(r->m, r->root, "version", ""));
    h.program_line = line_of(r, "program");
    h.version_line = line_of(r, "version");
    h.of_line = line_of(r, "case");
    h.model_line = line_of(r, "model");
    h.convention_line = line_of(r, "convention");
    if (line_of(r, "axes") > 0 && !axes_parse(map_keys_text(r->m, r->root, "axes", ""), &h.axes))
        document_mistake(r->m, document_find(r->root, "axes"), 0,
                         "axes are not valid; give the program's axis = beamwork's axis for all "
                         "three axes, such as x=x y=-z z=y");
    return h;
}

static void name_files(imported *to, const char *const file[], int files)
{
    size_t used = 0;
    for (int i = 0; i < files && used < sizeof to->file; i++)
        used += (size_t)snprintf(to->file + used, sizeof to->file - used, "%s%s", i > 0 ? "; " : "",
                                 file[i]);
}

static status read_values(map_reader *r, const document_node *values, const char *map,
                          const char *const file[], int files, import_set *into, fault *f)
{
    const import_header h = header_of(r);
    wanted *list = calloc((size_t)values->count + 1, sizeof *list);
    if (list == NULL)
        return fault_memory(f, "a map");
    for (int i = 0; i < values->count; i++)
        list[i] = read_value(r, values->key[i], values->item[i]);
    r->block = import_block_open(into, &h, map, r->m);
    status outcome = STATUS_OK;
    if (r->block.found != NULL)
        name_files(r->block.found, file, files);
    if (r->m->count == 0)
        outcome = read_files(r, file, files, list, values->count, f);
    free(list);
    if (outcome != STATUS_OK) {
        imported_free(r->block.found);
        return outcome;
    }
    return import_block_close(&r->block, f);
}

static status read_keys(map_reader *r, const char *map, const char *const file[], int files,
                        import_set *into, fault *f)
{
    map_keys_check(r->root, map_keys, r->m);
    if (strcmp(map_keys_text(r->m, r->root, "beamwork_map", ""), "1") != 0)
        mistakes_add(r->m, 1, 1, "the map must begin with 'beamwork_map: 1'");
    r->elements = map_keys_count(r->m, r->root, "elements", 0);
    r->unknowns = map_keys_count(r->m, r->root, "unknowns", 0);
    r->seconds = map_keys_number(r->m, r->root, "seconds", NAN);
    if (r->elements < 1)
        mistakes_add(r->m, 1, 2,
                     "the number of elements is missing; add, for example, elements: 8");
    const document_node *values = document_find(r->root, "values");
    if (values != NULL && values->kind == DOCUMENT_MAP && values->count > 0)
        return read_values(r, values, map, file, files, into, f);
    mistakes_add(
        r->m, 1, 3,
        "the key 'values' is missing or empty; add it, with the quantities that the files contain");
    return STATUS_OK;
}

static status read_map(map_reader *r, const char *map, const char *const file[], int files,
                       import_set *into, fault *f)
{
    if (r->root != NULL && r->root->kind != DOCUMENT_MAP)
        mistakes_add(r->m, 1, 1,
                     "the file must be a map of keys that begins with 'beamwork_map: 1'");
    else if (r->root != NULL)
        TRY(read_keys(r, map, file, files, into, f));
    return mistakes_status(r->m, f);
}

status import_map_read(const char *map, const char *const file[], int files, import_set *into,
                       mistakes *m, fault *f)
{
    const size_t room = DOCUMENT_BYTES + 1;
    char *bytes = malloc(room);
    FILE *from = fopen(map, "rb");
    arena a = {0};
    map_reader r = {.m = m};
    status outcome;
    if (bytes == NULL || from == NULL) {
        outcome = fault_unreadable(f, map, errno);
    } else {
        r.root = document_read(bytes, fread(bytes, 1, room, from), &a, m);
        m->out_of_memory |= a.failed;
        outcome = read_map(&r, map, file, files, into, f);
    }
    if (from != NULL)
        fclose(from);
    arena_free(&a);
    free(bytes);
    return outcome;
}

static const char *name_at(const void *context, int i)
{
    return ((const char *const *)context)[i];
}

static void map_keys_check(const document_node *map, const char *const known[], mistakes *m)
{
    for (int i = 0; i < map->count; i++) {
        int found = 0;
        for (int k = 0; known[k] != NULL; k++)
            found |= strcmp(known[k], map->key[i]->text) == 0;
        const char *near = found ? NULL : choice_nearest(map->key[i]->text, name_at, known);
        if (!found)
            document_mistake(m, map->key[i], 0, "unknown key '%.40s'%s%s%s", map->key[i]->text,
                             near != NULL ? "; did you mean '" : "; remove it",
                             near != NULL ? near : "", near != NULL ? "'?" : "");
    }
}

const char *map_keys_text(mistakes *m, const document_node *map, const char *key,
                          const char *otherwise)
{
    const document_node *n = document_find(map, key);
    if (n == NULL)
        return otherwise;
    if (n->kind == DOCUMENT_TEXT)
        return n->text;
    document_mistake(
        m, n, 0, "'%s' must be a word or a text, not a list or a map; write, for example, %s: text",
        key, key);
    return otherwise;
}

double map_keys_number(mistakes *m, const document_node *map, const char *key, double otherwise)
{
    const char *text = map_keys_text(m, map, key, NULL);
    double value;
    if (text == NULL)
        return otherwise;
    if (line_number(text, &value))
        return value;
    document_mistake(m, document_find(map, key), 0,
                     "%s '%.40s' is not a number; give a number such as 8", key, text);
    return otherwise;
}

static int map_keys_count(mistakes *m, const document_node *map, const char *key, int otherwise)
{
    const double value = map_keys_number(m, map, key, otherwise);
    if (value == floor(value) && value >= 0 && value <= 10000000)
        return (int)value;
    document_mistake(m, document_find(map, key), 0,
                     "'%s' must be a whole number that is not negative; give a number such as 8",
                     key);
    return otherwise;
}
