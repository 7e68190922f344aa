#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases/format/format_impl.h"

enum { LINE_BYTES = 8192, COLUMNS = 256, NAME_BYTES = 64, COLUMNS_REPORTED = 160 };

typedef struct table_file {
    const document_node *place;
    arena *arena;
    mistakes *mistakes;
    const char *name;
    const document_node *of[2];
    int column[2], columns, begun; /* columns to read, starting at 0; number of columns in the first
                                      row; 1 if the columns are known */
    double last;
    document_node *list[2];
    int line;
    char text[LINE_BYTES], *field[COLUMNS];
} table_file;

static int wrong(const table_file *t, const char *what, const char *which, const char *remedy)
{
    document_mistake(t->mistakes, t->place, 0, "%.80s:%d: %s%.60s%s", t->name,
                     t->line > 0 ? t->line : 1, what, which, remedy);
    return 0;
}

static int check_columns(const table_file *t, int count)
{
    if (count > COLUMNS)
        return wrong(t, "the row has more than 256 columns", "", "; keep those that are needed");
    if (t->begun && count != t->columns)
        return wrong(t, "the number of columns differs from that in the first row", "",
                     "; write decimals with points, and commas between columns");
    return 1;
}

/* Reads the next line that is not blank and does not start with #. Returns NULL at the end of the
 * file, or after an error, which sets *good to 0. */
static char *next_line(table_file *t, FILE *from, int *good)
{
    while (fgets(t->text, sizeof t->text, from) != NULL) {
        t->line++;
        const size_t length = strlen(t->text);
        char *line = line_text(t->text, length);
        if (length + 1 == sizeof t->text)
            *good = wrong(t, "a line has more than 8000 characters", "",
                          "; remove the columns that are not used");
        else if (line == NULL)
            *good = wrong(t, "the line is not UTF-8 text", "", "; save the file as CSV in UTF-8");
        if (!*good)
            return NULL;
        if (*line != '\0' && *line != '#')
            return line;
    }
    if (ferror(from))
        *good = wrong(t, "the rest of the file cannot be read", "", "; check the file");
    return NULL;
}

static int split(table_file *t, char *line)
{
    if (strchr(line, ',') == NULL)
        for (char *c = strchr(line, ';'); c != NULL; c = strchr(c, ';'))
            *c = ',';
    return strchr(line, ',') != NULL ? line_split(line, t->field, COLUMNS)
                                     : line_words(line, t->field, COLUMNS);
}

/* Returns the column with a given name or number, or -1 after an error. A name requires a
 * header. */
static int column_of(const table_file *t, const document_node *of, int header)
{
    char known[COLUMNS_REPORTED] = "";
    int found = -1;
    for (int i = 0; header && i < t->columns; i++) {
        if (strcmp(t->field[i], of->text) == 0) {
            if (found >= 0) {
                document_mistake(
                    t->mistakes, of, 0,
                    "%.80s:%d: two columns have the name '%.40s'; give the number of the column",
                    t->name, t->line, of->text);
                return -1;
            }
            found = i;
        }
        const size_t used = strlen(known);
        snprintf(known + used, sizeof known - used, "%s%.30s", i > 0 ? ", " : "", t->field[i]);
    }
    char *end;
    const long number = strtol(of->text, &end, 10);
    if (found < 0 && *of->text != '\0' && *end == '\0' && number >= 1 && number <= t->columns)
        found = (int)number - 1;
    if (found < 0 && header)
        document_mistake(t->mistakes, of, 0,
                         "%.80s:%d: column '%.40s' does not exist; the columns are %s", t->name,
                         t->line, of->text, known);
    else if (found < 0)
        document_mistake(t->mistakes, of, 0,
                         "%.80s:%d: column '%.40s' does not exist, because the file has no header; "
                         "give the number of the column, 1 to %d",
                         t->name, t->line, of->text, t->columns);
    return found;
}

static int add_number(table_file *t, int k, double value)
{
    document_node *n = arena_take(t->arena, sizeof *n), *list = t->list[k];
    char text[NAME_BYTES];
    const int length = snprintf(text, sizeof text, "%.17g", value);
    list->item = arena_grow(t->arena, list->item, list->count, sizeof *list->item);
    if (n == NULL || list->item == NULL)
        return 0;
    *n = (document_node){.kind = DOCUMENT_TEXT,
                         .line = t->place->line,
                         .column = t->place->column,
                         .inset = -1,
                         .text = arena_copy(t->arena, text, (size_t)length)};
    list->item[list->count++] = n;
    return n->text != NULL;
}

/* Reads the first row. It is a header if it contains the name of a column to read, or no number in
 * these columns. Returns 1 for a header. */
static int begin(table_file *t)
{
    double number;
    int words = 0, header = 0, numbers = 0;
    for (int i = 0; i < t->columns; i++)
        words |= !line_number(t->field[i], &number);
    for (int k = 0; k < 2; k++) {
        t->column[k] = column_of(t, t->of[k], words);
        if (t->column[k] < 0)
            continue;
        header |= words && strcmp(t->field[t->column[k]], t->of[k]->text) == 0;
        numbers += line_number(t->field[t->column[k]], &number);
    }
    t->begun = 1;
    return header || numbers == 0;
}

static int read_row(table_file *t, char *line)
{
    const int count = split(t, line);
    if (!check_columns(t, count))
        return 0;
    if (!t->begun) {
        t->columns = count;
        const int header = begin(t);
        if (t->column[0] < 0 || t->column[1] < 0)
            return 0;
        if (header)
            return 1;
    }
    for (int k = 0; k < 2; k++) {
        double value;
        const char *field = t->field[t->column[k]];
        if (!line_number(field, &value))
            return wrong(t, "'", field, "' is not a number; correct it");
        if (k == 0 && t->list[0]->count > 0 && !(value > t->last))
            return wrong(t, "the values of 'at' do not ascend at ", field,
                         "; sort the rows, and remove repeated ones");
        if (t->list[k]->count == DOCUMENT_ENTRIES)
            return wrong(t, "the table has more than 10000 rows", "", "; remove rows");
        if (k == 0)
            t->last = value;
        if (!add_number(t, k, value))
            return 0;
    }
    return 1;
}

static int read_rows(table_file *t, FILE *from)
{
    int good = 1;
    for (char *line; good && (line = next_line(t, from, &good)) != NULL;)
        good = read_row(t, line);
    return good && t->list[0]->count < 2
               ? wrong(t, "the file has fewer than two rows of numbers", "", "; add rows")
               : good;
}

/* State of a file of `shifts`: a header, which gives the order of columns, and rows NODE, dx, dy,
 * dz. */
typedef struct shift_file {
    table_file t;
    int column[4];
    document_node *map;
} shift_file;

static document_node *text_node(const table_file *t, const char *text)
{
    document_node *n = arena_take(t->arena, sizeof *n);
    if (n == NULL)
        return NULL;
    *n = (document_node){.kind = DOCUMENT_TEXT,
                         .line = t->place->line,
                         .column = t->place->column,
                         .inset = -1,
                         .text = arena_copy(t->arena, text, strlen(text))};
    return n->text != NULL ? n : NULL;
}

static int read_shift(shift_file *s, char *line)
{
    static const char *const name[4] = {"node", "dx", "dy", "dz"};
    table_file *t = &s->t;
    const int count = split(t, line);
    if (!check_columns(t, count))
        return 0;
    if (!t->begun) {
        t->columns = count;
        t->begun = 1;
        for (int k = 0; k < 4; k++) {
            s->column[k] = -1;
            for (int i = 0; i < count; i++)
                if (strcmp(t->field[i], name[k]) == 0)
                    s->column[k] = i;
            if (s->column[k] < 0)
                return wrong(t, "no column '", name[k],
                             "'; write node, dx, dy and dz in the first row");
        }
        return 1;
    }
    if (s->map->count == DOCUMENT_ENTRIES)
        return wrong(t, "the table has more than 10000 rows", "", "; remove rows");
    document_node *shift = arena_take(t->arena, sizeof *shift),
                  *key = text_node(t, t->field[s->column[0]]), *map = s->map;
    map->key = arena_grow(t->arena, map->key, map->count, sizeof(document_node *));
    map->item = arena_grow(t->arena, map->item, map->count, sizeof(document_node *));
    if (shift == NULL || key == NULL || map->key == NULL || map->item == NULL)
        return 0;
    *shift = (document_node){.kind = DOCUMENT_LIST, .line = key->line, .column = key->column};
    for (int k = 1; k < 4; k++) {
        double value;
        if (!line_number(t->field[s->column[k]], &value))
            return wrong(t, "'", t->field[s->column[k]], "' is not a number; correct it");
        t->list[0] = shift;
        if (!add_number(t, 0, value))
            return 0;
    }
    map->key[map->count] = key;
    map->item[map->count++] = shift;
    return 1;
}

static int read_shifts_from(shift_file *s, FILE *from)
{
    int good = 1;
    for (char *line; good && (line = next_line(&s->t, from, &good)) != NULL;)
        good = read_shift(s, line);
    return good && s->map->count == 0
               ? wrong(&s->t, "the file has no rows of numbers", "", "; give one row per node")
               : good;
}

static FILE *open_beside(const char *beside, const char *name, arena *a)
{
    const char *slash = strrchr(beside, '/');
    const size_t folder = slash != NULL && *name != '/' ? (size_t)(slash - beside) + 1 : 0,
                 room = folder + strlen(name) + 1;
    char *path = arena_take(a, room);
    if (path == NULL)
        return NULL;
    memcpy(path, beside, folder);
    memcpy(path + folder, name, strlen(name) + 1);
    return line_open(path);
}

static FILE *open_file(table_file *t, const char *beside)
{
    const document_node *file = t->place;
    if (file->kind != DOCUMENT_TEXT) {
        document_mistake(t->mistakes, file, 0,
                         "file: give the path of a CSV file, relative to the scene file");
        return NULL;
    }
    if (beside == NULL) {
        document_mistake(t->mistakes, file, 0,
                         "a scene given as a string has no folder for files; give the "
                         "path of a scene file, or write the values");
        return NULL;
    }
    t->name = file->text;
    FILE *from = open_beside(beside, file->text, t->arena);
    if (from == NULL)
        document_mistake(t->mistakes, file, 0,
                         "%.120s cannot be read: %s; give a path relative to the scene file",
                         file->text, strerror(errno));
    return from;
}

static void read_shifts(document_node *map, const char *beside, arena *a, mistakes *m)
{
    const document_node *file =
        map->kind == DOCUMENT_MAP && map->count == 1 ? document_find(map, "file") : NULL;
    if (file == NULL || file->kind != DOCUMENT_TEXT)
        return;
    document_node rows = {
        .kind = DOCUMENT_MAP, .line = file->line, .column = file->column, .inset = map->inset};
    shift_file s = {.t = {.place = file, .arena = a, .mistakes = m}, .map = &rows};
    FILE *from = open_file(&s.t, beside);
    if (from == NULL)
        return;
    if (read_shifts_from(&s, from))
        *map = rows;
    fclose(from);
}

static void read_table(document_node *map, const char *beside, arena *a, mistakes *m)
{
    const document_node *file = document_find(map, "file");
    table_file t = {.place = file,
                    .arena = a,
                    .mistakes = m,
                    .of = {document_find(map, "at"), document_find(map, "value")}};
    if (file == NULL)
        return;
    for (int k = 0; k < 2; k++)
        if (t.of[k] == NULL || t.of[k]->kind != DOCUMENT_TEXT) {
            document_mistake(m, t.of[k] != NULL ? t.of[k] : file, 0,
                             "with 'file', give columns of the file in 'at' and 'value', by header "
                             "or by number");
            return;
        }
    FILE *from = open_file(&t, beside);
    if (from == NULL)
        return;
    document_node *list = arena_take(a, 2 * sizeof *list);
    int read = list != NULL;
    for (int k = 0; k < 2 && read; k++) {
        list[k] = (document_node){
            .kind = DOCUMENT_LIST, .line = t.of[k]->line, .column = t.of[k]->column};
        t.list[k] = list + k;
    }
    read = read && read_rows(&t, from);
    fclose(from);
    for (int i = 0, to = 0; read && i < map->count; i++) {
        if (map->item[i] == file)
            continue;
        map->key[to] = map->key[i];
        map->item[to++] = map->item[i] == t.of[0]   ? t.list[0]
                          : map->item[i] == t.of[1] ? t.list[1]
                                                    : map->item[i];
    }
    map->count -= read;
}

void table_files_read(document_node *n, const char *beside, arena *a, mistakes *m)
{
    for (int i = 0; i < n->count; i++) {
        document_node *item = n->item[i];
        const char *key = n->kind == DOCUMENT_MAP ? n->key[i]->text : "";
        const int tables = strcmp(key, "tables") == 0;
        if (strcmp(key, "table") == 0)
            read_table(item, beside, a, m);
        for (int k = 0; tables && item->kind == DOCUMENT_MAP && k < item->count; k++)
            read_table(item->item[k], beside, a, m);
        if (strcmp(key, "shifts") == 0)
            read_shifts(item, beside, a, m);
        table_files_read(item, beside, a, m);
    }
}
